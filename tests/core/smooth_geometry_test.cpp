#include "pillowmesh/mesh/smooth_geometry.h"

#include <cmath>
#include <functional>

#include "../catch.h"
#include "checks.h"
#include "io_meshes.h"
#include "meshes.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/io/io.h"
#include "pillowmesh/mesh/foot.h"
#include "pillowmesh/mesh/validate.h"

namespace smooth_geometry_test {

using namespace pillowmesh;

namespace {

constexpr double kPi = 3.14159265358979;

/// A ring whose outer boundary has n vertices at outer(angle).
Mesh<2> ring_of(int n, const std::function<Point<2>(double)>& outer) {
  MeshInput<2> in;
  for (const double share : {0.5, 1.0})
    for (int i = 0; i < n; ++i) in.points.push_back(share * outer(2 * kPi * i / n));
  for (int i = 0; i < n; ++i) in.cells.push_back({(i + 1) % n, i, (i + 1) % n + n, i + n});
  return *make_mesh(in);
}

/// Cells of a cube on a sphere of radius 1: n x n on each of the six sides, around a smaller one.
Mesh<3> ball(int n) {
  auto mesh = make_grid<3>({n, n, n}, Point<3>(-1, -1, -1), Point<3>(1, 1, 1));
  MeshInput<3> in;
  in.cells = mesh.cells;
  for (const Point<3>& p : mesh.points) {
    const double cube = p.cwiseAbs().maxCoeff();
    const auto bent = [](double t) { return std::tan(0.25 * kPi * t); };
    const Point<3> q(bent(p[0]), bent(p[1]), bent(p[2]));
    // A ball outside, a cube in the middle.
    in.points.push_back(cube > 0 ? Point<3>((1 - cube) * 0.5 * p + cube * cube * q / q.norm()) : p);
  }
  return *make_mesh(in, {.corner_cosine = 0.5});
}

/// The farthest from the sphere that a point of the boundary is, sampled.
double off_sphere(const Geometry<3>& g) {
  double most = 0.0;
  for (Index i = 0; i < static_cast<Index>(g.facets.size()); ++i)
    for (int k = 1; k < 16; ++k) {
      const double u = 0.25 * (k % 4), v = 0.25 * (k / 4);
      const auto& f = g.facets[i];
      const Point<3> flat = (1 - v) * ((1 - u) * g.points[f[0]] + u * g.points[f[1]]) +
                            v * ((1 - u) * g.points[f[2]] + u * g.points[f[3]]);
      most = std::max(most, std::abs(foot_on_facet(g, i, Point<3>(1.1 * flat)).point.norm() - 1));
    }
  return most;
}

template <int Dim>
double longest_bend(const Geometry<Dim>& g) {
  double most = 0.0;
  for (const auto& facet : g.bends)
    for (const auto& bend : facet) most = std::max({most, bend.from.norm(), bend.to.norm()});
  return most;
}

Mesh<2> plate_with_hole() {
  return std::get<Mesh<2>>(*read_mesh("plate_hole_v4.msh", io_test::read_data("plate_hole_v4.msh")));
}

/// Distances of the hole's vertices from its centre.
std::vector<double> hole_radii(const Mesh<2>& mesh) {
  std::vector<double> radii;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const double r = (mesh.points[v] - Point<2>(1.2, 1)).norm();
    if (mesh.vertex_cell[v] != kNone && mesh.support[v].dim < 2 && r < 0.7) radii.push_back(r);
  }
  return radii;
}

Mesh<2> adapted_plate(BoundaryShape shape, double size) {
  AdaptOptions options;
  options.effort = Effort::fast;
  options.geometry = shape;
  Adapter<2> adapter(plate_with_hole(), *MetricField<2>::from_formula("h = " + std::to_string(size)), options);
  (void)adapter.run();
  CHECK(validate(adapter.mesh()).ok());
  return adapter.mesh();
}

}  // namespace

TEST_CASE("where the boundary is straight smooth geometry leaves every bit as it is") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    if (name.find("ring") != std::string::npos || name.find("star") != std::string::npos) continue;
    const auto smooth = smooth_geometry<2>(mesh.geometry);
    INFO(name);
    if (longest_bend(*smooth) > 0) continue;  // round, or winding: the tests below
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.support[v].dim != 1) continue;
      Index a = mesh.anchor[v], b = a;
      const Point<2> target = mesh.points[v] + Point<2>(0.013, -0.07);
      CHECK(slide(*smooth, mesh.support[v], a, target) == slide(*mesh.geometry, mesh.support[v], b, target));
    }
  }
  CHECK(longest_bend(*smooth_geometry<2>(make_grid<2>({3, 4}, Point<2>(0, 0), Point<2>(1, 2)).geometry)) == 0.0);
  CHECK(longest_bend(*smooth_geometry<3>(make_grid<3>({2, 3, 4}, Point<3>(0, 0, 0), Point<3>(1, 2, .3)).geometry)) ==
        0.0);
  CHECK(longest_bend(*smooth_geometry<2>(corpus::ell(6).geometry)) == 0.0);
}

TEST_CASE("the vertices of the input stay where they are") {
  const auto check = [](auto mesh) {
    mesh.geometry = smooth_geometry(mesh.geometry);
    CHECK(checks::distance_from_geometry(mesh) < 1e-9);
  };
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    check(mesh);
  }
  for (const auto& [name, mesh] : corpus::meshes<3>()) {
    INFO(name);
    check(mesh);
  }
}

TEST_CASE("on a ring one slides on circles") {
  const auto mesh = corpus::ring(12, 2, true);
  const auto smooth = smooth_geometry<2>(mesh.geometry);
  CHECK(smooth->circles.size() == 2);
  CHECK(smooth_geometry<2>(smooth) == smooth);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.support[v].dim != 1) continue;
    Index anchor = mesh.anchor[v];
    const double r = mesh.points[v].norm();
    for (int i = 0; i < 100; ++i) {
      const Point<2> target(1.7 * std::cos(0.07 * i), 1.7 * std::sin(0.07 * i));
      const Point<2> p = slide(*smooth, mesh.support[v], anchor, target);
      if (i < 5) continue;  // it has walked there meanwhile
      CHECK(p.norm() == Approx(r).epsilon(1e-13));
      CHECK((p / r - target / 1.7).norm() < 1e-12);
    }
  }
}

TEST_CASE("an ellipse is met to the third order at least, with one tangent at each vertex") {
  const auto ellipse = [](double a) { return Point<2>(2 * std::cos(a), std::sin(a)); };
  const auto error = [&](int n) {
    const auto g = smooth_geometry<2>(ring_of(n, ellipse).geometry);
    CHECK(g->circles.empty());
    double most = 0.0;
    for (int i = 0; i < 16 * n; ++i) {
      const Point<2> p = ellipse(2 * kPi * i / (16 * n));
      double nearest = INFINITY;
      for (Index k = 0; k < static_cast<Index>(g->facets.size()); ++k)
        nearest = std::min(nearest, foot_on_facet(*g, k, p).distance2);
      most = std::max(most, std::sqrt(nearest));
    }
    for (Index k = 0; k < static_cast<Index>(g->facets.size()); ++k)
      for (int end = 0; end < 2; ++end) {
        const Point<2>& v = g->points[g->facets[k][end]];
        const Point<2> t = foot_on_facet(*g, k, v).tangent[0].normalized();
        const Point<2> n = foot_on_facet(*g, g->neighbours[k][end], v).tangent[0].normalized();
        CHECK(std::abs(t[0] * n[1] - t[1] * n[0]) < 1e-9);
      }
    return most;
  };
  const double coarse = error(24), fine = error(48);
  CHECK(coarse < 2e-3);      // the chords are off by 1.7e-2
  CHECK(fine < coarse / 7);  // third order: an eighth
}

TEST_CASE("a straight side between two arcs stays straight, also where it is one edge") {
  // A slot: two half circles of eight arcs, and sides of one edge.
  MeshInput<2> in;
  for (const double share : {0.5, 1.0})
    for (int i = 0; i < 18; ++i) {
      const double a = kPi * (i < 9 ? i - 4 : i - 5) / 8;
      const Point<2> middle(i < 9 ? 2 : -2, 0);
      in.points.push_back(middle + share * Point<2>(std::cos(a), std::sin(a)));
    }
  for (int i = 0; i < 18; ++i) in.cells.push_back({(i + 1) % 18, i, (i + 1) % 18 + 18, i + 18});
  const auto g = smooth_geometry<2>(make_mesh(in)->geometry);
  CHECK(g->circles.size() == 4);
  int straight = 0;
  for (Index k = 0; k < static_cast<Index>(g->facets.size()); ++k) {
    if (g->circle[k] != kNone) continue;
    ++straight;
    CHECK(g->bends[k][0].from.norm() < 1e-12);
    CHECK(g->bends[k][0].to.norm() < 1e-12);
  }
  CHECK(straight == 4);
}

TEST_CASE("adapted with smooth geometry a hole gets round, with linear geometry it stays the polygon it was") {
  const auto polygon = plate_with_hole();
  CHECK(hole_radii(polygon).size() == 12);
  const auto linear = adapted_plate(BoundaryShape::linear, 0.05), smooth = adapted_plate(BoundaryShape::smooth, 0.05);
  CHECK(checks::distance_from_geometry(linear) < 1e-14);
  CHECK(checks::distance_from_geometry(smooth) < 1e-14);
  const auto on_polygon = hole_radii(linear), on_circle = hole_radii(smooth);
  CHECK(on_polygon.size() > 40);  // 50 edges of unit length would fit
  CHECK(*std::min_element(on_polygon.begin(), on_polygon.end()) < 0.3870);  // the chords' middles are at .3864
  CHECK(on_circle.size() > 40);
  for (const double r : on_circle) CHECK(std::abs(r - 0.4) < 1e-13);
  // The plate's straight sides are what they were.
  for (VertexId v = 0; v < smooth.vertex_count(); ++v) {
    const Point<2>& p = smooth.points[v];
    if (smooth.vertex_cell[v] == kNone || smooth.support[v].dim == 2 || (p - Point<2>(1.2, 1)).norm() < 0.7) continue;
    CHECK((p[0] == 0.0 || p[0] == 4.0 || p[1] == 0.0 || p[1] == 2.0));
  }
}

TEST_CASE("diced cells have their new boundary vertices on the circle") {
  AdaptOptions options;
  options.geometry = BoundaryShape::smooth;
  options.dice = 3;
  options.smoothing = Smoothing::none;
  Adapter<2> adapter(corpus::ring(12, 2, true), *MetricField<2>::from_formula("h = 1"), options);
  CHECK(adapter.run().ok());
  CHECK(adapter.mesh().cell_count() == 24 * 9);
  for (VertexId v = 0; v < adapter.mesh().vertex_count(); ++v)
    if (adapter.mesh().support[v].dim == 1) {
      const double r = adapter.mesh().points[v].norm();
      CHECK(std::min(std::abs(r - 1), std::abs(r - 2)) < 1e-14);
    }
}

TEST_CASE("a sphere of facets is met far better by smooth ones, without gaps between them") {
  double coarse = 0.0;
  for (const int n : {4, 8}) {
    const auto mesh = ball(n);
    REQUIRE(mesh.patch_groups.size() == 1);
    const auto smooth = smooth_geometry<3>(mesh.geometry);
    const double linear = off_sphere(*mesh.geometry), curved = off_sphere(*smooth);
    INFO(n << ": " << linear << " " << curved);
    CHECK(curved < 0.1 * linear);
    if (n == 8) CHECK(curved < coarse / 5);
    coarse = curved;
    // Both facets at a side have the same curve there.
    for (Index i = 0; i < static_cast<Index>(smooth->facets.size()); ++i)
      for (int side = 0; side < 4; ++side) {
        const auto& f = smooth->facets[i];
        const Index a = f[Cell<2>::facet_corner(side, 0)], b = f[Cell<2>::facet_corner(side, 1)];
        const Point<3> on_side = 0.5 * (smooth->points[a] + smooth->points[b]) + off_chord(smooth->bends[i][side], 0.5);
        CHECK(foot_on_facet(*smooth, smooth->neighbours[i][side], on_side).distance2 < 1e-24);
      }
  }
}

TEST_CASE("hexahedra of a cylinder are refined onto its wall, and its ends stay flat") {
  AdaptOptions options;
  options.geometry = BoundaryShape::smooth;
  Adapter<3> adapter(std::get<Mesh<3>>(*parse_primitive("ogrid:3,1,2:1,0,1")), *MetricField<3>::from_formula("h = .2"),
                     options);
  CHECK(adapter.run().ok());
  const Mesh<3>& mesh = adapter.mesh();
  CHECK(validate(mesh).ok());
  int wall = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.support[v].dim == 3) continue;
    const Point<3>& p = mesh.points[v];
    const double r = std::hypot(p[0], p[1]);
    if (p[2] != 0.0 && p[2] != 1.0) CHECK(mesh.support[v].dim == 2);
    if (mesh.support[v].dim == 2 && (p[2] == 0.0 || p[2] == 1.0)) continue;
    ++wall;
    CHECK(r == Approx(1).epsilon(3e-6));  // of twelve chords, which are off by .034
  }
  CHECK(wall > 100);
}

}  // namespace smooth_geometry_test
