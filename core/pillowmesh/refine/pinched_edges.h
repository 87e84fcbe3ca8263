// 3D: edges of the hull where four or more hull facets meet, so that the two sides alternate around them.
#pragma once

#include <algorithm>
#include <vector>

#include "pillowmesh/refine/hull.h"

namespace pillowmesh {

/// Cells around an edge in order; `closed` inside the domain.
struct EdgeRing {
  std::vector<CellEdge> cells;
  bool closed = false;
};

/// Collects the ring in order around the edge.
void edge_ring(const Mesh<3>& mesh, CellEdge edge, EdgeRing& ring);

/// Number of hull facets at the edge of the ring.
int hull_facets_in(const Mesh<3>& mesh, const Hull<3>& hull, const EdgeRing& ring);

/// The pinched edges across which the shrink set, not the outside, is joined: those where its runs are one component at
/// both ends already. Sorted pairs, lower vertex first. Cost: linear in the hull.
void find_joined_inside(const Mesh<3>& mesh, const Hull<3>& hull, std::vector<std::array<VertexId, 2>>& edges);

/// Calls visit(join_inside, cells of the ring) for each pinched interior edge at v.
template <class Visit>
void pinched_edges_at(const Mesh<3>& mesh, const Hull<3>& hull, VertexId v, const std::vector<CellCorner>& star,
                      const std::vector<std::array<VertexId, 2>>& joined_inside, Visit&& visit) {
  EdgeRing ring;
  std::vector<VertexId> seen;
  std::vector<CellCorner> cells;
  for (const auto& [c, corner] : star) {
    if (!hull.in_set[c] || hull.hull_sides[c] == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const VertexId w = mesh.cells[c][corner ^ (1 << axis)];
      if (hull.slot[w] == kNone || std::find(seen.begin(), seen.end(), w) != seen.end()) continue;
      seen.push_back(w);
      edge_ring(mesh, {c, Cell<3>::edge_at(corner, axis)}, ring);
      if (!ring.closed || hull_facets_in(mesh, hull, ring) < 4) continue;
      cells.clear();
      for (const CellEdge& e : ring.cells) cells.push_back({e.cell, 0});
      const std::array<VertexId, 2> key{std::min(v, w), std::max(v, w)};
      visit(std::binary_search(joined_inside.begin(), joined_inside.end(), key), cells);
    }
  }
}

}  // namespace pillowmesh
