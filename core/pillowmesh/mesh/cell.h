// Local numbering of a quadrilateral or hexahedron by corner bits.
//
// Corner c, bit d set = far side along local axis d:
//
//      2---------3            6---------7
//      |         |           /|        /|
//      |         |          4---------5 |      axis 0: 0 -> 1
//      |         |          | |       | |      axis 1: 0 -> 2
//      |         |          | 2-------|-3      axis 2: 0 -> 4
//      0---------1          |/        |/
//                           0---------1
//
// Facet f = 2 * axis + side. Edge e = axis * edges_per_axis + k, where k numbers the corners whose bit `axis` is
// clear. Edges of the same axis are parallel (the paper's "opposite" edges). In 2D an edge is also a facet: edge
// (axis, k) is facet 2 * (1 - axis) + k. Other programs' numberings exist only in io/.
#pragma once

#include <array>

#include "pillowmesh/mesh/ids.h"

namespace pillowmesh {

template <int Dim>
struct Cell {
  static_assert(Dim == 2 || Dim == 3);
  static constexpr int corners = 1 << Dim;
  static constexpr int facets = 2 * Dim;
  static constexpr int edges_per_axis = 1 << (Dim - 1);
  static constexpr int edges = Dim * edges_per_axis;
  static constexpr int facet_corners = 1 << (Dim - 1);

  /// `k` with a zero bit inserted at position `axis`.
  static constexpr int insert_bit(int k, int axis) {
    const int low = k & ((1 << axis) - 1);
    return low | ((k >> axis) << (axis + 1));
  }
  /// `c` with the bit at position `axis` taken out: the inverse of insert_bit.
  static constexpr int remove_bit(int c, int axis) {
    const int low = c & ((1 << axis) - 1);
    return low | ((c >> (axis + 1)) << axis);
  }

  static constexpr int facet(int axis, int side) { return 2 * axis + side; }
  static constexpr int facet_axis(int f) { return f >> 1; }
  static constexpr int facet_side(int f) { return f & 1; }
  static constexpr int opposite_facet(int f) { return f ^ 1; }
  /// k-th corner of facet f; k counts the remaining axes in increasing order as bits.
  static constexpr int facet_corner(int f, int k) {
    return insert_bit(k, facet_axis(f)) | (facet_side(f) << facet_axis(f));
  }
  static constexpr bool corner_on_facet(int c, int f) { return ((c >> facet_axis(f)) & 1) == facet_side(f); }

  static constexpr int edge(int axis, int k) { return axis * edges_per_axis + k; }
  static constexpr int edge_axis(int e) { return e / edges_per_axis; }
  static constexpr int edge_from(int e) { return insert_bit(e % edges_per_axis, edge_axis(e)); }
  static constexpr int edge_to(int e) { return edge_from(e) | (1 << edge_axis(e)); }
  /// The edge along `axis` that starts or ends at corner c.
  static constexpr int edge_at(int c, int axis) { return edge(axis, remove_bit(c, axis)); }
  /// The facet that a 2D edge is.
  static constexpr int edge_facet(int e)
    requires(Dim == 2)
  {
    return facet(1 - edge_axis(e), e % edges_per_axis);
  }
  /// The edge that a 2D facet is: the inverse of edge_facet.
  static constexpr int facet_edge(int f)
    requires(Dim == 2)
  {
    return edge(1 - facet_axis(f), facet_side(f));
  }

  /// +1 or -1: the sign by which the edge vectors out of corner c, in axis order, form a right-handed frame.
  static constexpr int corner_sign(int c) {
    int bits = 0;
    for (int d = 0; d < Dim; ++d) bits += (c >> d) & 1;
    return bits % 2 == 0 ? 1 : -1;
  }
};

/// The vertices of one cell in corner-bit order.
template <int Dim>
using Corners = std::array<VertexId, Cell<Dim>::corners>;
/// The vertices of one facet in the order of Cell<Dim>::facet_corner.
template <int Dim>
using FacetCorners = std::array<VertexId, Cell<Dim>::facet_corners>;

}  // namespace pillowmesh
