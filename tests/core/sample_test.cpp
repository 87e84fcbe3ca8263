#include "pillowmesh/metric/sample.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "../catch.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/metric/spectrum.h"
#include "simplices.h"

namespace sample_test {

using namespace pillowmesh;

namespace {

template <int Dim>
NodalMetric<Dim> sampled(const MetricField<Dim>& field, double low, double high) {
  const Evaluate<Dim> all = [&](std::span<const Point<Dim>> p, std::span<SymTensor<Dim>> out) {
    field.evaluate(p, out);
  };
  return sample<Dim>(all, Point<Dim>::Constant(low), Point<Dim>::Constant(high));
}

/// Share of random points at which sizes are off by more than 3 %.
template <int Dim>
double share_off(const NodalMetric<Dim>& nodal, const MetricField<Dim>& field, double low, double high) {
  const auto again = *look_up(nodal);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(low, high);
  int off = 0;
  for (int i = 0; i < 2000; ++i) {
    Point<Dim> p;
    for (int d = 0; d < Dim; ++d) p[d] = any(random);
    const auto gap = log_tensor(again.evaluate(p)) + (-1.0) * log_tensor(field.evaluate(p));
    const auto s = spectrum(gap);
    off += std::max(-s.value[0], s.value[Dim - 1]) > 0.06;
  }
  return off / 2000.0;
}

}  // namespace

TEST_CASE("a sampled metric is the metric, within the tolerance, on a conforming background") {
  const auto circle = *MetricField<2>::from_formula(find_case("circle2d")->formula);
  const auto nodal = sampled(circle, -1.0, 1.0);
  CHECK(checks::conforming(nodal, -1.0, 1.0));
  CHECK(share_off(nodal, circle, -1.0, 1.0) < 0.02);
  CHECK(nodal.points.size() < 60'000);
  const auto sphere = *MetricField<3>::from_formula(find_case("linear3d")->formula);
  const auto solid = sampled(sphere, 0.0, 1.0);
  CHECK(checks::conforming(solid, 0.0, 1.0));
  CHECK(share_off(solid, sphere, 0.0, 1.0) < 0.02);
}

TEST_CASE("a constant metric needs no more than the first grid") {
  const auto nodal = sampled(*MetricField<2>::from_formula("h = 0.01"), 0.0, 1.0);
  CHECK(nodal.points.size() == 33 * 33);
}

TEST_CASE("where the formula holds no metric the neighbours' is taken") {
  const auto half = *MetricField<2>::from_formula("h = 0.1 + sqrt(x)");  // not a number for x < 0
  const auto nodal = sampled(half, -1.0, 1.0);
  const auto again = look_up(nodal);
  REQUIRE(again);
  CHECK(again->evaluate(Point<2>(0.5, 0.1)).m[0] == Approx(half.evaluate(Point<2>(0.5, 0.1)).m[0]).epsilon(0.05));
  CHECK(again->evaluate(Point<2>(-0.9, 0.0)).m[0] > 30.0);
}

TEST_CASE("sampling a jump or a point of zero size ends") {
  SampleOptions options;
  options.max_points = 20'000;
  for (const char* text : {"h = if(x*x + y*y < 0.3, 0.001, 0.2)", "h = r"}) {
    const auto field = *MetricField<2>::from_formula(text);
    const Evaluate<2> all = [&](std::span<const Point<2>> p, std::span<SymTensor<2>> out) { field.evaluate(p, out); };
    CHECK(sample<2>(all, {-1.0, -1.0}, {1.0, 1.0}, options).points.size() < 60'000);
  }
}

}  // namespace sample_test
