// Derivatives of the energy of quad_energy.h by the position x of one vertex.
//
// Gradients include the change of the metric along the edges; that of the metric by which angles are measured is left
// out. Hessians are those of the metric held fixed.
#pragma once

#include "pillowmesh/smooth/quad_energy.h"

namespace pillowmesh {

/// Energy of some corners, and its derivatives.
struct QuadDerivatives {
  double value = 0.0;
  Point<2> gradient = Point<2>::Zero();
  double xx = 0.0, xy = 0.0, yy = 0.0;
  /// Newton's step with the eigenvalues of the Hessian made positive.
  [[nodiscard]] Point<2> step() const;
  /// The same along a unit vector.
  [[nodiscard]] Point<2> step_along(const Point<2>& t) const;
};

/// How what the energy asks of an edge depends on x, the position of one of its ends.
struct EdgeSlope {
  double sign;      ///< of x in the edge's vector as its corner sees it
  Point<2> dl, ds;  ///< gradients of length and misalignment
  double dll;       ///< l^2 / (e' G e): with the metric fixed the Hessian of l^2 is twice that times G
};

/// Of the edge e = q - x with these terms, from the sizes at x, in its middle and at q.
EdgeSlope edge_slope(const Point<2>& e, const EdgeTerm& term, const SizeJet& here, const SizeJet& middle,
                     const SizeTensor& there, const EnergyWeights& weights);

/// Adds a corner with edges e1 and e2 in counterclockwise order. `da`, `db`: null for an edge that does not move;
/// `dcross`: gradient of e1 x e2.
void add_corner(const Point<2>& e1, const EdgeTerm& a, const EdgeSlope* da, const Point<2>& e2, const EdgeTerm& b,
                const EdgeSlope* db, const Point<2>& dcross, const EnergyWeights& weights, QuadDerivatives& sum);

/// Adds what the shape of a corner costs (`shape_energy`). `dd`: null where the opposite side does not move.
void add_shape(const EdgeTerm& a, const EdgeSlope* da, const EdgeTerm& b, const EdgeSlope* db, double diagonal,
               const EdgeSlope* dd, const EnergyWeights& weights, QuadDerivatives& sum);

}  // namespace pillowmesh
