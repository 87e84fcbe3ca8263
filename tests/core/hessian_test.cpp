#include "pillowmesh/metric/hessian.h"

#include <cmath>
#include <random>

#include "../catch.h"
#include "pillowmesh/metric/spectrum.h"

namespace hessian_test {

using namespace pillowmesh;

namespace {

template <int Dim>
FormulaHessian<Dim> hessian(std::string_view text) {
  auto h = FormulaHessian<Dim>::from_formula(text);
  INFO(h.status().message);
  REQUIRE(h);
  return *h;
}

std::string error_of(std::string_view text) { return FormulaHessian<2>::from_formula(text).status().message; }
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A grid whose vertices are moved at random and then stretched.
template <int Dim>
NodalMetric<Dim> shaken(int n, double stretch) {
  std::array<int, Dim> count;
  count.fill(n);
  NodalMetric<Dim> grid = nodal_grid<Dim>(count, Point<Dim>::Zero(), Point<Dim>::Ones());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.25 / n, 0.25 / n);
  for (Point<Dim>& p : grid.points) {
    for (int d = 0; d < Dim; ++d) p[d] += any(random);
    p[1] *= stretch;
  }
  return grid;
}

template <int Dim>
void check_quadratic(double stretch) {
  const NodalMetric<Dim> m = shaken<Dim>(6, stretch);
  SymTensor<Dim> H;
  for (int k = 0; k < SymTensor<Dim>::size; ++k) H.m[k] = 0.7 * k - 1.3;
  std::vector<double> values;
  for (const Point<Dim>& p : m.points) values.push_back(4.0 + 3.0 * p[0] - 2.0 * p[1] + 0.5 * dot(H, p, p));
  const auto found = recover_hessian<Dim>(m.points, m.simplices, values);
  for (const SymTensor<Dim>& F : found)  // at the corners of the boundary too
    for (int k = 0; k < SymTensor<Dim>::size; ++k) CHECK(F.m[k] == Approx(H.m[k]).margin(1e-9 / (stretch * stretch)));
}

}  // namespace

TEST_CASE("the Hessian of a quadratic formula is its matrix, everywhere") {
  const auto flat = hessian<2>("3*x^2 - 4*x*y + y^2/2 + 7*x");
  const std::vector<Point<2>> points{{0.0, 0.0}, {0.3, -2.0}, {5.0, 1.0}};
  std::vector<SymTensor<2>> H(3);
  flat.evaluate(points, H);
  for (const auto& h : H) CHECK(h == SymTensor<2>{{6.0, -4.0, 1.0}});
  const auto solid = hessian<3>("a = x*y; f = a + 2*z^2 - x*z");
  std::vector<SymTensor<3>> S(1);
  solid.evaluate(std::vector<Point<3>>{{1.0, 2.0, 3.0}}, S);
  CHECK(S[0] == SymTensor<3>{{0.0, 1.0, 0.0, -1.0, 0.0, 4.0}});
}

TEST_CASE("mistakes in a function are reported with the column that the user typed") {
  CHECK(contains(error_of("tanh(20*(x-.5*sin(3*w)))"), "column 21: unknown name 'w'"));
  CHECK(contains(error_of("a = x; g = a^2"), "do not assign 'f'"));
  CHECK(contains(error_of("a = q"), "column 5"));
  CHECK(FormulaHessian<2>::from_formula("if(x <= y, x^2, y^2)").ok());
}

TEST_CASE("recovered Hessians are exact for quadratics, inside and at the boundary, on stretched meshes too") {
  check_quadratic<2>(1.0);
  check_quadratic<2>(1e-3);
  check_quadratic<3>(1.0);
}

TEST_CASE("recovered Hessians of a smooth function converge") {
  const auto error = [](int n) {
    const NodalMetric<2> m = nodal_grid<2>({n, n}, {0.0, 0.0}, {1.0, 1.0});
    std::vector<double> values;
    for (const Point<2>& p : m.points) values.push_back(std::sin(3.0 * p[0]) * std::exp(p[1]));
    const auto found = recover_hessian<2>(m.points, m.simplices, values);
    double worst = 0.0;
    for (std::size_t v = 0; v < m.points.size(); ++v) {
      const Point<2> p = m.points[v];
      worst = std::max(worst, std::fabs(found[v].m[0] + 9.0 * std::sin(3.0 * p[0]) * std::exp(p[1])));
    }
    return worst;
  };
  CHECK(error(40) < 0.6 * error(20));  // first order at the boundary
}

TEST_CASE("a metric of equal curvature has the sizes that give the error asked for") {
  // f = 50 x^2 + 2 y^2, H = diag(100, 4): bilinear interpolation on a cell hx by hy errs by (hx^2 100 + hy^2 4) / 8.
  for (const double p : {1.0, 2.0, 1e300}) {
    NodalMetric<2> m = nodal_grid<2>({2, 2}, {0.0, 0.0}, {1.0, 1.0});
    for (auto& H : m.tensors) H = {{100.0, 0.0, -4.0}};
    REQUIRE(multiscale_metric(m, {.norm = p, .error = 1e-3}).ok());
    const double hx2 = 1.0 / m.tensors[0].m[0], hy2 = 1.0 / m.tensors[0].m[2];
    CHECK(hx2 * 100.0 == Approx(hy2 * 4.0));
    CHECK((hx2 * 100.0 + hy2 * 4.0) / 8.0 == Approx(1e-3));
  }
}

TEST_CASE("a small norm gives weak features their share") {
  // Curvatures 1e4 and 1: for n = 2 the ratio of densities sqrt(det M) is (1e4)^(2p / (2p + 2)).
  for (const double p : {1.0, 4.0}) {
    NodalMetric<2> m = nodal_grid<2>({1, 1}, {0.0, 0.0}, {1.0, 1.0});
    for (std::size_t i = 0; i < 4; ++i) m.tensors[i] = (i == 0 ? 1e4 : 1.0) * SymTensor<2>::isotropic(1.0);
    REQUIRE(multiscale_metric(m, {.norm = p, .floor = 1e-6}).ok());
    CHECK(std::sqrt(determinant(m.tensors[0]) / determinant(m.tensors[1])) == Approx(std::pow(1e4, p / (p + 1.0))));
  }
}

TEST_CASE("a linear function has no metric") {
  const auto metric = hessian_metric<2>(hessian<2>("x + 2*y"), {0.0, 0.0}, {1.0, 1.0}, {});
  CHECK(contains(metric.status().message, "no curvature"));
}

TEST_CASE("the sampled metric of a shock is thin across it and long along it") {
  const auto metric =
      hessian_metric<2>(hessian<2>("tanh(20*(x-.5*sin(3*y)))"), {-1.0, -1.0}, {1.0, 1.0}, {.error = 0.01});
  REQUIRE(metric);
  const auto field = *look_up(*metric);
  // At y = 0 the shock's normal is (1, -1.5); next to its middle the curvature is largest.
  const Spectrum<2> s = spectrum(field.evaluate(Point<2>(0.03, 0.0)));
  CHECK(std::fabs(s.vector[1].dot(Point<2>(1.0, -1.5).normalized())) > 0.999);
  CHECK(std::sqrt(s.value[1] / s.value[0]) > 5.0);
  CHECK(metric->points.size() < 100'000);
}

}  // namespace hessian_test
