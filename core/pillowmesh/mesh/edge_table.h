// The edges of cells, each once and numbered, found by their vertices.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// Edges in ascending order of their lower vertices, then of their higher ones. Needs no adjacency.
class EdgeTable {
 public:
  EdgeTable() = default;
  /// The edges of these cells of the mesh. Cost: linear.
  template <int Dim>
  EdgeTable(const Mesh<Dim>& mesh, std::span<const CellId> cells);

  [[nodiscard]] Index size() const { return static_cast<Index>(higher_.size()); }

  /// The number of the edge between two vertices. \pre there is one. Cost: the edges at the lower of them.
  [[nodiscard]] Index find(VertexId a, VertexId b) const {
    const auto [low, high] = std::minmax(a, b);
    Index e = first_[low];
    while (higher_[e] != high) ++e;
    return e;
  }

  /// visit(lower vertex, higher vertex) for all edges in their order.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (VertexId low = 0; low + 1 < static_cast<VertexId>(first_.size()); ++low)
      for (Index e = first_[low]; e < first_[low + 1]; ++e) visit(low, higher_[e]);
  }

 private:
  std::vector<Index> first_;      ///< edge with this lower vertex; one more at the end
  std::vector<VertexId> higher_;  ///< of each edge
};

}  // namespace pillowmesh
