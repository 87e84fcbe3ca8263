// The edges of cells, each once and numbered, found by their vertices.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <vector>

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// Edges in ascending order of their lower vertices, then of their higher ones. Needs no adjacency.
class EdgeTable {
 public:
  EdgeTable() = default;
  /// The edges of these cells of the mesh. \pre they are alive, and have less than 2^31 edges all told. Cost: the cells and the
  /// points of the mesh.
  template <int Dim>
  EdgeTable(const Mesh<Dim>& mesh, std::span<const CellId> cells);

  [[nodiscard]] Index size() const { return static_cast<Index>(edges_.size()); }
  /// Lower vertex, higher vertex.
  [[nodiscard]] const std::array<VertexId, 2>& operator[](Index e) const { return edges_[e]; }

  /// The number of the edge between two vertices. \pre there is one. Cost: the edges at the lower of them.
  [[nodiscard]] Index find(VertexId a, VertexId b) const {
    const auto [low, high] = std::minmax(a, b);
    Index e = first_[low];
    while (edges_[e][1] != high) assert(e + 1 < first_[low + 1]), ++e;
    return e;
  }

 private:
  std::vector<Index> first_;  ///< edge with this lower vertex; one more at the end
  std::vector<std::array<VertexId, 2>> edges_;
};

}  // namespace pillowmesh
