// The energy of a quad mesh by which vertices move and by which every change of topology is judged.
//
// A corner with edges e1 and e2 has the integrated metric lengths l1 and l2, and G, the mean of M / sqrt(det M) in the
// middle of both edges. With the angle phi between them in G and d = l1 l2 sin(phi), its metric area,
//
//     E = d w / 4,   w = (l1^2 + l2^2) (1 + 1 / d^2) / 2 - 2 + alignment (s1 + s2) / 2,
//
// the symmetric Dirichlet energy of the map from the unit corner, 0 only for the unit square corner. The weight d makes
// the sums over meshes of different connectivity comparable: E is in units of one ideal cell. s = g sin^2(2 psi), where
// psi is the angle in space between an edge and the nearest eigenvector of M, and g = ((m1 - m2) / (m1 + m2))^2.
#pragma once

#include <cmath>
#include <limits>

#include "pillowmesh/metric/background.h"

namespace pillowmesh {

/// What the energy asks of an edge.
struct EdgeTerm {
  double l;              ///< metric length
  double g11, g12, g22;  ///< M / sqrt(det M) in its middle
  double s;              ///< misalignment: g sin^2(2 psi)
};

/// M / sqrt(det M) of sizes H.
struct Shape2 {
  double g11, g12, g22;
};
inline Shape2 shape_of(const SizeTensor& H) {
  const double i = 1.0 / (H.a * H.c - H.b * H.b);
  return {(H.c * H.c + H.b * H.b) * i, -H.b * (H.a + H.c) * i, (H.a * H.a + H.b * H.b) * i};
}
/// |H^-1 e|
inline double length_in(const SizeTensor& H, const Point<2>& e) {
  const double x = H.c * e[0] - H.b * e[1], y = H.a * e[1] - H.b * e[0];
  return std::sqrt(x * x + y * y) / (H.a * H.c - H.b * H.b);
}
/// g sin^2(2 psi) of the direction e: with r = |e|^2 / (e' G e) and t = tr G it is 4 (r (t - r) - 1) / t^2.
inline double misalignment(const Shape2& G, const Point<2>& e) {
  const double r = e.squaredNorm() / (G.g11 * e[0] * e[0] + 2.0 * G.g12 * e[0] * e[1] + G.g22 * e[1] * e[1]);
  const double t = G.g11 + G.g22;
  return 4.0 * (r * (t - r) - 1.0) / (t * t);
}

/// What the energy is made of besides sizes and angles.
struct EnergyWeights {
  double alignment = 0.0;  ///< of edges with the eigenvectors of M
  /// > 0: d is replaced by (d + sqrt(d^2 + 4 delta^2)) / 2, so that inverted corners have an energy too.
  double delta = 0.0;
  /// Weight of sum max(0, shape_floor^2 - eta^2)^2 over corners.
  double shape = 0.0;
  double shape_floor = 0.65;
};

/// Energy of a corner whose edges e1, e2 are in counterclockwise order; infinite when it is degenerate or inside out and
/// delta is 0.
inline double corner_energy(const Point<2>& e1, const EdgeTerm& a, const Point<2>& e2, const EdgeTerm& b,
                            const EnergyWeights& weights) {
  const double cross = e1[0] * e2[1] - e1[1] * e2[0];
  if (weights.delta == 0.0 && !(cross > 0)) return std::numeric_limits<double>::infinity();
  const double g11 = a.g11 + b.g11, g12 = a.g12 + b.g12, g22 = a.g22 + b.g22;  // twice G: the factor cancels
  const double q1 = g11 * e1[0] * e1[0] + 2.0 * g12 * e1[0] * e1[1] + g22 * e1[1] * e1[1];
  const double q2 = g11 * e2[0] * e2[0] + 2.0 * g12 * e2[0] * e2[1] + g22 * e2[1] * e2[1];
  const double L1 = a.l * a.l, L2 = b.l * b.l, T = L1 + L2;
  double d = cross * std::sqrt((g11 * g22 - g12 * g12) * (L1 * L2) / (q1 * q2));
  if (weights.delta > 0.0) d = 0.5 * (d + std::sqrt(d * d + 4.0 * weights.delta * weights.delta));
  return 0.25 * (d * (0.5 * T - 2.0 + 0.5 * weights.alignment * (a.s + b.s)) + 0.5 * T / d);
}

/// eta^2 of the flat triangle of a corner, from the squares of its metric edge lengths: L1, L2, and D opposite to the
/// corner. Negative, and smooth, where there is no such triangle.
inline double squared_shape(double L1, double L2, double D) {
  const double g = 0.5 * (L1 + L2 - D), S = L1 + L2 + D;
  return 16.0 * (L1 * L2 - g * g) / (S * S);
}
/// What a corner with these edges and this length opposite to it costs for its shape. The angle in the mean metric of
/// both edges would miss what the metric does between them.
inline double shape_energy(const EdgeTerm& a, const EdgeTerm& b, double diagonal, const EnergyWeights& weights) {
  const double lack = weights.shape_floor * weights.shape_floor - squared_shape(a.l * a.l, b.l * b.l, diagonal * diagonal);
  return lack > 0 ? weights.shape * lack * lack : 0.0;
}

}  // namespace pillowmesh
