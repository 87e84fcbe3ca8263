// Walking a quad mesh counterclockwise: around a cell, and around a vertex.
//
//      2---<---3        Corners 0 1 3 2 go around the cell; side i runs from the i-th of them to the next:
//      |       |        side 0 bottom, 1 right, 2 top, 3 left.
//      v       ^
//      |       |
//      0--->---1
#pragma once

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// i-th corner counterclockwise, and where a corner comes in that order.
inline constexpr int kAround[4] = {0, 1, 3, 2};
inline constexpr int kPlace[4] = {0, 1, 3, 2};
/// The facet that side i is, and the side that a facet is.
inline constexpr int kSideFacet[4] = {Cell<2>::facet(1, 0), Cell<2>::facet(0, 1), Cell<2>::facet(1, 1), Cell<2>::facet(0, 0)};
inline constexpr int kFacetSide[4] = {3, 1, 0, 2};

/// i-th vertex of cell c counterclockwise; i is taken modulo 4.
inline VertexId around(const Mesh<2>& mesh, CellId c, int i) { return mesh.cells[c][kAround[i & 3]]; }
/// The cell with these vertices counterclockwise.
inline Corners<2> quad(VertexId a, VertexId b, VertexId c, VertexId d) { return {a, b, d, c}; }
/// Place of v in cell c counterclockwise, -1 when it is not there.
inline int place_of(const Mesh<2>& mesh, CellId c, VertexId v) {
  for (int i = 0; i < 4; ++i)
    if (around(mesh, c, i) == v) return i;
  return -1;
}
inline HalfFacetId twin_of_side(const Mesh<2>& mesh, CellId c, int side) { return mesh.twins[c][kSideFacet[side & 3]]; }

/// The cells at a vertex counterclockwise; on the boundary from the one whose side out of the vertex is on the boundary.
struct OrderedStar {
  static constexpr int most = 24;
  int count = 0;
  bool closed = false;  ///< inside: the last cell is next to the first
  std::array<CellId, most> cell;
  std::array<std::int8_t, most> place;  ///< of the vertex in the cell
};

/// \return false where more than OrderedStar::most cells meet, or none. Cost: linear in the valence.
inline bool find_star(const Mesh<2>& mesh, VertexId v, OrderedStar& star) {
  CellId c = mesh.vertex_cell[v];
  star.count = 0;
  if (c == kNone) return false;
  int i = place_of(mesh, c, v);
  const CellId seed = c;
  star.closed = mesh.support[v].dim == 2;
  // Clockwise to the boundary, or once around where a curve may be inside.
  for (int steps = 0; !star.closed; ++steps) {
    const HalfFacetId twin = twin_of_side(mesh, c, i);
    if (twin < 0) {
      star.closed = false;
      break;
    }
    c = mesh.cell_of(twin);
    i = (kFacetSide[mesh.facet_of(twin)] + 1) & 3;
    if (c == seed) {
      star.closed = true;
      break;
    }
    if (steps > OrderedStar::most) return false;
  }
  const CellId first = c;
  while (true) {
    if (star.count == OrderedStar::most) return false;
    star.cell[star.count] = c;
    star.place[star.count++] = static_cast<std::int8_t>(i);
    const HalfFacetId twin = twin_of_side(mesh, c, i + 3);
    if (twin < 0) return !star.closed;
    c = mesh.cell_of(twin);
    if (c == first) return true;
    i = kFacetSide[mesh.facet_of(twin)];
  }
}

}  // namespace pillowmesh
