#include "pillowmesh/smooth/polish.h"

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/quality/report.h"

namespace polish_test {

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

/// 3 x 3 x 3 boxes, those in the middle thin: at heights 0, 1, 1.4, 2.4.
Mesh<3> layered() {
  auto mesh = make_grid<3>({3, 3, 3}, Point<3>(0, 0, 0), Point<3>(3, 3, 3));
  for (auto& p : mesh.points)
    if (p[2] > 1.5) p[2] -= 0.6;
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
  // Sizes along a wall that passes near a vertex: the diagonals across it are longer than the edges around. Were all such
  // corners equally bad, 31 of the 32 cells would stay.
  const auto metric = field("h = 0.2 + 2*abs(x - 2.1)");
  auto mesh = dented();
  REQUIRE(measure(mesh, metric).shape.min == 0.0);
  const PolishResult result = polish_shapes(mesh, metric, {.shape = 0.1, .threshold = 1e9, .most_poor = 1.0});
  CHECK(result.poor_before == 32);
  CHECK(result.poor_after == 0);
  CHECK(validate(mesh).ok());
}

TEST_CASE("nothing moves where no cell is poor") {
  const auto before = make_grid<3>({3, 3, 3}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  auto mesh = before;
  CHECK(polish_shapes(mesh, field("h = 0.5"), {}).moved == 0);
  CHECK(mesh.points == before.points);
}

TEST_CASE("nothing is tried where more cells are poor than are to be lifted") {
  const auto before = layered();  // a third of them
  auto mesh = before;
  const PolishResult result = polish_shapes(mesh, field("h = 1"), {.shape = 0.9, .most_poor = 0.3});
  CHECK(result.poor_before == 9);
  CHECK(result.moved == 0);
  CHECK(mesh.points == before.points);
  CHECK(polish_shapes(mesh, field("h = 1"), {.shape = 0.9, .most_poor = 0.34}).moved > 0);
}

TEST_CASE("no edge grows beyond the threshold") {
  const auto before = layered();
  auto mesh = before;
  CHECK(polish_shapes(mesh, field("h = 1"), {.shape = 0.9, .threshold = 1.02, .most_poor = 1.0}).moved > 0);
  int grown = 0;
  for (const auto& [a, b] : unique_edges(mesh)) {
    const double was = (before.points[b] - before.points[a]).norm(), is = (mesh.points[b] - mesh.points[a]).norm();
    CHECK(is <= std::max(1.02, was) + 1e-9);
    grown += is > was + 1e-3;
  }
  CHECK(grown > 0);
}

TEST_CASE("no scaled Jacobian falls below its floor") {
  auto mesh = layered();  // of boxes: every move of one vertex makes angles worse
  CHECK(polish_shapes(mesh, field("h = 1"), {.shape = 0.9, .quality_guard = 0.9, .most_poor = 1.0}).moved > 0);
  CHECK(measure(mesh, field("h = 1")).scaled_jacobian_min > 0.9);
  mesh = layered();
  CHECK(polish_shapes(mesh, field("h = 1"), {.shape = 0.9, .quality_guard = 1.0, .most_poor = 1.0}).moved == 0);
}

}  // namespace polish_test
