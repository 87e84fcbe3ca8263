// The published rows of [Paper] Tables 1 to 5: the initial ones to their last digit, the adapted ones as floors.
#include <string>

#include "catch.h"
#include "core/checks.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/quality/report.h"

namespace paper_cases_test {

using namespace pillowmesh;

namespace {

template <int Dim>
struct Problem {
  Mesh<Dim> mesh;
  MetricField<Dim> field;
};

template <int Dim>
Problem<Dim> problem(const char* name) {
  const auto field = *MetricField<Dim>::from_formula(find_case(name)->formula);
  if constexpr (Dim == 3) {
    const int n = std::string(name) == "linear3d" ? 4 : 5;
    return {make_grid<3>({n, n, n}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)), field};
  } else if (std::string(name) == "circle2d")
    return {make_grid<2>({10, 10}, Point<2>(-1, -1), Point<2>(1, 1)), field};
  else
    return {make_grid<2>({7, 9}, Point<2>(0, 0), Point<2>(7, 9)), field};
}

struct Row {
  double min, mean, max, cv;
};

/// Compares with the printed digits: `unit` is half of the last one.
void check_row(const Statistics& s, const Row& row, double unit) {
  CHECK(std::abs(s.min - row.min) <= unit);
  CHECK(std::abs(s.mean - row.mean) <= unit);
  CHECK(std::abs(s.cv - row.cv) <= unit);
}

/// Runs the paper's method on a case; the mesh is validated after every step.
template <int Dim = 2>
Report adapt(const char* name, std::initializer_list<std::pair<const char*, const char*>> settings) {
  const auto [mesh, field] = problem<Dim>(name);
  AdaptOptions options;
  options.method = Method::paper;
  for (const auto& [key, value] : settings) REQUIRE(set_option(options, key, value).ok());
  Adapter<Dim> adapter(mesh, field, options);
  for (bool more = true; more;) {
    more = adapter.step();
    const Status valid = validate(adapter.mesh());
    INFO(valid.message);
    REQUIRE(valid.ok());
  }
  INFO(adapter.outcome().message);
  CHECK(adapter.outcome().ok());
  if constexpr (Dim == 2) CHECK(checks::area(adapter.mesh()) == Approx(checks::area(mesh)));
  return measure(adapter.mesh(), field);
}

}  // namespace

TEST_CASE("the initial meshes have the lengths that the paper prints") {
  const auto one = problem<2>("iso2d");
  const Report r1 = measure(one.mesh, one.field);
  CHECK(r1.edge_length.count == 142);
  CHECK(r1.cells == 63);
  check_row(r1.edge_length, {1.000, 4.205, 20.0, 1.042}, 5e-4);
  CHECK(r1.edge_length.max == Approx(20.0).epsilon(1e-9));

  const auto two = problem<2>("aniso2d");
  const Report r2 = measure(two.mesh, two.field);
  check_row(r2.edge_length, {1.275, 3.875, 11.65, 0.703}, 5e-4);
  CHECK(std::abs(r2.edge_length.max - 11.65) < 5e-3);

  // The paper prints .447 2.126 10.3 1.246 for case 3; integrated exactly it is .443 2.119 10.26 1.249.
  const auto three = problem<2>("circle2d");
  const Report r3 = measure(three.mesh, three.field);
  CHECK(r3.edge_length.count == 220);
  CHECK(r3.cells == 100);
  check_row(r3.edge_length, {0.443, 2.119, 10.26, 1.249}, 5e-4);
  CHECK(std::abs(r3.edge_length.max - 10.26) < 5e-3);

  const auto four = problem<3>("linear3d");
  const Report r4 = measure(four.mesh, four.field);
  CHECK(r4.edge_length.count == 300);
  check_row(r4.edge_length, {1.250, 2.456, 5.00, 0.497}, 5e-4);
  CHECK(r4.edge_length.max == Approx(5.0).epsilon(1e-9));
}

TEST_CASE("the initial meshes of cases 2 and 4 have the shapes that the paper prints") {
  const auto two = problem<2>("aniso2d");
  const Report r2 = measure(two.mesh, two.field);
  check_row(r2.shape, {.2292, .7318, .9986, .2801}, 5e-5);
  CHECK(std::abs(r2.shape.max - .9986) < 5e-5);
  const auto four = problem<3>("linear3d");
  const Report r4 = measure(four.mesh, four.field);
  check_row(r4.shape, {.8145, .8948, .9441, .0556}, 5e-5);
  CHECK(r4.shape.count == 64);
}

TEST_CASE("the paper's method on iso2d is at least as good as the paper") {
  const Report r = adapt("iso2d", {});
  CHECK(r.edge_length.cv <= 0.28);   // paper: .303
  CHECK(r.shape.mean >= 0.78);       // .782
  CHECK(r.shape.min >= 0.27);        // .271
  CHECK(r.cells <= 1.35 * 1779.7);   // of the ideal number; paper: 1.23
}

TEST_CASE("the paper's method on aniso2d makes the paper's 660 cells with 1372 edges") {
  const Report r = adapt("aniso2d", {});
  CHECK(r.cells == 660);
  CHECK(r.edges == 1372);
  CHECK(r.edge_length.cv <= 0.03);
  CHECK(r.shape.mean >= 0.99);
  CHECK(r.irregular_vertices == 0);
}

TEST_CASE("the paper's method on circle2d is at least as good as the paper") {
  const Report r = adapt("circle2d", {});
  CHECK(r.edge_length.cv <= 0.33);
  CHECK(r.shape.mean >= 0.74);
  CHECK(r.cells <= 3316);  // paper
}

TEST_CASE("coarse refinement and dicing gives circle2d better shapes than refinement alone") {
  const Report r = adapt("circle2d", {{"dice", "3"}});
  CHECK(r.cells % 9 == 0);
  CHECK(r.shape.mean >= 0.80);  // paper: .743, and .645 without dicing
  CHECK(r.shape.min >= 0.205);
  CHECK(r.edge_length.cv <= 0.474);
  CHECK(r.cells <= 4672);
}

TEST_CASE("smoothing between the iterations needs fewer cells and fewer iterations on circle2d") {
  const Report plain = adapt("circle2d", {{"smooth", "none"}});
  const Report r = adapt("circle2d", {{"smooth", "between"}});
  CHECK(r.cells < 0.85 * plain.cells);  // paper: 2460 and 3316
  CHECK(r.shape.mean >= 0.672);
  CHECK(r.edge_length.max <= 2.05);
}

TEST_CASE("refinement ends with all lengths below the threshold, whatever the variant") {
  for (const char* name : {"iso2d", "aniso2d", "circle2d"})
    for (const char* thickness : {"1", "2"})
      for (const char* threshold : {"2", "1.6"}) {
        INFO(name << ", thickness " << thickness << ", threshold " << threshold);
        const Report r = adapt(name, {{"smooth", "none"}, {"thickness", thickness}, {"threshold", threshold}});
        CHECK(r.edge_length.max <= std::stod(threshold) * (1 + checks::kTagging));
      }
}

TEST_CASE("the paper's variants end with valid meshes on the first two cases too") {
  for (const char* name : {"iso2d", "aniso2d"}) {
    INFO(name);
    adapt(name, {{"dice", "3"}, {"max-sweeps", "20"}});
    adapt(name, {{"smooth", "between"}, {"max-sweeps", "20"}});
  }
}

TEST_CASE("layers two cells thick halve whole rows, and need no more cells than thin ones") {
  const Report whole = adapt("aniso2d", {{"thickness", "2"}});
  CHECK(whole.irregular_vertices == 0);
  CHECK(whole.edge_length.min >= 1.0);
  CHECK(whole.edge_length.cv <= 0.04);
  const Report iso = adapt("iso2d", {{"thickness", "2"}, {"max-sweeps", "60"}});
  CHECK(iso.cells <= 2000);  // 2314 with thin ones
  CHECK(iso.edge_length.cv <= 0.28);
}

TEST_CASE("the paper's method on linear3d is better than the paper in all but a few cells") {
  const Report r = adapt<3>("linear3d", {});
  CHECK(r.edge_length.cv <= 0.235);  // paper: .251
  CHECK(std::abs(r.edge_length.mean - 1.0) <= 0.06);
  CHECK(r.shape.mean >= 0.82);  // .770
  CHECK(r.shape.min >= 0.4);    // .244
  CHECK(r.scaled_jacobian_min >= 0.3);
}

// Sizes grow by half their length: the smoother leaves corners without a flat simplex, which are lifted at last.
TEST_CASE("the paper's method on sphere3d meets its sizes with few cells, none of them poor") {
  const Report r = adapt<3>("sphere3d", {});
  CHECK(r.cells <= 1100);  // paper, with the rotations as it ran them: 5638
  CHECK(r.shape.mean >= 0.52);
  CHECK(r.shape.min >= 0.15);  // paper: .002
  CHECK(r.shape_integral.min >= 0.15);
  CHECK(r.scaled_jacobian_min > 0.08);
  CHECK(r.edge_length.cv <= 0.53);
}

// By itself: sizes grow across the thin direction, so the threshold is sqrt 2.
TEST_CASE("the paper's method on sphere3d-paper is better than the paper in every column, with less than half of its cells") {
  const Report r = adapt<3>("sphere3d-paper", {});
  CHECK(r.cells <= 5638 / 2);
  CHECK(r.edge_length.min > 0.020);
  CHECK(std::abs(r.edge_length.mean - 1.0) < 1.0 - 0.339);
  CHECK(r.edge_length.max < 1.48);
  CHECK(r.edge_length.cv < 0.459);
  CHECK(r.shape.mean > 0.566);
  CHECK(r.shape.max > 0.93);
  CHECK(r.shape.cv < 0.394);
  CHECK(r.shape.min > 0.002);
}

TEST_CASE("who chooses the continuation keeps the threshold") {
  const Report r = adapt<3>("sphere3d-paper", {{"continuation", "6"}});
  CHECK(r.edge_length.max > 1.6);
  CHECK(r.cells <= 1100);
}

}  // namespace paper_cases_test
