#include "pillowmesh/metric/volume.h"

#include <cmath>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/gallery.h"

namespace volume_test {

using namespace pillowmesh;

namespace {

template <int Dim>
double volume(std::string_view formula, const CornerPoints<Dim>& cell, const VolumeOptions& options = {}) {
  double v = -1.0;
  metric_volumes<Dim>(*MetricField<Dim>::from_formula(formula), {&cell, 1}, {&v, 1}, options);
  return v;
}

template <int Dim>
CornerPoints<Dim> unit_cell() {
  CornerPoints<Dim> p;
  for (int k = 0; k < Cell<Dim>::corners; ++k) {
    for (int d = 0; d < Dim; ++d) p[k][d] = (k >> d) & 1;
  }
  return p;
}

}  // namespace

TEST_CASE("in the Euclidean metric the metric volume is the volume") {
  CHECK(volume<2>("h = 1", unit_cell<2>()) == Approx(1.0));
  CHECK(volume<3>("h = 1", unit_cell<3>()) == Approx(1.0));
  // A trapezium and a truncated pyramid: area 3/4, volume 7/12.
  CornerPoints<2> trapezium = unit_cell<2>();
  trapezium[3] = Point<2>(0.5, 1);
  CHECK(volume<2>("h = 1", trapezium) == Approx(0.75));
  CornerPoints<3> frustum = unit_cell<3>();
  for (int k = 4; k < 8; ++k) frustum[k].head<2>() *= 0.5;
  CHECK(volume<3>("h = 1", frustum) == Approx(7.0 / 12));
}

TEST_CASE("a cell that is inside out has a negative volume") {
  CornerPoints<2> p = unit_cell<2>();
  std::swap(p[0], p[1]);
  std::swap(p[2], p[3]);
  CHECK(volume<2>("h = 1", p) == Approx(-1.0));
}

TEST_CASE("a simplex is a collapsed cell") {
  CHECK(volume<2>("h = 1", collapsed_simplex<2>({Point<2>(0, 0), Point<2>(2, 0), Point<2>(0, 3)})) == Approx(3.0));
  CHECK(volume<3>("h = 1", collapsed_simplex<3>({Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(0, 1, 0),
                                                 Point<3>(0, 0, 1)})) == Approx(1.0 / 6));
  // Integral of 1 / (1 + x)^2 over the unit triangle = 1 - log 2.
  CHECK(volume<2>("h = 1 + x", collapsed_simplex<2>({Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1)}),
                  {.tolerance = 1e-8}) == Approx(1.0 - std::log(2.0)).epsilon(1e-8));
}

TEST_CASE("kinks and jumps are divided until the volume is right") {
  // Integral of 1 / (0.01 + |x - 0.3|) over [0, 1].
  CHECK(volume<2>("h1 = 0.01 + abs(x - 0.3); h2 = 1", unit_cell<2>()) ==
        Approx(std::log(0.31 * 0.71 / 1e-4)).epsilon(1e-4));
  CHECK(volume<2>("h1 = if(x < 0.3, 0.1, 1); h2 = 1", unit_cell<2>()) == Approx(3.7).epsilon(1e-3));
}

TEST_CASE("a panel finds a feature between the sample points") {
  const char* const spike = "h1 = if(abs(x - 0.3) < 0.02, 0.01, 1); h2 = 1";
  CHECK(volume<2>(spike, unit_cell<2>()) < 1.5);
  CHECK(volume<2>(spike, unit_cell<2>(), {.panel = 0.1}) == Approx(0.96 + 4.0).epsilon(0.01));
}

TEST_CASE("the complexity of a case is the ideal number of cells of method.md") {
  const auto of = [](const char* name, double tolerance) {
    const Case* c = find_case(name);
    const AnyMesh mesh = *parse_primitive(c->mesh);
    const VolumeOptions options{.tolerance = tolerance, .panel = 0.1};
    if (c->dim == 2) return complexity(std::get<Mesh<2>>(mesh), *MetricField<2>::from_formula(c->formula), options);
    return complexity(std::get<Mesh<3>>(mesh), *MetricField<3>::from_formula(c->formula), options);
  };
  CHECK(of("iso2d", 1e-4) == Approx(1779.7).epsilon(2e-4));
  CHECK(of("aniso2d", 1e-4) == Approx(945.3).epsilon(2e-4));
  CHECK(of("circle2d", 1e-4) == Approx(1347.97).epsilon(2e-4));
  // The integral of (0.05 + 0.15 z)^-3 = (400 - 25) / 0.3.
  CHECK(of("linear3d", 1e-4) == Approx(1250.0).epsilon(2e-4));
  CHECK(of("cube-linear", 1e-3) == Approx(4651.7).epsilon(1e-3));
}

}  // namespace volume_test
