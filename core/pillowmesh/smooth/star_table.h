// Who is around each vertex of a hex mesh, found once for many visits.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// A facet at a vertex: its edges to `a` and `b`, positions in the star's spokes, and the vertex across.
///
///      b---diagonal
///      |      |        outer edges: 2 i from a, 2 i + 1 from b to the diagonal
///      v------a
struct StarFacet {
  VertexId diagonal;
  std::int16_t a, b;
};

/// A cell at a vertex: its three edges there, right-handed, and for each of them, (j), the outer edges that leave its
/// far end in the facets of the edges (j, j + 1) and (j, j + 2).
struct StarCorner {
  std::array<std::int16_t, 3> spoke;
  std::array<std::array<std::int16_t, 2>, 3> outer;
};

/// Who is around each vertex of a mesh of fixed topology. Built once; cost linear, 200 bytes a vertex.
class StarTable {
 public:
  explicit StarTable(const Mesh<3>& mesh);

  [[nodiscard]] std::span<const VertexId> spokes(VertexId v) const {
    return row(spokes_, start_[v][0], start_[v + 1][0]);
  }
  [[nodiscard]] std::span<const StarFacet> facets(VertexId v) const {
    return row(facets_, start_[v][1], start_[v + 1][1]);
  }
  [[nodiscard]] std::span<const StarCorner> corners(VertexId v) const {
    return row(corners_, start_[v][2], start_[v + 1][2]);
  }

 private:
  template <class T>
  static std::span<const T> row(const std::vector<T>& all, std::size_t from, std::size_t to) {
    return {all.data() + from, to - from};
  }
  std::vector<std::array<std::uint32_t, 3>> start_;  ///< per vertex
  std::vector<VertexId> spokes_;
  std::vector<StarFacet> facets_;
  std::vector<StarCorner> corners_;
};

}  // namespace pillowmesh
