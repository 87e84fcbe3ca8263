#include "pillowmesh/smooth/hex_star.h"

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/mesh/jacobian.h"

namespace hex_star_test {

using namespace pillowmesh;

namespace {

MetricField<3> field(const char* text) {
  auto f = MetricField<3>::from_formula(text);
  REQUIRE(f.ok());
  return *f;
}

/// The energy of all corners of the mesh that have an edge to v, corner by corner, in a constant metric.
double energy_by_corners(const Mesh<3>& mesh, VertexId v, const Point<3>& position, const CornerMetric<3>& metric) {
  double sum = 0.0;
  std::vector<CellCorner> star;
  vertex_star(mesh, v, star);
  const auto at = [&](VertexId w) { return w == v ? position : mesh.points[w]; };
  for (const auto& [c, corner] : star)
    for (int j = -1; j < 3; ++j) {
      const int k = j < 0 ? corner : corner ^ (1 << j);
      Frame<3> e;
      for (int d = 0; d < 3; ++d) e[d] = at(mesh.cells[c][k ^ (1 << d)]) - at(mesh.cells[c][k]);
      sum += corner_energy(e, Cell<3>::corner_sign(k), metric);
    }
  return sum;
}

}  // namespace

TEST_CASE("the energy of a star is that of its corners, boundary and irregular vertices included") {
  const SymTensor<3> M{{5.0, 1.0, 3.0, -0.5, 0.4, 2.0}};
  for (auto& [name, mesh] : corpus::meshes<3>()) {
    INFO(name);
    HexStar star(mesh, MetricField<3>::uniform(M));
    for (VertexId v = 0; v < mesh.vertex_count(); v += 3) {
      if (mesh.support[v].dim == 0) continue;
      star.visit(v);
      star.look_at(mesh.points[v]);
      CHECK(star.energy() == Approx(energy_by_corners(mesh, v, mesh.points[v], corner_metric(M))));
    }
  }
}

TEST_CASE("the derivatives of a star's energy are those of its differences") {
  // The Hessian is that of the metric held fixed, and the metric's change is taken as linear.
  struct Row {
    const char* formula;
    double gradient, hessian;
  };
  for (const Row& row : {Row{"m11 = 5; m12 = 1; m22 = 3; m13 = -0.5; m23 = 0.4; m33 = 2", 1e-6, 1e-5},
                         Row{"h = 1 + 0.1*x - 0.05*y + 0.02*z", 0.01, 1.0}, Row{"h = 1 + 0.4*x", 0.05, 1.0},
                         Row{"h1 = 1; h2 = 0.5; h3 = 0.7; theta = 0.1*z", 0.02, 1.0}}) {
    INFO(row.formula);
    const auto mesh = corpus::shaken(make_grid<3>({2, 2, 2}, Point<3>(0, 0, 0), Point<3>(2, 2, 2)), 1.0, 0.2, 3);
    HexStar star(mesh, field(row.formula));
    VertexId v = 0;
    while (mesh.support[v].dim < 3) ++v;
    star.visit(v);
    const auto energy = [&](const Point<3>& x) {
      star.look_at(x);
      return star.energy();
    };
    const auto gradient = [&](const Point<3>& x) {
      star.look_at(x);
      return star.derivatives().gradient;
    };
    star.look_at(mesh.points[v]);
    const Derivatives<3> exact = star.derivatives();
    const double h = 1e-5, steep = exact.gradient.norm(), bent = exact.hessian.norm();
    for (int i = 0; i < 3; ++i) {
      const Point<3> up = mesh.points[v] + h * Point<3>::Unit(i), down = mesh.points[v] - h * Point<3>::Unit(i);
      CHECK(std::abs(exact.gradient[i] - (energy(up) - energy(down)) / (2 * h)) < row.gradient * steep);
      const Point<3> change = (gradient(up) - gradient(down)) / (2 * h);
      for (int j = 0; j < 3; ++j) CHECK(std::abs(exact.hessian(j, i) - change[j]) < row.hessian * bent);
    }
  }
}

TEST_CASE("a star knows the smallest scaled Jacobian of the corners that move") {
  const auto mesh = corpus::shaken(make_grid<3>({2, 2, 2}, Point<3>(0, 0, 0), Point<3>(2, 2, 2)), 1.0, 0.3, 7);
  HexStar star(mesh, field("h = 1"));
  VertexId v = 0;
  while (mesh.support[v].dim < 3) ++v;
  star.visit(v);
  star.look_at(mesh.points[v]);
  CHECK(star.energy() < INFINITY);
  const double lowest = star.lowest_scaled_jacobian();
  double of_cells = 1.0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) of_cells = std::min(of_cells, min_scaled_jacobian(mesh, c));
  CHECK(lowest >= of_cells - 1e-12);
  CHECK(star.below(lowest + 1e-9));
  CHECK_FALSE(star.below(lowest - 1e-9));
}

}  // namespace hex_star_test
