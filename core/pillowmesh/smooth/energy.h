// The barrier energy of a corner: how far it is from a unit right-angled corner in the metric.
//
// With the edge vectors e_d out of the corner as columns of A and G = A' M A:   f = tr G + tr G^-1, which is 2 Dim for a
// unit square or cube corner and grows without bound as the corner degenerates. With d = det A and the cofactor vectors
// c_j of A, tr G^-1 = sum c_j' M^-1 c_j / d^2; c_j and d are affine in the position of any one of the corner's vertices,
// so that gradient and Hessian are exact and cheap while M is held fixed.
//
// M is the metric at the corner's vertex. Where it varies along an edge, the edge vector is scaled by the ratio of the
// edge's integrated length to its length in M alone: then f = sum l_j^2 + s_j / l_j^2, where the l_j are the lengths and
// the s_j >= 1 depend on the angles only.
//
// The energy of the corner is E = v (f / (2 Dim) - 1 + size_weight), v = sqrt(det M) d its volume in the metric: weighted
// by volume, the sum over a mesh is an integral and small cells do not rule it.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/metric/tensor.h"

namespace pillowmesh {

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim, Eigen::DontAlign>;

/// The edge vectors out of a corner, in axis order.
template <int Dim>
struct Frame {
  std::array<Point<Dim>, Dim> e;
  Point<Dim>& operator[](int d) { return e[d]; }
  const Point<Dim>& operator[](int d) const { return e[d]; }
};

template <int Dim>
inline Matrix<Dim> to_matrix(const SymTensor<Dim>& t) {
  Matrix<Dim> m;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) m(i, j) = t(i, j);
  return m;
}

/// The metric at a vertex in the form that the energy wants: M, M^-1 and sqrt(det M).
template <int Dim>
struct CornerMetric {
  SymTensor<Dim> M;
  SymTensor<Dim> inverse;
  double root_determinant;
};

template <int Dim>
inline CornerMetric<Dim> corner_metric(const SymTensor<Dim>& M) {
  const double det = determinant(M), inv = 1.0 / det;
  return {M, inv * adjugate(M), std::sqrt(det)};
}

template <int Dim>
inline Point<Dim> multiply(const SymTensor<Dim>& M, const Point<Dim>& v) {
  Point<Dim> out;
  for (int i = 0; i < Dim; ++i) {
    double sum = 0.0;
    for (int j = 0; j < Dim; ++j) sum += M(i, j) * v[j];
    out[i] = sum;
  }
  return out;
}

/// Cofactor vectors c_j of A: c_j . e_j = det A.
inline Frame<2> cofactors(const Frame<2>& e) {
  return {{Point<2>(e[1][1], -e[1][0]), Point<2>(-e[0][1], e[0][0])}};
}
inline Frame<3> cofactors(const Frame<3>& e) {
  return {{vector_product(e[1], e[2]), vector_product(e[2], e[0]), vector_product(e[0], e[1])}};
}

/// Length of an edge from its lengths a and b in the metrics at its two ends, the size varying linearly between them: the
/// logarithmic mean (a - b) / ln(a / b), by a rational approximation (2e-3 at a ratio of 4).
inline double mean_length(double a, double b) {
  const double r = (a - b) / (a + b), r2 = r * r;
  return 0.5 * (a + b) * (15 - 9 * r2) / (15 - 4 * r2);
}
/// What keeps metric volume from being a free good: without it cells where the mesh is too dense are not spread.
/// Measured on the paper's cases 1 to 3 (docs/algorithm.md): 0 costs shape, 1 costs size.
inline constexpr double size_weight = 0.45;

/// The energy of a corner with edge vectors e, whose axes form a frame of the given sign (Cell::corner_sign).
/// Infinite when the corner is degenerate or inside out.
template <int Dim>
inline double corner_energy(const Frame<Dim>& e, int sign, const CornerMetric<Dim>& metric) {
  const auto c = cofactors(e);
  const double d = sign * c[0].dot(e[0]);
  if (!(d > 0)) return std::numeric_limits<double>::infinity();
  double T = 0.0, N = 0.0;
  for (int j = 0; j < Dim; ++j) {
    T += dot(metric.M, e[j], e[j]);
    N += dot(metric.inverse, c[j], c[j]);
  }
  return metric.root_determinant * d * ((T + N / (d * d)) / (2 * Dim) - 1.0 + size_weight);
}

/// Sum of value, gradient and Hessian with respect to the position of one vertex.
template <int Dim>
struct Derivatives {
  double value = 0.0;
  Point<Dim> gradient = Point<Dim>::Zero();
  Matrix<Dim> hessian = Matrix<Dim>::Zero();
};

/// How a corner's edges depend on the position x of a vertex: d e_j / d x = slope[j] I with the metric held fixed, and
/// d |e_j|_M / d x = frozen length's gradient + length_gradient[j], what the metric's change along the edge adds.
template <int Dim>
struct EdgeSlopes {
  std::array<double, Dim> slope;
  std::array<Point<Dim>, Dim> length_gradient;
};

/// Adds a corner's energy and its derivatives. The Hessian is that of the fixed metric. \pre the corner is not
/// degenerate.
template <int Dim>
void add_corner_derivatives(const Frame<Dim>& e, int sign, const CornerMetric<Dim>& metric,
                            const EdgeSlopes<Dim>& slopes, Derivatives<Dim>& sum);

/// A corner of which one edge moves and the others are held: as a function of that edge e,
/// T = t0 + e' M e, N = n0 + e' Q e and d = c . e, so that energy and derivatives are a few products.
template <int Dim>
struct HeldCorner {
  SymTensor<Dim> M, Q;
  Point<Dim> c;
  double t0, n0, root_determinant;
};

/// Holds all edges but `end` of a corner. e[end] is not read.
template <int Dim>
HeldCorner<Dim> hold_corner(const Frame<Dim>& e, int sign, const CornerMetric<Dim>& metric, int end);

/// The corner's energy with its moving edge at e; infinite when it is degenerate or inside out.
template <int Dim>
inline double held_energy(const HeldCorner<Dim>& h, const Point<Dim>& e) {
  const double d = h.c.dot(e);
  if (!(d > 0)) return std::numeric_limits<double>::infinity();
  const double T = h.t0 + dot(h.M, e, e), N = h.n0 + dot(h.Q, e, e);
  return h.root_determinant * ((T * d + N / d) / (2 * Dim) + (size_weight - 1.0) * d);
}

/// Adds the energy and its derivatives, where d e / d x = slope I; `length_gradient` as in EdgeSlopes.
template <int Dim>
void add_held_derivatives(const HeldCorner<Dim>& h, const Point<Dim>& e, double slope,
                          const Point<Dim>& length_gradient, Derivatives<Dim>& sum);

}  // namespace pillowmesh
