// Tags: marks on edges that are to be refined. [Paper] section 4, step 1.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {

/// One bit per local edge of a cell. All cells at an edge carry the same bit for it.
template <int Dim>
struct EdgeTags {
  using Mask = std::conditional_t<Dim == 2, std::uint8_t, std::uint16_t>;
  static constexpr Mask all = static_cast<Mask>((1u << Cell<Dim>::edges) - 1);

  std::vector<Mask> mask;

  [[nodiscard]] bool has(CellId c, int e) const { return (mask[c] >> e) & 1; }
  [[nodiscard]] bool has(CellEdge e) const { return has(e.cell, e.edge); }
};

/// Tags the edge in all its cells. Cost: the cells at the edge.
template <int Dim>
inline void set_tag(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, CellEdge edge) {
  for_each_cell_at_edge(mesh, edge, [&](CellId c, int e) { tags.mask[c] |= typename EdgeTags<Dim>::Mask(1u << e); });
}
template <int Dim>
inline void clear_tag(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, CellEdge edge) {
  for_each_cell_at_edge(mesh, edge, [&](CellId c, int e) { tags.mask[c] &= typename EdgeTags<Dim>::Mask(~(1u << e)); });
}

/// Bits of the edges of facet f.
template <int Dim>
constexpr typename EdgeTags<Dim>::Mask facet_edges(int f) {
  unsigned bits = 0;
  for (int e = 0; e < Cell<Dim>::edges; ++e)
    if (Cell<Dim>::edge_axis(e) != Cell<Dim>::facet_axis(f) && Cell<Dim>::corner_on_facet(Cell<Dim>::edge_from(e), f))
      bits |= 1u << e;
  return static_cast<typename EdgeTags<Dim>::Mask>(bits);
}

}  // namespace pillowmesh
