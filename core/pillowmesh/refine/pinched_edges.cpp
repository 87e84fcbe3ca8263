#include "pillowmesh/refine/pinched_edges.h"

namespace pillowmesh {
namespace {

using C = Cell<3>;

/// The other facet at the edge: not the one along `from_axis`.
int next_facet(int edge, int from_axis) {
  const int axis = C::edge_axis(edge), corner = C::edge_from(edge);
  const int other = 3 - axis - from_axis;
  return C::facet(other, (corner >> other) & 1);
}

/// True if the inside cells of the ring are one face-connected component at vertex v.
bool inside_connected_at(const Mesh<3>& mesh, const Hull<3>& hull, VertexId v, const EdgeRing& ring) {
  std::vector<CellId> reached;
  for (const CellEdge& e : ring.cells)
    if (hull.in_set[e.cell]) {
      reached.push_back(e.cell);
      break;
    }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const int corner = corner_of(mesh, reached[i], v);
    for (int axis = 0; axis < 3; ++axis) {
      const CellId n = mesh.neighbour(reached[i], C::facet(axis, (corner >> axis) & 1));
      if (n == kNone || !hull.in_set[n]) continue;
      if (std::find(reached.begin(), reached.end(), n) == reached.end()) reached.push_back(n);
    }
  }
  return std::all_of(ring.cells.begin(), ring.cells.end(), [&](const CellEdge& e) {
    return !hull.in_set[e.cell] || std::find(reached.begin(), reached.end(), e.cell) != reached.end();
  });
}

}  // namespace

void edge_ring(const Mesh<3>& mesh, CellEdge edge, EdgeRing& ring) {
  ring.cells.clear();
  ring.closed = false;
  const int axis = C::edge_axis(edge.edge);
  const VertexId a = mesh.cells[edge.cell][C::edge_from(edge.edge)], b = mesh.cells[edge.cell][C::edge_to(edge.edge)];
  const int first_axis = (axis + 1) % 3;
  const int leave = C::facet(first_axis, (C::edge_from(edge.edge) >> first_axis) & 1);
  // Walk to the end of an open ring first, so that the list starts there.
  CellEdge at = edge;
  int out = leave;
  while (true) {
    const HalfFacetId twin = mesh.twins[at.cell][out];
    if (twin < 0) {
      out = next_facet(at.edge, C::facet_axis(out));
      break;
    }
    at = {mesh.cell_of(twin), edge_on_facet(mesh, mesh.cell_of(twin), mesh.facet_of(twin), a, b)};
    ring.closed = at.cell == edge.cell;
    out = ring.closed ? leave : next_facet(at.edge, C::facet_axis(mesh.facet_of(twin)));
    if (ring.closed) break;
  }
  while (true) {
    ring.cells.push_back(at);
    const HalfFacetId twin = mesh.twins[at.cell][out];
    if (twin < 0 || mesh.cell_of(twin) == ring.cells[0].cell) return;
    at = {mesh.cell_of(twin), edge_on_facet(mesh, mesh.cell_of(twin), mesh.facet_of(twin), a, b)};
    out = next_facet(at.edge, C::facet_axis(mesh.facet_of(twin)));
  }
}

RunCount count_runs(const Hull<3>& hull, const EdgeRing& ring) {
  RunCount runs;
  const std::size_t n = ring.cells.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool inside = hull.in_set[ring.cells[i].cell] != 0;
    const bool first = i == 0 && !ring.closed;
    if (!first && (hull.in_set[ring.cells[(i + n - 1) % n].cell] != 0) == inside) continue;
    ++(inside ? runs.inside : runs.outside);
  }
  return runs;
}

void shortest_run_outside(const Hull<3>& hull, const EdgeRing& ring, std::vector<CellId>& run) {
  run.clear();
  const std::size_t n = ring.cells.size();
  std::size_t first = 0;  // a cell inside: what lies before it in an open ring is between no two runs
  while (first < n && !hull.in_set[ring.cells[first].cell]) ++first;
  std::vector<CellId> now;
  for (std::size_t i = first + 1; i < first + n + 1; ++i) {
    if (i == n && !ring.closed) return;
    const CellId c = ring.cells[i % n].cell;
    if (!hull.in_set[c]) {
      now.push_back(c);
      continue;
    }
    if (now.empty()) continue;
    std::sort(now.begin(), now.end());
    if (run.empty() || now.size() < run.size() || (now.size() == run.size() && now[0] < run[0])) run = now;
    now.clear();
  }
}

bool joins_inside(const Mesh<3>& mesh, const Hull<3>& hull, VertexId a, VertexId b, const EdgeRing& ring) {
  if (!ring.closed && !hull.in_set[ring.cells.front().cell] && !hull.in_set[ring.cells.back().cell]) return false;
  return inside_connected_at(mesh, hull, a, ring) && inside_connected_at(mesh, hull, b, ring);
}

}  // namespace pillowmesh
