#include "pillowmesh/adapt/continuation.h"

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"

namespace continuation_test {

using namespace pillowmesh;

namespace {

Mesh<3> cube() { return make_grid<3>({5, 5, 5}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)); }
MetricField<3> formula(const char* text) { return *MetricField<3>::from_formula(text); }

}  // namespace

TEST_CASE("steps are taken where sizes change fast, and nowhere else") {
  CHECK(steps_for(cube(), formula("h = 0.02 + 0.6*x")) > 0);
  CHECK(steps_for(cube(), formula("h = 0.02 + 0.4*x")) == 0);
  CHECK(steps_for(cube(), formula("h1 = 0.1; h2 = 0.1; h3 = 0.001 + 0.2*z")) == 0);
  const auto plane = make_grid<2>({5, 5}, Point<2>(0, 0), Point<2>(1, 1));
  CHECK(steps_for(plane, *MetricField<2>::from_formula("h = 0.02 + 0.6*x")) == 0);
}

TEST_CASE("continuation starts from the mesh's edges, halves its floor, and ends with the metric itself") {
  const auto fine = formula("h = 0.001");
  Continuation<3> c(cube(), fine, 3);  // edges of 0.2
  const auto size = [&] { return 1.0 / std::sqrt(c.approach(fine).evaluate({0, 0, 0}).m[0]); };
  for (const double floor : {0.2, 0.1, 0.05}) {
    REQUIRE_FALSE(c.done());
    CHECK(size() == Approx(std::sqrt(floor * floor + 1e-6)));
    c.next();
  }
  CHECK(c.done());
  CHECK(c.approach(fine).evaluate({0, 0, 0}) == fine.evaluate({0, 0, 0}));
}

TEST_CASE("growth is that per length where sizes grow along their direction, and more where they grow across it") {
  CHECK(growth_per_length(cube(), formula("h = 0.3")) == 0.0);
  CHECK(growth_per_length(cube(), formula("h = 0.02 + 0.6*x")) == Approx(0.6).epsilon(0.02));
  CHECK(growth_per_length(cube(), formula("h1 = 0.02 + 0.6*x; h2 = 0.7; h3 = 0.7")) == Approx(0.6).epsilon(0.02));
  // Thin in x, growing in y: .6 / h1 per unit, which is .7 times as long in the metric.
  const double across = growth_per_length(cube(), formula("h1 = 0.1 + 0.6*y; h2 = 0.7; h3 = 0.7"));
  CHECK(across == Approx(0.6 * 0.7 / 0.1).epsilon(0.05));
  CHECK(across > growth_per_length(cube(), formula("h1 = 0.1 + 0.6*y; h2 = 0.3; h3 = 0.7")));
  // A kink between two vertices of the mesh, edges of 0.2, is seen.
  CHECK(growth_per_length(cube(), formula("h = 0.02 + 0.6*abs(x - 0.31)")) == Approx(0.6).epsilon(0.03));
}

}  // namespace continuation_test
