#include "pillowmesh/smooth/polish.h"

#include "../catch.h"
#include "checks.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/quality/report.h"

using namespace pillowmesh;

namespace {

MetricField<3> field(const char* text) { return *MetricField<3>::from_formula(text); }

/// 4 x 4 x 4 cells of unit size, one vertex inside moved until the cells around it are poor.
Mesh<3> dented() {
  auto mesh = make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(4, 4, 4));
  for (auto& p : mesh.points)
    if (p == Point<3>(2, 2, 2)) p = Point<3>(2.3, 2.3, 2.3);
  REQUIRE(validate(mesh).ok());
  return mesh;
}

}  // namespace

TEST_CASE("poor cells are lifted, and the mesh stays valid with its corners and patches") {
  const auto before = dented();
  const auto metric = field("h = 1");
  const Report poor = measure(before, metric);
  const double wanted = 0.5;
  REQUIRE(poor.shape.min < wanted);
  auto mesh = before;
  const PolishResult result = polish_shapes(mesh, metric, {.shape = wanted, .most_poor = 1.0});
  CHECK(result.poor_before > 0);
  CHECK(result.poor_after == 0);
  CHECK(result.moved > 0);
  const Report after = measure(mesh, metric);
  CHECK(after.valid);
  CHECK(after.shape.min >= wanted);
  CHECK(after.shape_integral.min >= wanted - 1e-3);
  CHECK(after.edge_length.max <= std::max(2.0, poor.edge_length.max));
  CHECK(mesh.cells == before.cells);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.support[v].dim == 0) CHECK(mesh.points[v] == before.points[v]);
}

TEST_CASE("corners whose lengths no flat simplex has are mended too") {
  // Sizes along a wall that passes near a vertex: the diagonals across it are longer than the edges around.
  const auto metric = field("h = 0.3 + 1.5*abs(x + y + z - 6.3)");
  auto mesh = dented();
  REQUIRE(measure(mesh, metric).shape.min == 0.0);
  const PolishResult result = polish_shapes(mesh, metric, {.shape = 0.1, .threshold = 1e9, .most_poor = 1.0});
  CHECK(result.poor_after < result.poor_before);
  CHECK(validate(mesh).ok());
}

TEST_CASE("nothing moves where no cell is poor, and where too many are") {
  const auto before = make_grid<3>({3, 3, 3}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  auto mesh = before;
  CHECK(polish_shapes(mesh, field("h = 0.5"), {}).moved == 0);
  CHECK(mesh.points == before.points);
  // Ten times as long as wide in the metric, all of them.
  const PolishResult result = polish_shapes(mesh, field("h1 = 0.02; h2 = 0.5; h3 = 0.5"), {});
  CHECK(result.poor_before == 27);
  CHECK(result.moved == 0);
  CHECK(mesh.points == before.points);
}

TEST_CASE("no edge grows beyond the threshold, and no scaled Jacobian falls below its floor") {
  const auto metric = field("h = 1");
  auto mesh = dented();
  const double longest = checks::longest_edge(mesh, metric);
  polish_shapes(mesh, metric, {.shape = 0.9, .threshold = 1.2, .quality_guard = 0.5, .most_poor = 1.0, .max_sweeps = 5});
  CHECK(checks::longest_edge(mesh, metric) <= longest);
  const double before = measure(dented(), metric).scaled_jacobian_min;
  CHECK(measure(mesh, metric).scaled_jacobian_min >= std::min(0.5, before));
}
