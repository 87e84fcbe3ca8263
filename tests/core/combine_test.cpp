#include "pillowmesh/metric/combine.h"

#include <cmath>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/spectrum.h"
#include "pillowmesh/metric/volume.h"

namespace combine_test {

using namespace pillowmesh;

namespace {

MetricSource<2> formula(std::string_view text) { return *MetricField<2>::from_formula(text); }
const Mesh<2>& square() {
  static const Mesh<2> mesh = make_grid<2>({8, 8}, {0.0, 0.0}, {1.0, 1.0});
  return mesh;
}
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a target of cells scales sizes so that the complexity is met") {
  MetricOperations operations;
  operations.cells = 500;
  const auto formula_only = combine_field<2>({formula("h1 = 0.1 + x; h2 = 0.2")}, operations, square());
  REQUIRE(formula_only);
  CHECK(complexity(square(), *formula_only) == Approx(500.0).epsilon(1e-3));
  operations.bounds.smallest = 0.02;
  operations.gradation = 1.3;
  const auto bounded = combine_field<2>({formula("h = if(x < 0.3, 0.001, 1)")}, operations, square());
  REQUIRE(bounded);
  CHECK(complexity(square(), *bounded) == Approx(500.0).epsilon(0.01));
  CHECK(1.0 / std::sqrt(bounded->evaluate(Point<2>(0.1, 0.5)).m[0]) >= 0.02 * (1 - 1e-9));
}

TEST_CASE("a target that the bounds forbid is refused with what they lead to") {
  MetricOperations operations;
  operations.cells = 1e6;
  operations.bounds.smallest = 0.1;
  const auto field = combine_field<2>({formula("h = 0.1")}, operations, square());
  REQUIRE_FALSE(field);
  CHECK(contains(field.status().message, "about 100 cells"));
}

TEST_CASE("several sources intersect") {
  const auto both = combine_field<2>({formula("h1 = 0.02; h2 = 0.5"), formula("h1 = 0.4; h2 = 0.05")}, {}, square());
  REQUIRE(both);
  const auto M = both->evaluate(Point<2>(0.3, 0.7));
  CHECK(M.m[0] == Approx(2500.0));
  CHECK(M.m[1] == Approx(0.0).margin(1e-9));
  CHECK(M.m[2] == Approx(400.0));
}

TEST_CASE("one source with a background keeps that background") {
  NodalMetric<2> nodal = nodal_grid<2>({3, 3}, {0.0, 0.0}, {1.0, 1.0});
  for (auto& M : nodal.tensors) M = SymTensor<2>::isotropic(0.1);
  MetricOperations operations;
  operations.bounds.smallest = 0.2;
  const auto made = combine<2>({nodal}, operations, square());
  REQUIRE(made);
  CHECK(made->points == nodal.points);
  CHECK(made->tensors[5].m[0] == Approx(25.0));
}

TEST_CASE("what is no metric, and operations that contradict each other, are refused") {
  CHECK(contains(combine_field<2>({formula("h = x - 0.5")}, {}, square()).status().message, "positive"));
  MetricOperations operations;
  CHECK(set_operation(operations, "hmin", "0.2").ok());
  CHECK(set_operation(operations, "hmax", "0.1").ok());
  CHECK(
      contains(combine_field<2>({formula("h = 1")}, operations, square()).status().message, "--hmin is above --hmax"));
  CHECK(contains(set_operation(operations, "hmin", "0").message, "--hmin takes a number above 0, not '0'"));
  CHECK(contains(set_operation(operations, "gradation", "1").message, "--gradation"));
  CHECK(contains(set_operation(operations, "max-anisotropy", "0.5").message, "from 1"));
  CHECK(contains(set_operation(operations, "target-cells", "many").message, "'many'"));
}

}  // namespace combine_test
