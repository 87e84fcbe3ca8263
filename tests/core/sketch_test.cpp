#include "pillowmesh/metric/sketch.h"

#include <cmath>
#include <numbers>

#include "../catch.h"
#include "pillowmesh/metric/spectrum.h"

namespace sketch_test {

using namespace pillowmesh;

namespace {

std::array<double, 2> sizes(const MetricField<2>& field, double x, double y) {
  const Spectrum<2> s = spectrum(field.evaluate(Point<2>(x, y)));
  return {1.0 / std::sqrt(s.value[1]), 1.0 / std::sqrt(s.value[0])};
}
MetricField<2> sketch(const std::vector<Dab>& dabs) {
  auto metric = sketch_metric(dabs, 0.2, {0.0, 0.0}, {1.0, 1.0});
  REQUIRE(metric);
  return *look_up(*metric);
}

}  // namespace

TEST_CASE("inside of a dab is its size, beyond twice its radius that of the paper") {
  const auto field = sketch({{0.3, 0.4, 0.1, 0.01}});
  CHECK(sizes(field, 0.3, 0.4)[0] == Approx(0.01).epsilon(0.02));
  CHECK(sizes(field, 0.36, 0.45)[0] == Approx(0.01).epsilon(0.03));
  CHECK(sizes(field, 0.55, 0.4)[0] == Approx(0.2).epsilon(0.02));
  // Half way the size is the geometric mean.
  CHECK(sizes(field, 0.45, 0.4)[0] == Approx(std::sqrt(0.2 * 0.01)).epsilon(0.05));
}

TEST_CASE("a dab with a direction stretches cells along it") {
  const double angle = std::numbers::pi / 6;
  const auto field = sketch({{0.5, 0.5, 0.2, 0.01, angle, 5.0}});
  const Spectrum<2> s = spectrum(field.evaluate(Point<2>(0.5, 0.5)));
  CHECK(1.0 / std::sqrt(s.value[1]) == Approx(0.01));
  CHECK(1.0 / std::sqrt(s.value[0]) == Approx(0.05));
  CHECK(std::fabs(s.vector[0].dot(Point<2>(std::cos(angle), std::sin(angle)))) == Approx(1.0));
}

TEST_CASE("dabs intersect: the finer one counts; without the last one it is as before") {
  const std::vector<Dab> one{{0.5, 0.5, 0.2, 0.02}}, two{{0.5, 0.5, 0.2, 0.02}, {0.5, 0.5, 0.05, 0.005}};
  CHECK(sizes(sketch(two), 0.5, 0.5)[0] == Approx(0.005));
  CHECK(sizes(sketch(two), 0.65, 0.5)[0] == Approx(0.02).epsilon(0.02));
  const auto before = sketch_metric(one, 0.2, {0.0, 0.0}, {1.0, 1.0});
  std::vector<Dab> undone = two;
  undone.pop_back();
  CHECK(sketch_metric(undone, 0.2, {0.0, 0.0}, {1.0, 1.0})->tensors == before->tensors);
}

TEST_CASE("a small dab is not missed between the points of the background") {
  CHECK(sizes(sketch({{0.515, 0.485, 0.006, 0.002}}), 0.515, 0.485)[0] == Approx(0.002).epsilon(0.05));
}

TEST_CASE("nothing drawn is the paper alone; impossible dabs are named") {
  CHECK(sizes(sketch({}), 0.5, 0.5)[1] == Approx(0.2));
  const auto refused = [](std::vector<Dab> dabs, double paper = 0.2) {
    return sketch_metric(dabs, paper, {0.0, 0.0}, {1.0, 1.0}).status().message;
  };
  CHECK(refused({{0.5, 0.5, 0.1, 0.1}, {0.5, 0.5, 0.0, 0.1}}).find("dab 2") != std::string::npos);
  CHECK(refused({{0.5, 0.5, 0.1, 0.1, 0.0, 0.5}}).find("dab 1") != std::string::npos);
  CHECK(refused({}, 0.0).find("positive") != std::string::npos);
}

}  // namespace sketch_test
