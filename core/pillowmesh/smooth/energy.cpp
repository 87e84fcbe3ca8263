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
                            const std::array<double, Dim>& slope, Derivatives<Dim>& sum) {
  const auto c = cofactors(e);
  std::array<Matrix<Dim>, Dim> C;
  cofactor_derivatives(e, slope, C);
  const double d = sign * c[0].dot(e[0]);
  const Matrix<Dim> W = to_matrix(metric.inverse);

  double T = 0.0, N = 0.0, slope2 = 0.0;
  Point<Dim> dT = Point<Dim>::Zero(), dN = Point<Dim>::Zero(), dd = Point<Dim>::Zero();
  Matrix<Dim> HN = Matrix<Dim>::Zero();
  for (int j = 0; j < Dim; ++j) {
    const Point<Dim> Me = multiply(metric.M, e[j]), Wc = multiply(metric.inverse, c[j]);
    T += e[j].dot(Me);
    N += c[j].dot(Wc);
    slope2 += slope[j] * slope[j];
    dT += (2.0 * slope[j]) * Me;
    dd += (slope[j] * sign) * c[j];
    const Matrix<Dim> Ct = C[j].transpose();
    dN += 2.0 * (Ct * Wc);
    HN += 2.0 * (Ct * W * C[j]);
  }
  const double i2 = 1.0 / (d * d), i3 = i2 / d, i4 = i2 * i2;
  sum.value += T + N * i2;
  sum.gradient += dT + i2 * dN - (2.0 * N * i3) * dd;
  const Matrix<Dim> mixed = dN * dd.transpose();
  sum.hessian += (2.0 * slope2) * to_matrix(metric.M) + i2 * HN - (2.0 * i3) * (mixed + mixed.transpose()) +
                 (6.0 * N * i4) * (dd * dd.transpose());
}

template void add_corner_derivatives<2>(const Frame<2>&, int, const CornerMetric<2>&, const std::array<double, 2>&,
                                        Derivatives<2>&);
template void add_corner_derivatives<3>(const Frame<3>&, int, const CornerMetric<3>&, const std::array<double, 3>&,
                                        Derivatives<3>&);

}  // namespace pillowmesh
