#include "pillowmesh/mesh/edge_table.h"

#include <algorithm>

namespace pillowmesh {

template <int Dim>
EdgeTable::EdgeTable(const Mesh<Dim>& mesh, std::span<const CellId> cells) : first_(mesh.points.size() + 1, 0) {
  const auto for_each_side = [&](auto&& visit) {
    for (const CellId c : cells)
      for (int e = 0; e < Cell<Dim>::edges; ++e) {
        const auto [low, high] = std::minmax(mesh.cells[c][Cell<Dim>::edge_from(e)], mesh.cells[c][Cell<Dim>::edge_to(e)]);
        visit(low, high);
      }
  };
  // Sorted by counting: first_[v + 1] is the number of sides of v, then where the next of them goes.
  for_each_side([&](VertexId low, VertexId) { ++first_[low + 1]; });
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  edges_.resize(first_.back());
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for_each_side([&](VertexId low, VertexId high) { edges_[next[low]++] = {low, high}; });
  Index end = 0;
  for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
    const auto begin = edges_.begin() + first_[v], stop = edges_.begin() + first_[v + 1];
    std::sort(begin, stop);
    first_[v] = end;
    end = static_cast<Index>(std::copy(begin, std::unique(begin, stop), edges_.begin() + end) - edges_.begin());
  }
  first_.back() = end;
  edges_.resize(end);
  edges_.shrink_to_fit();  // each edge came once for each of its cells
}

template EdgeTable::EdgeTable(const Mesh<2>&, std::span<const CellId>);
template EdgeTable::EdgeTable(const Mesh<3>&, std::span<const CellId>);

}  // namespace pillowmesh
