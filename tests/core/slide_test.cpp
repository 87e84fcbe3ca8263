#include "pillowmesh/mesh/slide.h"

#include "../catch.h"
#include "checks.h"
#include "meshes.h"

namespace slide_test {

using namespace pillowmesh;

namespace {

VertexId vertex_at(const Mesh<2>& mesh, const Point<2>& p) {
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if ((mesh.points[v] - p).norm() < 1e-9) return v;
  return kNone;
}

}  // namespace

TEST_CASE("a boundary vertex stays where it is, an interior one goes where it is told") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    CHECK(checks::distance_from_geometry(mesh) < 1e-14);
  }
  for (const auto& [name, mesh] : corpus::meshes<3>()) {
    INFO(name);
    CHECK(checks::distance_from_geometry(mesh) < 1e-14);
  }
  const auto mesh = corpus::ell(4);
  Index anchor = kNone;
  CHECK(slide(*mesh.geometry, {2, kNone}, anchor, Point<2>(17, 4)) == Point<2>(17, 4));
}

TEST_CASE("sliding walks along a straight side and stops at its corners") {
  const auto mesh = make_grid<2>({8, 2}, Point<2>(0, 0), Point<2>(8, 2));
  const VertexId v = vertex_at(mesh, Point<2>(1, 0));
  REQUIRE(mesh.support[v].dim == 1);
  Index anchor = mesh.anchor[v];
  CHECK((slide(*mesh.geometry, mesh.support[v], anchor, Point<2>(6.3, 0.7)) - Point<2>(6.3, 0)).norm() < 1e-14);
  CHECK(slide(*mesh.geometry, mesh.support[v], anchor, Point<2>(11, 1)) == Point<2>(8, 0));
  CHECK(slide(*mesh.geometry, mesh.support[v], anchor, Point<2>(-3, -2)) == Point<2>(0, 0));
  // The anchor has followed: from the other end it comes back.
  CHECK((slide(*mesh.geometry, mesh.support[v], anchor, Point<2>(4.5, 0)) - Point<2>(4.5, 0)).norm() < 1e-14);
}

TEST_CASE("on a closed curve one can slide all the way round") {
  const auto mesh = corpus::ring(24, 2, true);
  const VertexId v = vertex_at(mesh, Point<2>(2, 0));
  REQUIRE(mesh.support[v].dim == 1);
  Index anchor = mesh.anchor[v];
  const Index start = anchor;
  Point<2> p = mesh.points[v];
  for (int i = 1; i <= 96; ++i) {
    const double a = 2 * 3.14159265358979 * i / 96;
    p = slide(*mesh.geometry, mesh.support[v], anchor, Point<2>(2 * std::cos(a), 2 * std::sin(a)));
    CHECK(p.norm() <= 2 + 1e-12);
    CHECK(p.norm() >= 2 * std::cos(3.14159265358979 / 24) - 1e-12);  // on the chords, not on the circle
  }
  CHECK((p - mesh.points[v]).norm() < 1e-9);
  CHECK(std::abs(anchor - start) <= 1);
}

TEST_CASE("a vertex of a hex mesh slides on its face, or along its edge") {
  const auto mesh = make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(4, 4, 4));
  int faces = 0, edges = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const Point<3> away = mesh.points[v] + Point<3>(1.3, 0.7, -0.9);
    Index anchor = mesh.anchor[v];
    if (mesh.support[v].dim == 2 || mesh.support[v].dim == 1) {
      const Point<3> p = slide(*mesh.geometry, mesh.support[v], anchor, away);
      for (int d = 0; d < 3; ++d) {
        CHECK(p[d] >= -1e-12);
        CHECK(p[d] <= 4 + 1e-12);
        const bool fixed = std::abs(mesh.points[v][d]) < 1e-12 || std::abs(mesh.points[v][d] - 4) < 1e-12;
        const double expected = fixed ? mesh.points[v][d] : std::min(4.0, std::max(0.0, away[d]));
        CHECK(p[d] == Approx(expected).margin(1e-9));
      }
      ++(mesh.support[v].dim == 2 ? faces : edges);
    }
  }
  CHECK(faces == 6 * 9);
  CHECK(edges == 12 * 3);
}

TEST_CASE("a copy that leaves a corner finds the side it is to slide on") {
  const auto mesh = make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(3, 3));
  const VertexId corner = vertex_at(mesh, Point<2>(0, 0)), on_left = vertex_at(mesh, Point<2>(0, 1));
  const VertexSupport left = mesh.support[on_left];
  const Index anchor = anchor_on(mesh, left, corner, Point<2>(0, 0.3));
  REQUIRE(anchor != kNone);
  CHECK(mesh.geometry->patch[anchor] == left.entity);
  const auto& f = mesh.geometry->facets[anchor];
  CHECK(std::min(mesh.geometry->points[f[0]][1], mesh.geometry->points[f[1]][1]) == 0.0);  // the facet at the corner
  CHECK(anchor_on(mesh, {2, kNone}, corner, Point<2>(1, 1)) == kNone);
  CHECK(anchor_on(mesh, left, on_left, Point<2>(0, 1.2)) == mesh.anchor[on_left]);
}

}  // namespace slide_test
