#include "pillowmesh/refine/vertex_copies.h"

#include <set>

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/mesh/slide.h"

namespace vertex_copies_test {

using namespace pillowmesh;

namespace {

/// The hull of a set and the copies that it needs.
template <int Dim>
struct Planned {
  Hull<Dim> hull;
  CopyPlan<Dim> plan;
  Status status;

  Planned(const Mesh<Dim>& mesh, const std::vector<CellId>& set, double shrink = 1.0) {
    find_hull<Dim>(mesh, set, {}, hull);
    status = plan_copies<Dim>(mesh, hull, shrink, plan);
  }
  [[nodiscard]] int copies_of(VertexId v) const {
    return static_cast<int>(std::count_if(plan.copies.begin(), plan.copies.end(), [&](auto& c) { return c.origin == v; }));
  }
};

}  // namespace

TEST_CASE("each hull vertex is copied once where the shrink set is one fan") {
  const auto mesh = make_grid<2>({5, 5}, Point<2>(0, 0), Point<2>(5, 5));
  const Planned<2> p(mesh, {11, 12, 13});
  REQUIRE(p.status.ok());
  CHECK(p.plan.copies.size() == 8);
  for (const VertexId v : p.hull.vertices) CHECK(p.copies_of(v) == 1);
  // Exactly the corners of the set on the hull are renamed.
  CHECK(p.plan.changes.size() == 12);
  for (const auto& change : p.plan.changes) {
    CHECK(p.hull.in_set[change.cell] == 1);
    CHECK(change.vertex >= mesh.vertex_count());
    CHECK(p.plan.copies[change.vertex - mesh.vertex_count()].origin == mesh.cells[change.cell][change.corner]);
  }
}

TEST_CASE("a vertex where two fans of shrunk quads touch gets a copy for each fan") {
  //   . S       cells 6 and 12 of a 5 x 5 grid touch at vertex 14 only
  //   S .
  const auto mesh = make_grid<2>({5, 5}, Point<2>(0, 0), Point<2>(5, 5));
  const Planned<2> p(mesh, {6, 12});
  REQUIRE(p.status.ok());
  CHECK(p.copies_of(14) == 2);
  CHECK(p.plan.copies.size() == 8);
  std::set<VertexId> used;
  for (const auto& change : p.plan.changes)
    if (mesh.cells[change.cell][change.corner] == 14) CHECK(used.insert(change.vertex).second);
  CHECK(used.size() == 2);
}

TEST_CASE("three fans around a vertex of valence 7 get three copies") {
  const auto mesh = corpus::star(7, 2);
  VertexId middle = kNone;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.points[v].norm() < 1e-12) middle = v;
  // Sector s holds cells 4 s to 4 s + 3, the first of which is at the middle.
  const Planned<2> p(mesh, {0, 8, 16, 20});  // sectors 0, 2, and 4 with 5
  REQUIRE(p.status.ok());
  CHECK(p.copies_of(middle) == 3);
  const Planned<2> one(mesh, {0, 4, 8});
  CHECK(one.copies_of(middle) == 1);
}

TEST_CASE("copies move a third across a set one cell thick, half of the cell if it is thicker") {
  const auto mesh = make_grid<2>({4, 6}, Point<2>(0, 0), Point<2>(4, 6));
  for (const double shrink : {1.0, 0.3}) {
    const Planned<2> row(mesh, {8, 9, 10, 11}, shrink);  // y from 2 to 3
    REQUIRE(row.status.ok());
    for (const auto& c : row.plan.copies) {
      const Point<2>& from = mesh.points[c.origin];
      CHECK(c.position[0] == Approx(from[0]));
      CHECK(c.position[1] == Approx(from[1] == 2 ? 2 + shrink / 3 : 3 - shrink / 3));
    }
    const Planned<2> two_rows(mesh, {8, 9, 10, 11, 12, 13, 14, 15}, shrink);  // y from 2 to 4
    REQUIRE(two_rows.status.ok());
    for (const auto& c : two_rows.plan.copies)
      CHECK(c.position[1] == Approx(mesh.points[c.origin][1] == 2 ? 2 + shrink / 2 : 4 - shrink / 2));
  }
}

TEST_CASE("copies at the domain's boundary are on the same side of it") {
  std::mt19937 random(9);
  for (const auto& [name, mesh] : corpus::meshes<2>())
    for (int i = 0; i < 30; ++i) {
      const Planned<2> p(mesh, corpus::random_set(mesh, 1 + random() % 8, random));
      if (!p.status.ok()) {
        CHECK(p.status.code == StatusCode::illegal);
        continue;
      }
      INFO(name << ", set " << i);
      for (const auto& c : p.plan.copies) {
        CHECK(c.support.dim > 0);
        if (c.support.dim == 2) {
          CHECK(c.anchor == kNone);
          continue;
        }
        REQUIRE(c.anchor != kNone);
        CHECK(mesh.geometry->patch[c.anchor] == c.support.entity);
        Index anchor = c.anchor;
        CHECK((slide(*mesh.geometry, c.support, anchor, c.position) - c.position).norm() < 1e-12);
        if (mesh.support[c.origin].dim == 1) CHECK(c.support == mesh.support[c.origin]);
      }
    }
}

TEST_CASE("two hexes that share only an edge are one component where they are joined, and two apart") {
  const auto mesh = make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(4, 4, 4));
  // Diagonal neighbours in the plane z: they share an edge of two vertices, around which O is joined, S is not.
  const CellId a = 21, b = 21 + 1 + 4;
  const Planned<3> p(mesh, {a, b});
  REQUIRE(p.status.ok());
  int shared = 0;
  for (const VertexId v : mesh.cells[a])
    if (corner_of(mesh, b, v) >= 0) {
      ++shared;
      CHECK(p.copies_of(v) == 2);
    }
  CHECK(shared == 2);
  CHECK(p.plan.kept_inside.empty());
}

}  // namespace vertex_copies_test
