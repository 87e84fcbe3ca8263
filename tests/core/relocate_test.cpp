#include "pillowmesh/smooth/relocate.h"

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/mesh/validate.h"

namespace relocate_test {

using namespace pillowmesh;

namespace {

template <int Dim>
MetricField<Dim> field(const char* text) {
  auto f = MetricField<Dim>::from_formula(text);
  REQUIRE(f.ok());
  return *f;
}

/// Central differences of a corner's energy against the exact derivatives, for a constant metric.
template <int Dim>
void check_derivatives(unsigned seed) {
  std::mt19937 random(seed);
  const auto noise = [&] { return random() / 4294967296.0 - 0.5; };
  SymTensor<Dim> M = SymTensor<Dim>::isotropic(0.7);
  for (double& m : M.m) m += 0.5 * noise();
  const auto metric = corner_metric(M);
  Frame<Dim> e;
  for (int d = 0; d < Dim; ++d)
    for (int i = 0; i < Dim; ++i) e[d][i] = (i == d) + 0.4 * noise();
  for (int end = -1; end < Dim; ++end) {
    EdgeSlopes<Dim> slopes;
    for (int d = 0; d < Dim; ++d) {
      slopes.slope[d] = end < 0 ? -1.0 : (end == d ? 1.0 : 0.0);
      slopes.length_gradient[d] = Point<Dim>::Zero();
    }
    const auto moved = [&](const Point<Dim>& x) {
      Frame<Dim> f = e;
      for (int d = 0; d < Dim; ++d) f[d] += slopes.slope[d] * x;
      return f;
    };
    Derivatives<Dim> exact;
    add_corner_derivatives(e, 1, metric, slopes, exact);
    CHECK(exact.value == Approx(corner_energy(e, 1, metric)));
    const double h = 1e-5;
    for (int i = 0; i < Dim; ++i) {
      const Point<Dim> x = h * Point<Dim>::Unit(i);
      const double up = corner_energy(moved(x), 1, metric), down = corner_energy(moved(-x), 1, metric);
      CHECK(exact.gradient[i] == Approx((up - down) / (2 * h)).epsilon(1e-5).margin(1e-6));
      Derivatives<Dim> a, b;
      add_corner_derivatives(moved(x), 1, metric, slopes, a);
      add_corner_derivatives(moved(-x), 1, metric, slopes, b);
      for (int j = 0; j < Dim; ++j)
        CHECK(exact.hessian(j, i) == Approx((a.gradient[j] - b.gradient[j]) / (2 * h)).epsilon(1e-4).margin(1e-5));
    }
  }
}

template <int Dim>
void smooth(Mesh<Dim>& mesh, const MetricField<Dim>& metric, int sweeps) {
  Relocator<Dim> relocator(mesh, metric);
  double last = INFINITY;
  for (int i = 0; i < sweeps; ++i) {
    const SweepResult r = relocator.sweep();
    REQUIRE(r.decrease >= 0);
    REQUIRE(validate(mesh).message == "");
    last = r.energy;
    if (r.converged) break;
  }
  CHECK(last < INFINITY);
}

}  // namespace

TEST_CASE("the derivatives of the corner energy are those of its differences") {
  for (unsigned seed : {1u, 2u, 3u}) {
    check_derivatives<2>(seed);
    check_derivatives<3>(seed);
  }
}

TEST_CASE("a corner with all edges but one held has the same energy and derivatives") {
  std::mt19937 random(4);
  const auto noise = [&] { return random() / 4294967296.0 - 0.5; };
  for (int trial = 0; trial < 10; ++trial) {
    SymTensor<3> M = SymTensor<3>::isotropic(0.7);
    for (double& m : M.m) m += 0.5 * noise();
    const auto metric = corner_metric(M);
    Frame<3> e;
    for (int d = 0; d < 3; ++d)
      for (int i = 0; i < 3; ++i) e[d][i] = (i == d) + 0.4 * noise();
    const int end = trial % 3;
    const double slope = 0.5 + noise();
    EdgeSlopes<3> slopes;
    slopes.slope.fill(0.0);
    slopes.slope[end] = slope;
    for (auto& g : slopes.length_gradient) g = Point<3>(noise(), noise(), noise());
    const auto held = hold_corner(e, 1, metric, end);
    CHECK(held_energy(held, e[end]) == Approx(corner_energy(e, 1, metric)));
    Derivatives<3> general, short_cut;
    add_corner_derivatives(e, 1, metric, slopes, general);
    add_held_derivatives(held, e[end], slope, slopes.length_gradient[end], short_cut);
    CHECK(short_cut.value == Approx(general.value));
    for (int i = 0; i < 3; ++i) CHECK(short_cut.gradient[i] == Approx(general.gradient[i]).margin(1e-12));
  }
}

TEST_CASE("a degenerate or inverted corner has infinite energy") {
  const auto metric = corner_metric(SymTensor<2>::isotropic(1));
  CHECK(corner_energy<2>({{Point<2>(1, 0), Point<2>(2, 0)}}, 1, metric) == INFINITY);
  CHECK(corner_energy<2>({{Point<2>(0, 1), Point<2>(1, 0)}}, 1, metric) == INFINITY);
  CHECK(corner_energy<2>({{Point<2>(0, 1), Point<2>(1, 0)}}, -1, metric) < 10);
}

TEST_CASE("a shaken grid in the unit metric becomes the grid again") {
  auto mesh = corpus::shaken(make_grid<2>({8, 8}, Point<2>(0, 0), Point<2>(8, 8)), 1.0, 0.3, 5);
  smooth(mesh, field<2>("h = 1"), 200);
  for (const auto& p : mesh.points)
    for (int d = 0; d < 2; ++d) CHECK(std::abs(p[d] - std::round(p[d])) < 0.02);
  auto cube = corpus::shaken(make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(4, 4, 4)), 1.0, 0.25, 5);
  smooth(cube, field<3>("h = 1"), 200);
  for (const auto& p : cube.points)
    for (int d = 0; d < 3; ++d) CHECK(std::abs(p[d] - std::round(p[d])) < 0.02);
}

TEST_CASE("smoothing never inverts, keeps corners, and keeps the boundary on its curves") {
  for (auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    const auto before = mesh;
    smooth(mesh, field<2>("h = 0.3 + 0.4 * abs(x - 0.3)"), 60);
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      CHECK(mesh.support[v] == before.support[v]);
      if (mesh.support[v].dim == 0) CHECK(mesh.points[v] == before.points[v]);
      if (mesh.support[v].dim != 1) continue;
      Index anchor = mesh.anchor[v];
      const Point<2> foot = slide(*mesh.geometry, mesh.support[v], anchor, mesh.points[v]);
      CHECK((foot - mesh.points[v]).norm() < 1e-12);
    }
  }
  for (auto& [name, mesh] : corpus::meshes<3>()) {
    INFO(name);
    smooth(mesh, field<3>("h = 0.3 + 0.4 * abs(x - 0.3)"), 20);
  }
}

TEST_CASE("one vertex of huge energy does not stop the smoothing of the others") {
  auto mesh = corpus::shaken(make_grid<2>({8, 8}, Point<2>(0, 0), Point<2>(8, 8)), 1.0, 0.3, 5);
  // The corner of the domain is put beside the vertex across its cell: cells there are as bad as can be.
  VertexId first = kNone, second = kNone;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.points[v] == Point<2>(0, 0)) first = v;
    if (mesh.support[v].dim == 2 && (mesh.points[v] - Point<2>(1, 1)).norm() < 0.5) second = v;
  }
  REQUIRE(first != kNone);
  REQUIRE(second != kNone);
  mesh.points[first] = mesh.points[second] - Point<2>(1e-9, 1e-9);
  Relocator<2> relocator(mesh, field<2>("h = 1"));
  int sweeps = 0;
  while (sweeps < 200 && !relocator.sweep().converged) ++sweeps;
  CHECK(sweeps > 5);
  double worst = 0.0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.points[v][0] > 4.5 && mesh.points[v][1] > 4.5)
      for (int d = 0; d < 2; ++d) worst = std::max(worst, std::abs(mesh.points[v][d] - std::round(mesh.points[v][d])));
  CHECK(worst < 0.1);
}

}  // namespace relocate_test
