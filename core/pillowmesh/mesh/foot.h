// The pieces that the domain's boundary is made of, straight or curved, and the nearest points on them.
#pragma once

#include "pillowmesh/mesh/boundary.h"

namespace pillowmesh {

/// The nearest point of a piece.
template <int Dim>
struct Foot {
  Point<Dim> point;
  double distance2;
  int cut[Dim - 1];  ///< per parameter: 0 or 1 where the foot was cut off at that end of the piece, else kNone
  /// Not of unit length, from the piece's first end to its second. A curve has the first, a surface both; in 2D only the first is there.
  Point<Dim> tangent[Dim - 1];
};

/// Foot of p on the boundary facet i.
template <int Dim>
Foot<Dim> foot_on_facet(const Geometry<Dim>& geometry, Index i, const Point<Dim>& p);

/// Foot of p on the feature edge i. \pre Dim == 3
template <int Dim>
Foot<Dim> foot_on_segment(const Geometry<Dim>& geometry, Index i, const Point<Dim>& p);

/// Off the chord at s, and the derivative of that.
template <int Dim>
Point<Dim> off_chord(const Bend<Dim>& bend, double s) {
  return s * (1 - s) * ((1 - s) * bend.from - s * bend.to);
}
template <int Dim>
Point<Dim> off_chord_slope(const Bend<Dim>& bend, double s) {
  return (1 - 4 * s + 3 * s * s) * bend.from - (2 * s - 3 * s * s) * bend.to;
}

}  // namespace pillowmesh
