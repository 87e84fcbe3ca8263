#include "pillowmesh/metric/discrete.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "../catch.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/metric/nodal.h"
#include "pillowmesh/metric/spectrum.h"

namespace discrete_test {

using namespace pillowmesh;

namespace {

template <int Dim>
double relative_difference(const SymTensor<Dim>& a, const SymTensor<Dim>& b) {
  double difference = 0.0, size = 0.0;
  for (int k = 0; k < SymTensor<Dim>::size; ++k) {
    difference = std::max(difference, std::fabs(a.m[k] - b.m[k]));
    size = std::max(size, std::fabs(b.m[k]));
  }
  return difference / size;
}

/// A background whose logarithms are `log`, at its vertices.
template <int Dim, class F>
MetricField<Dim> from_logs(int n, F log) {
  std::array<int, Dim> count;
  count.fill(n);
  NodalMetric<Dim> grid = nodal_grid<Dim>(count, Point<Dim>::Zero(), Point<Dim>::Ones());
  for (std::size_t i = 0; i < grid.points.size(); ++i) grid.tensors[i] = exp_tensor<Dim>(log(grid.points[i]));
  return *look_up(std::move(grid));
}

template <int Dim>
Point<Dim> random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Point<Dim> p;
  for (int d = 0; d < Dim; ++d) p[d] = any(random);
  return p;
}

SymTensor<2> affine(const Point<2>& p) { return {{3.0 + p[0], 0.7 - 2.0 * p[1], p[0] - 4.0 * p[1]}}; }
SymTensor<3> affine(const Point<3>& p) {
  return {{8.0 + p[0], 0.7 - 2.0 * p[1], p[0] - 4.0 * p[2], p[2], 1.0 - p[0], 9.0 * p[1]}};
}

template <int Dim>
void check_affine() {
  const auto field = from_logs<Dim>(5, [](const Point<Dim>& p) { return affine(p); });
  std::mt19937 random(9);
  for (int i = 0; i < 500; ++i) {
    const Point<Dim> p = random_point<Dim>(random);
    CHECK(relative_difference(field.evaluate(p), exp_tensor(affine(p))) < 1e-11);
  }
}

/// Points anywhere, on vertices, edges and facets of the background, on its boundary to rounding, and outside, in three
/// orders: as they come, sorted (short walks), and one by one.
template <int Dim>
void check_independence() {
  const auto field = from_logs<Dim>(7, [](const Point<Dim>& p) { return affine(p); });
  std::mt19937 random(8);
  std::vector<Point<Dim>> points;
  for (int i = 0; i < 400; ++i) points.push_back(random_point<Dim>(random));
  for (int i = 0; i <= 70; ++i) points.push_back(Point<Dim>::Constant(i / 70.0));
  for (int i = 0; i < 400; ++i) {
    Point<Dim> p = random_point<Dim>(random);
    const int axis = i % Dim;
    p[axis] = static_cast<double>(random() % 8) / 7.0;
    if (i % 3 == 0) p[(axis + 1) % Dim] = p[axis];
    if (i % 5 == 0) p[axis] += 2e-16 * (static_cast<double>(random() % 5) - 2.0);
    if (i % 11 == 0) p[axis] = 1.2;
    points.push_back(p);
  }
  std::vector<SymTensor<Dim>> together(points.size()), sorted(points.size());
  field.evaluate(points, together);
  for (std::size_t i = 0; i < points.size(); ++i) CHECK(field.evaluate(points[i]) == together[i]);
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a][0] < points[b][0]; });
  std::vector<Point<Dim>> in_order;
  for (const std::size_t i : order) in_order.push_back(points[i]);
  field.evaluate(in_order, sorted);
  for (std::size_t k = 0; k < order.size(); ++k) CHECK(sorted[k] == together[order[k]]);
}

}  // namespace

TEST_CASE("a constant tensor comes back from any place, inside and outside of the background") {
  SymTensor<3> M = SymTensor<3>::isotropic(0.1);
  M(0, 2) = 30.0;
  const auto field = from_logs<3>(3, [&](const Point<3>&) { return log_tensor(M); });
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    const Point<3> p = 3.0 * random_point<3>(random) - Point<3>(1.0, 1.0, 1.0);
    CHECK(relative_difference(field.evaluate(p), M) < 1e-12);
  }
}

TEST_CASE("logarithms are interpolated linearly: an affine logarithm is met exactly") {
  check_affine<2>();
  check_affine<3>();
}

TEST_CASE("sizes between two vertices are geometric means") {
  NodalMetric<2> two{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}, {{0, 1, 2}}, {}};
  for (const double h : {0.01, 1.0, 0.01}) two.tensors.push_back(SymTensor<2>::isotropic(h));
  const auto field = *look_up(two);
  CHECK(1.0 / std::sqrt(field.evaluate(Point<2>(0.5, 0.0))(0, 0)) == Approx(0.1));
  // The length of an edge along which h = 0.01 * 100^x: the integral of 1 / h.
  CHECK(edge_length<2>(field, {0.0, 0.0}, {1.0, 0.0}) == Approx(99.0 / std::log(100.0)).epsilon(1e-8));
}

TEST_CASE("values do not depend on what was asked before, nor on the batch") {
  check_independence<2>();
  check_independence<3>();
}

TEST_CASE("lengths are right across the kinks of a background") {
  // log M piecewise affine along x with kinks at multiples of 1/8: the exact length is a sum over the pieces.
  const int n = 8;
  const auto wave = [](double x) { return std::sin(9.0 * x); };
  const auto field = from_logs<2>(n, [&](const Point<2>& p) {
    return SymTensor<2>{{2.0 * wave(p[0]), 0.0, 2.0 * wave(p[0])}};
  });
  double exact = 0.0;
  for (int i = 0; i < n; ++i) {  // integral of exp(linear function)
    const double a = wave(i / 8.0), b = wave((i + 1) / 8.0);
    exact += (std::exp(b) - std::exp(a)) / (b - a) / n;
  }
  CHECK(edge_length<2>(field, {0.0, 0.3}, {1.0, 0.3}) == Approx(exact).epsilon(2e-5));
  CHECK(edge_length<2>(field, {0.0, 0.3}, {1.0, 0.3}) == edge_length<2>(field, {1.0, 0.3}, {0.0, 0.3}));
}

TEST_CASE("exponentials of lanes are the tensors' exponentials, from tiny to large") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const double size : {0.0, 1e-9, 1e-4, 1.0, 12.0}) {
    TensorLanes<3> lanes;
    TensorLanes<2> flat;
    std::array<SymTensor<3>, 16> of_lane;
    std::array<SymTensor<2>, 16> of_flat;
    for (int i = 0; i < 16; ++i) {
      for (int k = 0; k < 6; ++k) lanes[k][i] = of_lane[i].m[k] = size * any(random);
      for (int k = 0; k < 3; ++k) flat[k][i] = of_flat[i].m[k] = size * any(random);
    }
    exp_lanes<3>(16, lanes);
    exp_lanes<2>(16, flat);
    for (int i = 0; i < 16; ++i) {
      SymTensor<3> M;
      SymTensor<2> F;
      for (int k = 0; k < 6; ++k) M.m[k] = lanes[k][i];
      for (int k = 0; k < 3; ++k) F.m[k] = flat[k][i];
      CHECK(relative_difference(M, exp_tensor(of_lane[i])) < 2e-12);
      CHECK(relative_difference(F, exp_tensor(of_flat[i])) < 2e-13);
    }
  }
}

TEST_CASE("a background without volume, or with wrong numbers, is refused") {
  using Made = DiscreteMetric<2>;
  const std::vector<Point<2>> points{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  CHECK(Made::make(points, {{0, 1, 2}}, {{}, {}, {}}).status().message.find("no cell with a volume") !=
        std::string::npos);
  CHECK(Made::make(points, {{0, 1, 3}}, {{}, {}, {}}).status().message.find("vertex 3 of 3") != std::string::npos);
  CHECK(Made::make(points, {{0, 1, 2}}, {{}, {}}).status().message.find("2 tensors") != std::string::npos);
}

}  // namespace discrete_test
