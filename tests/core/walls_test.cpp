#include "pillowmesh/metric/walls.h"

#include <cmath>
#include <numbers>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/spectrum.h"

namespace walls_test {

using namespace pillowmesh;

namespace {

template <int Dim>
MetricField<Dim> field(Expected<NodalMetric<Dim>> metric) {
  INFO(metric.status().message);
  REQUIRE(metric);
  return *look_up(std::move(*metric));
}

}  // namespace

TEST_CASE("layers at a wall grow geometrically and lie along it") {
  const auto mesh = make_grid<2>({4, 4}, {0.0, 0.0}, {1.0, 1.0});
  const auto f = field(wall_metric<2>(mesh, {{"ymin", 0.01, 1.3, 0.2}}));
  // Heights 0.01, 0.013, ...: the n-th layer starts at (1.3^n - 1) / 0.3 * 0.01.
  for (int n = 0; n < 8; ++n) {
    const double start = (std::pow(1.3, n) - 1.0) / 0.3 * 0.01, height = 0.01 * std::pow(1.3, n);
    const auto M = f.evaluate(Point<2>(0.37, start));
    CHECK(1.0 / std::sqrt(M.m[2]) == Approx(height).epsilon(0.02));
    CHECK(1.0 / std::sqrt(M.m[0]) == Approx(0.2).epsilon(0.02));
  }
  CHECK(1.0 / std::sqrt(f.evaluate(Point<2>(0.4, 0.95)).m[2]) == Approx(0.2).epsilon(0.02));
}

TEST_CASE("layers follow a curved wall, and those of two walls intersect") {
  const auto ring = std::get<Mesh<2>>(*parse_primitive("ring:64,4:1,2"));
  const auto f = field(wall_metric<2>(ring, {{"all", 0.01, 1.2, 0.3}}));
  const double a = 0.7;
  const Spectrum<2> s = spectrum(f.evaluate(Point<2>(1.05 * std::cos(a), 1.05 * std::sin(a))));
  CHECK(std::fabs(s.vector[1].dot(Point<2>(std::cos(a), std::sin(a)))) > 0.99);
  CHECK(1.0 / std::sqrt(s.value[1]) == Approx(0.01 + 0.2 * 0.05).epsilon(0.05));
  const auto square = make_grid<2>({4, 4}, {0.0, 0.0}, {1.0, 1.0});
  const auto both = field(wall_metric<2>(square, {{"xmin", 0.01, 1.2, 0.2}, {"ymin", 0.02, 1.2, 0.2}}));
  const auto M = both.evaluate(Point<2>(0.0, 0.0));
  CHECK(1.0 / std::sqrt(M.m[0]) == Approx(0.01).epsilon(0.02));
  CHECK(1.0 / std::sqrt(M.m[2]) == Approx(0.02).epsilon(0.02));
}

TEST_CASE("layers on the floor of a box") {
  const auto box = make_grid<3>({2, 2, 2}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  const auto f = field(wall_metric<3>(box, {{"zmin", 0.05, 1.5, 0.3}}));
  const auto M = f.evaluate(Point<3>(0.3, 0.6, 0.1));
  CHECK(1.0 / std::sqrt(M(2, 2)) == Approx(0.05 + 0.5 * 0.1).epsilon(0.03));
  CHECK(1.0 / std::sqrt(M(0, 0)) == Approx(0.3).epsilon(0.03));
}

TEST_CASE("a group that is not there, and a malformed layer, are refused") {
  const auto mesh = make_grid<2>({1, 1}, {0.0, 0.0}, {1.0, 1.0});
  const auto status = wall_metric<2>(mesh, {{"inlet", 0.1, 1.2, 1.0}}).status();
  CHECK(status.message == "there is no boundary group 'inlet'; there are all, xmin, xmax, ymin, ymax");
  const auto layer = parse_wall_layer("a:b:0.001:1.3");
  REQUIRE(layer);
  CHECK(layer->group == "a:b");
  CHECK(layer->first == 0.001);
  CHECK(layer->growth == 1.3);
  for (const char* text : {"wall", "wall:0.1", "wall:0:1.2", "wall:0.1:0.9", ":0.1:1.2", "wall:x:1.2"})
    CHECK(parse_wall_layer(text).status().code == StatusCode::usage);
}

TEST_CASE("curved boundaries get as many cells per turn as asked for") {
  const auto ring = std::get<Mesh<2>>(*parse_primitive("ring:96,4:1,2"));
  const auto f = field(curvature_metric(ring, 36.0, 1.3, 10.0));
  for (int k = 0; k < 96; ++k) {  // vertices of the input lie on the circles
    const double a = 2.0 * std::numbers::pi * k / 96.0;
    const Point<2> n(std::cos(a), std::sin(a));
    CHECK(1.0 / std::sqrt(f.evaluate(n).m[0]) == Approx(2.0 * std::numbers::pi / 36.0).epsilon(0.05));
  }
  const auto square = make_grid<2>({4, 4}, {0.0, 0.0}, {1.0, 1.0});
  CHECK(curvature_metric(square, 36.0, 1.3, 1.0).status().message.find("no boundary curve") != std::string::npos);
}

TEST_CASE("in the metric that a mesh implies its edges are of length 1") {
  // Parallelograms with sides (0.2, 0.05) and (0, 0.1).
  Mesh<2> sheared = make_grid<2>({5, 10}, {0.0, 0.0}, {1.0, 1.0});
  for (Point<2>& p : sheared.points) p[1] += 0.25 * p[0];
  for (const SymTensor<2>& M : implied_metric(sheared).tensors) {
    CHECK(dot(M, Point<2>(0.2, 0.05), Point<2>(0.2, 0.05)) == Approx(1.0));
    CHECK(dot(M, Point<2>(0.0, 0.1), Point<2>(0.0, 0.1)) == Approx(1.0));
    CHECK(dot(M, Point<2>(0.2, 0.05), Point<2>(0.0, 0.1)) == Approx(0.0).margin(1e-12));
  }
  const auto box = make_grid<3>({2, 4, 5}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  const auto M = implied_metric(box).tensors[7];
  CHECK(M(0, 0) == Approx(4.0));
  CHECK(M(1, 1) == Approx(16.0));
  CHECK(M(2, 2) == Approx(25.0));
}

}  // namespace walls_test
