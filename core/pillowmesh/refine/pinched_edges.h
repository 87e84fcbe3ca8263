// 3D: edges of the hull around which the two sides alternate: four or more hull facets meet there, two or more at an edge
// of the domain's boundary.
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

/// Runs of cells of the shrink set, and of the rest, around the edge.
struct RunCount {
  int inside = 0, outside = 0;
};
RunCount count_runs(const Hull<3>& hull, const EdgeRing& ring);

/// True if the shrink set, not the outside, is to be joined across a pinched edge (a, b): where its runs are one
/// component at both ends already. What lies beyond the domain's boundary counts as outside.
bool joins_inside(const Mesh<3>& mesh, const Hull<3>& hull, VertexId a, VertexId b, const EdgeRing& ring);

/// The shortest run of cells outside between runs of the shrink set; of equally long ones that with the lowest cell.
void shortest_run_outside(const Hull<3>& hull, const EdgeRing& ring, std::vector<CellId>& run);

/// Calls visit(w, join inside, ring) for each pinched edge (v, w): one with several runs of either side. Cost: none to speak of at the usual vertices,
/// where the hull facets are a single fan.
template <class Visit>
void pinched_edges_at(const Mesh<3>& mesh, const Hull<3>& hull, VertexId v, const std::vector<CellCorner>& star,
                      Visit&& visit) {
  // Each unpinched hull edge inside the domain has two hull facets: then there are as many edges at v as facets.
  std::array<VertexId, 32> ends;
  std::size_t edges = 0;
  int facets = 0;
  for (const auto& [c, corner] : star) {
    if (!hull.in_set[c] || hull.hull_sides[c] == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      if (!hull.is_hull(c, Cell<3>::facet(axis, (corner >> axis) & 1))) continue;
      ++facets;
      for (int other = 0; other < 3; ++other) {
        const VertexId w = mesh.cells[c][corner ^ (1 << other)];
        if (other == axis || std::find(ends.begin(), ends.begin() + edges, w) != ends.begin() + edges) continue;
        if (edges < ends.size()) ends[edges++] = w;
      }
    }
  }
  if (mesh.support[v].dim == 3 && static_cast<std::size_t>(facets) <= edges && edges < ends.size()) return;
  EdgeRing ring;
  std::vector<VertexId> seen;
  for (const auto& [c, corner] : star) {
    if (!hull.in_set[c] || hull.hull_sides[c] == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const VertexId w = mesh.cells[c][corner ^ (1 << axis)];
      if (hull.slot[w] == kNone || std::find(seen.begin(), seen.end(), w) != seen.end()) continue;
      seen.push_back(w);
      edge_ring(mesh, {c, Cell<3>::edge_at(corner, axis)}, ring);
      const RunCount runs = count_runs(hull, ring);
      if (runs.inside < 2 && runs.outside < 2) continue;
      visit(w, runs.inside > 1 && joins_inside(mesh, hull, v, w, ring), ring);
    }
  }
}

}  // namespace pillowmesh
