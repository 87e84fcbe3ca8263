#include "pillowmesh/smooth/energy.h"

namespace pillowmesh {
namespace {

/// Matrix of x -> v x x.
Matrix<3> skew(const Point<3>& v) {
  Matrix<3> m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

/// d c_j / d x
void cofactor_derivatives(const Frame<2>&, const std::array<double, 2>& slope, std::array<Matrix<2>, 2>& out) {
  Matrix<2> turn;  // c_0 = -turn e_1, c_1 = turn e_0
  turn << 0, -1, 1, 0;
  out[0] = -slope[1] * turn;
  out[1] = slope[0] * turn;
}
void cofactor_derivatives(const Frame<3>& e, const std::array<double, 3>& slope, std::array<Matrix<3>, 3>& out) {
  for (int j = 0; j < 3; ++j) {
    const int a = (j + 1) % 3, b = (j + 2) % 3;  // c_j = e_a x e_b
    out[j] = slope[b] * skew(e[a]) - slope[a] * skew(e[b]);
  }
}

}  // namespace

template <int Dim>
void add_corner_derivatives(const Frame<Dim>& e, int sign, const CornerMetric<Dim>& metric,
                            const EdgeSlopes<Dim>& slopes, Derivatives<Dim>& sum) {
  const auto c = cofactors(e);
  std::array<Matrix<Dim>, Dim> C;
  cofactor_derivatives(e, slopes.slope, C);
  const double d = sign * c[0].dot(e[0]);
  const Matrix<Dim> W = to_matrix(metric.inverse);

  // f = T + N / d^2 with T = sum e_j' M e_j and N = sum c_j' M^-1 c_j.
  double T = 0.0, N = 0.0, slope2 = 0.0;
  Point<Dim> dT = Point<Dim>::Zero(), dN = Point<Dim>::Zero(), dd = Point<Dim>::Zero();
  Point<Dim> by_lengths = Point<Dim>::Zero(), dd_by_lengths = Point<Dim>::Zero();
  Matrix<Dim> HN = Matrix<Dim>::Zero();
  for (int j = 0; j < Dim; ++j) {
    const double slope = slopes.slope[j];
    const Point<Dim> Me = multiply(metric.M, e[j]), Wc = multiply(metric.inverse, c[j]);
    const double l2 = e[j].dot(Me), n = c[j].dot(Wc);
    T += l2;
    N += n;
    slope2 += slope * slope;
    dT += (2.0 * slope) * Me;
    dd += (slope * sign) * c[j];
    if (slope != 0.0) {
      // d f / d l_j = 2 (l_j - s_j / l_j^3), and d is proportional to l_j.
      const double l = std::sqrt(l2);
      by_lengths += 2.0 * (l - n / (d * d * l)) * slopes.length_gradient[j];
      dd_by_lengths += d / l * slopes.length_gradient[j];
    }
    if constexpr (Dim == 3)
      if (slopes.slope[(j + 1) % 3] == 0.0 && slopes.slope[(j + 2) % 3] == 0.0) continue;  // c_j stays
    const Matrix<Dim> Ct = C[j].transpose();
    dN += 2.0 * (Ct * Wc);
    HN += 2.0 * (Ct * (W * C[j]));
  }
  const double i2 = 1.0 / (d * d), i3 = i2 / d, i4 = i2 * i2;
  const Matrix<Dim> cross_terms = dN * dd.transpose();
  Matrix<Dim> Hf = (2.0 * slope2) * to_matrix(metric.M) + i2 * HN - (2.0 * i3) * (cross_terms + cross_terms.transpose()) +
                   (6.0 * N * i4) * (dd * dd.transpose());
  const Point<Dim> df = dT + i2 * dN - (2.0 * N * i3) * dd + by_lengths;
  dd += dd_by_lengths;

  // E = r d (q f + w).
  const double q = 1.0 / (2 * Dim), r = metric.root_determinant, w = q * (T + N * i2) - 1.0 + size_weight;
  const Matrix<Dim> mixed = dd * df.transpose();
  sum.value += r * d * w;
  sum.gradient += r * (w * dd + (d * q) * df);
  sum.hessian += (r * q) * (d * Hf + mixed + mixed.transpose());
}

template void add_corner_derivatives<2>(const Frame<2>&, int, const CornerMetric<2>&, const EdgeSlopes<2>&,
                                        Derivatives<2>&);
template void add_corner_derivatives<3>(const Frame<3>&, int, const CornerMetric<3>&, const EdgeSlopes<3>&,
                                        Derivatives<3>&);

template <int Dim>
HeldCorner<Dim> hold_corner(const Frame<Dim>& e, int sign, const CornerMetric<Dim>& metric, int end) {
  HeldCorner<Dim> h;
  h.M = metric.M;
  h.root_determinant = metric.root_determinant;
  h.c = sign * cofactors(e)[end];  // does not contain e[end]
  h.n0 = dot(metric.inverse, h.c, h.c);
  h.t0 = 0.0;
  h.Q = {};
  std::array<double, Dim> slope{};
  slope[end] = 1.0;
  std::array<Matrix<Dim>, Dim> C;  // d c_j / d e[end]
  cofactor_derivatives(e, slope, C);
  const Matrix<Dim> W = to_matrix(metric.inverse);
  for (int j = 0; j < Dim; ++j) {
    if (j == end) continue;
    h.t0 += dot(metric.M, e[j], e[j]);
    const Matrix<Dim> WC = W * C[j];
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) h.Q(a, b) += C[j].col(a).dot(WC.col(b));
  }
  return h;
}

template <int Dim>
void add_held_derivatives(const HeldCorner<Dim>& h, const Point<Dim>& e, double slope,
                          const Point<Dim>& length_gradient, Derivatives<Dim>& sum) {
  const Point<Dim> Me = multiply(h.M, e), Qe = multiply(h.Q, e);
  const double d = h.c.dot(e), i = 1.0 / d, l2 = e.dot(Me);
  const double T = h.t0 + l2, N = h.n0 + e.dot(Qe);
  const double q = h.root_determinant / (2 * Dim), w = h.root_determinant * (size_weight - 1.0);
  // E = q (T d + N / d) + w d
  const Point<Dim> dE = (2.0 * q * d) * Me + (2.0 * q * i) * Qe + (q * (T - N * i * i) + w) * h.c;
  sum.value += q * (T * d + N * i) + w * d;
  sum.gradient += slope * dE + (dE.dot(e) / std::sqrt(l2)) * length_gradient;
  const Point<Dim> u = (2.0 * q) * Me - (2.0 * q * i * i) * Qe + (q * N * i * i * i) * h.c;
  const double s2 = slope * slope;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b)
      sum.hessian(a, b) += s2 * (2.0 * q * (d * h.M(a, b) + i * h.Q(a, b)) + u[a] * h.c[b] + h.c[a] * u[b]);
}

template HeldCorner<2> hold_corner(const Frame<2>&, int, const CornerMetric<2>&, int);
template HeldCorner<3> hold_corner(const Frame<3>&, int, const CornerMetric<3>&, int);
template void add_held_derivatives(const HeldCorner<2>&, const Point<2>&, double, const Point<2>&, Derivatives<2>&);
template void add_held_derivatives(const HeldCorner<3>&, const Point<3>&, double, const Point<3>&, Derivatives<3>&);

}  // namespace pillowmesh
