#include "pillowmesh/refine/dice.h"

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/mesh/validate.h"

namespace dice_test {

using namespace pillowmesh;

namespace {

template <int Dim>
void check_dice(const Mesh<Dim>& mesh, int n) {
  Mesh<Dim> diced = mesh;
  REQUIRE(dice(diced, n).ok());
  const Status valid = validate(diced);
  INFO(valid.message);
  REQUIRE(valid.ok());
  int pieces = 1;
  for (int d = 0; d < Dim; ++d) pieces *= n;
  CHECK(diced.cell_count() == pieces * mesh.cell_count());
  CHECK(checks::euler(diced) == checks::euler(mesh));
  // The vertices of the mesh keep their numbers and places.
  CHECK(std::equal(mesh.points.begin(), mesh.points.end(), diced.points.begin()));
  CHECK(std::equal(mesh.support.begin(), mesh.support.end(), diced.support.begin()));
  // No corner of the domain is made up, and the new boundary vertices are on the boundary.
  for (VertexId v = mesh.vertex_count(); v < diced.vertex_count(); ++v) CHECK(diced.support[v].dim > 0);
  CHECK(checks::distance_from_geometry(diced) < 1e-12);
  const auto before = checks::boundary_by_group(mesh), after = checks::boundary_by_group(diced);
  REQUIRE(after.size() == before.size());
  for (const auto& [group, size] : before) CHECK(after.at(group) == Approx(size));
}

}  // namespace

TEST_CASE("dicing splits every quad in n x n, keeps vertices, groups, Euler number and area") {
  for (const auto& [name, mesh] : corpus::meshes<2>())
    for (const int n : {2, 3, 5}) {
      INFO(name << ", n = " << n);
      check_dice(mesh, n);
      Mesh<2> diced = mesh;
      REQUIRE(dice(diced, n).ok());
      CHECK(checks::area(diced) == Approx(checks::area(mesh)));
    }
}

TEST_CASE("dicing splits every hex in n x n x n, keeps vertices, groups and Euler number") {
  for (const auto& [name, mesh] : corpus::meshes<3>())
    for (const int n : {2, 3}) {
      INFO(name << ", n = " << n);
      check_dice(mesh, n);
    }
}

TEST_CASE("dicing twice by two is dicing by four") {
  auto twice = corpus::star(5, 2), once = twice;
  REQUIRE(dice(twice, 2).ok());
  REQUIRE(dice(twice, 2).ok());
  REQUIRE(dice(once, 4).ok());
  CHECK(twice.cell_count() == once.cell_count());
  CHECK(twice.vertex_count() == once.vertex_count());
  const auto before = [](const Point<2>& a, const Point<2>& b) { return a[0] != b[0] ? a[0] < b[0] : a[1] < b[1]; };
  // The same points up to rounding: each of one has one of the other next to it.
  auto a = twice.points;
  std::sort(a.begin(), a.end(), before);
  for (const Point<2>& p : once.points) {
    const bool found = std::any_of(a.begin(), a.end(), [&](const Point<2>& q) { return (p - q).norm() < 1e-14; });
    CHECK(found);
  }
}

TEST_CASE("cell c becomes cells c n^2 to c n^2 + n^2 - 1, of its region") {
  auto mesh = make_grid<2>({2, 1}, Point<2>(0, 0), Point<2>(2, 1));
  mesh.region = {0, 1};
  mesh.region_groups = {{1, "left"}, {2, "right"}};
  REQUIRE(dice(mesh, 3).ok());
  for (CellId c = 0; c < 18; ++c) {
    CHECK(mesh.region[c] == c / 9);
    for (const VertexId v : mesh.cells[c]) CHECK((c < 9 ? mesh.points[v][0] <= 1 : mesh.points[v][0] >= 1));
  }
}

TEST_CASE("dicing by one changes nothing") {
  const auto mesh = corpus::ell(4);
  auto diced = mesh;
  REQUIRE(dice(diced, 1).ok());
  CHECK(corpus::identical(mesh, diced));
}

}  // namespace dice_test
