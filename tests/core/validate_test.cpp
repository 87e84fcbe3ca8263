#include "pillowmesh/mesh/validate.h"

#include "../catch.h"
#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/primitives.h"

using namespace pillowmesh;

namespace {
MeshInput<2> two_quads() {
  //  3---4---5
  //  |   |   |
  //  0---1---2
  MeshInput<2> in;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) in.points.push_back(Point<2>(i, j));
  in.cells = {{0, 1, 3, 4}, {1, 2, 4, 5}};
  return in;
}
std::string refusal(MeshInput<2> in) {
  const auto mesh = make_mesh(std::move(in));
  REQUIRE(!mesh.ok());
  CHECK(mesh.status().code == StatusCode::bad_input);
  return mesh.status().message;
}
bool says(const std::string& text, const std::string& part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}
}  // namespace

TEST_CASE("a conforming pair of quads is accepted") { CHECK(make_mesh(two_quads()).ok()); }

TEST_CASE("a quad listed clockwise is refused by number and line") {
  auto in = two_quads();
  in.cells[1] = {2, 1, 5, 4};
  in.cell_lines = {10, 11};
  const std::string text = refusal(in);
  CHECK(says(text, "quad 1"));
  CHECK(says(text, "inside out"));
  CHECK(says(text, "line 11"));
}

TEST_CASE("a quad with a re-entrant corner is refused with the vertex") {
  auto in = two_quads();
  in.points[4] = Point<2>(1.8, .2);
  CHECK(says(refusal(in), "vertex 4"));
}

TEST_CASE("a quad that names a vertex twice is refused") {
  auto in = two_quads();
  in.cells[0] = {0, 1, 3, 3};
  CHECK(says(refusal(in), "degenerate"));
}

TEST_CASE("a hanging node is found") {
  //  3-------4       the right edge of the large quad is split on one side only
  //  |       |---7
  //  |       6---8
  //  |       |---5
  //  0-------1
  MeshInput<2> in;
  in.points = {Point<2>(0, 0), Point<2>(2, 0), Point<2>(3, 0), Point<2>(0, 2), Point<2>(2, 2), Point<2>(3, 1), Point<2>(2, 1), Point<2>(3, 2)};
  in.cells = {{0, 1, 3, 4}, {1, 2, 6, 5}, {6, 5, 4, 7}};
  const std::string text = refusal(in);
  CHECK(says(text, "not conforming"));
  CHECK(says(text, "vertex 6"));
}

TEST_CASE("three quads at one edge are refused") {
  auto in = two_quads();
  in.points.push_back(Point<2>(5, 0));
  in.points.push_back(Point<2>(5, 1));
  in.cells.push_back({1, 6, 4, 7});
  CHECK(says(refusal(in), "more than two"));
}

TEST_CASE("two quads that touch at a vertex only are refused") {
  MeshInput<2> in;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) in.points.push_back(Point<2>(i, j));
  in.cells = {{0, 1, 3, 4}, {4, 5, 7, 8}};
  CHECK(says(refusal(in), "touches itself"));
}

TEST_CASE("unused vertices are dropped and a mesh without cells is refused") {
  auto in = two_quads();
  in.points.push_back(Point<2>(100, 100));
  const auto mesh = make_mesh(in);
  REQUIRE(mesh.ok());
  CHECK(mesh->vertex_count() == 6);
  CHECK(says(refusal({}), "no cells"));
}

TEST_CASE("broken adjacency and broken supports are found") {
  auto mesh = make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(1, 1));
  auto twins = mesh;
  std::swap(twins.twins[4][0], twins.twins[4][1]);
  CHECK(!validate(twins).ok());
  auto support = mesh;
  support.support[5] = {1, 0};
  CHECK(says(validate(support).message, "vertex 5"));
}
