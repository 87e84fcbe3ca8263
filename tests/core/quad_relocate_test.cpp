#include "pillowmesh/smooth/quad_relocate.h"

#include <random>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/smooth/quad_descent.h"

namespace quad_relocate_test {

using namespace pillowmesh;

namespace {

struct Box {
  Point<2> low, high;
};
Box box_of(const Mesh<2>& mesh) {
  Box box{mesh.points[0], mesh.points[0]};
  for (const auto& p : mesh.points) box = {box.low.cwiseMin(p), box.high.cwiseMax(p)};
  return box;
}
Background background(const Mesh<2>& mesh, const char* text) {
  const Box box = box_of(mesh);
  return {*MetricField<2>::from_formula(text), box.low, box.high};
}

/// Moves each interior vertex by up to `share` of its shortest edge, where that leaves its cells valid.
void shake(Mesh<2>& mesh, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<CellCorner> star;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.support[v].dim != 2) continue;
    vertex_star(mesh, v, star);
    double shortest = 1e300;
    for (const CellCorner& c : star)
      for (int axis = 0; axis < 2; ++axis)
        shortest = std::min(shortest, (mesh.points[mesh.cells[c.cell][c.corner ^ (1 << axis)]] - mesh.points[v]).norm());
    const Point<2> old = mesh.points[v];
    mesh.points[v] += share * shortest * Point<2>(random() / 2147483648.0 - 1.0, random() / 2147483648.0 - 1.0);
    if (!validate(mesh).ok()) mesh.points[v] = old;
  }
}

}  // namespace

TEST_CASE("a mesh of unit squares in the metric has no energy, and keeps its vertices") {
  auto mesh = make_grid<2>({6, 5}, Point<2>(0, 0), Point<2>(3, 5));
  const auto points = mesh.points;
  auto metric = background(mesh, "h1 = 0.5; h2 = 1");
  QuadRelocator relocator(mesh, metric, {.alignment = 0.5});
  CHECK(relocator.total_energy() == Approx(0.0).margin(1e-12));
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) CHECK(relocator.relocate(v) == 0.0);
  CHECK(mesh.points == points);
}

TEST_CASE("cells twice too long cost what the formula of the energy says") {
  // l1 = 2, l2 = 1, d = 2: w = 5 (1 + 1/4) / 2 - 2 = 1.125, E = d w.
  auto mesh = make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(6, 3));
  auto metric = background(mesh, "h = 1");
  QuadRelocator relocator(mesh, metric, {});
  CHECK(relocator.energy(4) == Approx(2.25));
  CHECK(relocator.total_energy() == Approx(9 * 2.25));
}

TEST_CASE("the gradient of the energy agrees with finite differences") {
  auto mesh = make_grid<2>({6, 6}, Point<2>(0, 0), Point<2>(1, 1));
  shake(mesh, 0.4, 5);
  for (const auto& [alignment, shape] : {std::pair(0.0, 0.0), std::pair(0.5, 0.0)}) {
    auto metric = background(mesh, "h1 = 0.1; h2 = 0.2; theta = 0.4");  // the angle between edges uses one metric
    QuadRelocator relocator(mesh, metric, {.alignment = alignment, .shape = shape});
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.support[v].dim != 2) continue;
      QuadRelocator::Derivatives d;
      REQUIRE(relocator.derivatives(v, d));
      const Point<2> x = mesh.points[v];
      for (int axis = 0; axis < 2; ++axis) {
        double E[2];
        for (int side = 0; side < 2; ++side) {
          mesh.points[v] = x;
          mesh.points[v][axis] += side == 0 ? -1e-6 : 1e-6;
          relocator.measure_all(relocator.weights());
          E[side] = relocator.total_energy();
        }
        mesh.points[v] = x;
        relocator.measure_all(relocator.weights());
        CHECK((E[1] - E[0]) / 2e-6 == Approx(d.gradient[axis]).epsilon(1e-4).margin(1e-4));
      }
    }
  }
}

TEST_CASE("moves lower the energy that they say they lower, and invert nothing") {
  for (const auto& [name, initial] : corpus::meshes<2>()) {
    INFO(name);
    Mesh<2> mesh = initial;
    auto metric = background(mesh, "h1 = 0.05 + 0.1*abs(x); h2 = 0.2; theta = y");
    QuadRelocator relocator(mesh, metric, {.alignment = 0.5, .shape = 1.0});
    double energy = relocator.total_energy();
    for (int sweep = 0; sweep < 3; ++sweep)
      for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
        const double gain = relocator.relocate(v);
        const double now = relocator.total_energy();
        REQUIRE(gain >= 0.0);
        REQUIRE(energy - now == Approx(gain).margin(1e-7 * (1 + energy)));
        energy = now;
      }
    const double cached = relocator.total_energy();
    relocator.measure_all(relocator.weights());
    CHECK(relocator.total_energy() == Approx(cached));
    const Status valid = validate(mesh);
    INFO(valid.message);
    CHECK(valid.ok());
  }
}

TEST_CASE("descent spreads rows over the whole mesh where sweeps hardly begin to") {
  // 60 columns of equal width for a size that grows threefold.
  const auto initial = make_grid<2>({60, 3}, Point<2>(0, 0), Point<2>(1, 0.05));
  const char* text = "h1 = 0.01*(1 + 2*x); h2 = 0.0166";
  const auto relaxed = [&](int sweeps, int iterations) {
    Mesh<2> mesh = initial;
    auto metric = background(mesh, text);
    QuadRelocator relocator(mesh, metric, {});
    relocator.rest = 1e-12;
    for (int i = 0; i < sweeps; ++i)
      for (VertexId v = 0; v < mesh.vertex_count(); ++v) relocator.relocate(v);
    QuadDescent descent(mesh, relocator);
    for (int i = 0; i < iterations; ++i) descent.iterate();
    CHECK(validate(mesh).ok());
    return relocator.total_energy();
  };
  CHECK(relaxed(0, 100) < 0.2 * relaxed(100, 0));
}

}  // namespace quad_relocate_test
