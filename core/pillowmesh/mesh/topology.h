// Half-facet adjacency: building it once, and walking it.
//
// Half-facets follow Alumbaugh and Jiao, "Compact array-based mesh data structures" (2005), with corner-bit numbering.
#pragma once

#include <array>
#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// Fills `twins` (boundary facets: patch 0) and `vertex_cell` from `cells`.
/// \return bad_input naming the cells where more than two meet at a facet or two neighbours are oriented against each
/// other. Cost: linear.
template <int Dim>
Status connect_cells(Mesh<Dim>& mesh);

/// All cells that are alive, in ascending order. Cost: linear.
template <int Dim>
std::vector<CellId> live_cells(const Mesh<Dim>& mesh);

/// Local corner of cell c that is vertex v, or -1.
template <int Dim>
inline int corner_of(const Mesh<Dim>& mesh, CellId c, VertexId v) {
  for (int k = 0; k < Cell<Dim>::corners; ++k)
    if (mesh.cells[c][k] == v) return k;
  return -1;
}

/// A cell at a vertex, and which of its corners the vertex is.
struct CellCorner {
  CellId cell;
  int corner;
};

/// All cells at vertex v, found through facets from vertex_cell[v]; `out` is cleared first. Order: breadth first,
/// facets in axis order. Cost: linear in the valence for the usual ones.
template <int Dim>
void vertex_star(const Mesh<Dim>& mesh, VertexId v, std::vector<CellCorner>& out);

/// An edge as one of its cells sees it.
struct CellEdge {
  CellId cell;
  int edge;
};

/// The local edge of cell c that joins vertices a and b, or -1.
template <int Dim>
int edge_between(const Mesh<Dim>& mesh, CellId c, VertexId a, VertexId b);

/// The local edge of cell c that joins vertices a and b, both on its facet f.
template <int Dim>
inline int edge_on_facet(const Mesh<Dim>& mesh, CellId c, int f, VertexId a, VertexId b) {
  int ka = 0, kb = 0;
  for (int i = 0; i < Cell<Dim>::facet_corners; ++i) {
    const int k = Cell<Dim>::facet_corner(f, i);
    if (mesh.cells[c][k] == a) ka = k;
    if (mesh.cells[c][k] == b) kb = k;
  }
  const int bit = ka ^ kb;
  return Cell<Dim>::edge_at(ka, bit == 1 ? 0 : (bit == 2 ? 1 : 2));
}

/// Calls visit(cell, local edge) for every cell at the edge, `start` first: in 2D one or two cells, in 3D the ring.
template <int Dim, class Visit>
void for_each_cell_at_edge(const Mesh<Dim>& mesh, CellEdge start, Visit&& visit) {
  visit(start.cell, start.edge);
  if constexpr (Dim == 2) {
    const HalfFacetId twin = mesh.twins[start.cell][Cell<2>::edge_facet(start.edge)];
    if (twin >= 0) visit(mesh.cell_of(twin), Cell<2>::facet_edge(mesh.facet_of(twin)));
  } else {
    const int axis = Cell<Dim>::edge_axis(start.edge);
    const int from = Cell<Dim>::edge_from(start.edge);
    const VertexId a = mesh.cells[start.cell][from], b = mesh.cells[start.cell][Cell<Dim>::edge_to(start.edge)];
    const int sides[2] = {(axis + 1) % 3, (axis + 2) % 3};
    for (const int side : sides) {  // once around, or both ways to the boundary
      CellId c = start.cell;
      int leave = Cell<Dim>::facet(side, (from >> side) & 1);
      while (true) {
        const HalfFacetId twin = mesh.twins[c][leave];
        if (twin < 0) break;
        c = mesh.cell_of(twin);
        if (c == start.cell) return;
        const int entered = mesh.facet_of(twin);
        const int e = edge_on_facet(mesh, c, entered, a, b);
        visit(c, e);
        const int k = Cell<Dim>::edge_from(e), along = Cell<Dim>::edge_axis(e);
        const int other = 3 - along - Cell<Dim>::facet_axis(entered);
        leave = Cell<Dim>::facet(other, (k >> other) & 1);
      }
    }
  }
}

/// True if (cell, edge) is the representative of its edge: the one of the lowest cell number. Visiting every cell's
/// representatives visits every edge once.
template <int Dim>
inline bool represents_edge(const Mesh<Dim>& mesh, CellEdge e) {
  if constexpr (Dim == 2) {
    const HalfFacetId twin = mesh.twins[e.cell][Cell<2>::edge_facet(e.edge)];
    return twin < 0 || mesh.cell_of(twin) > e.cell;
  } else {
    bool lowest = true;
    for_each_cell_at_edge(mesh, e, [&](CellId c, int) { lowest = lowest && c >= e.cell; });
    return lowest;
  }
}

/// Pairs of vertices of all edges, each once, in the order of their representatives. Cost: linear.
template <int Dim>
std::vector<std::array<VertexId, 2>> unique_edges(const Mesh<Dim>& mesh);

/// +1 or -1: facet f's corners in the order of Cell::facet_corner, turned so that they go around the outward normal.
template <int Dim>
constexpr int facet_sign(int f) {
  const int axis = Cell<Dim>::facet_axis(f), side = Cell<Dim>::facet_side(f);
  if constexpr (Dim == 2) return (axis + side) % 2 == 1 ? 1 : -1;
  return (axis == 1) == (side == 1) ? -1 : 1;
}

}  // namespace pillowmesh
