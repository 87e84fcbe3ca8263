#include "pillowmesh/mesh/validate.h"

#include <algorithm>

#include "../catch.h"
#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/topology.h"

namespace validate_test {

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
template <int Dim>
std::string refusal(MeshInput<Dim> in) {
  const auto mesh = make_mesh(std::move(in));
  REQUIRE(!mesh.ok());
  CHECK(mesh.status().code == StatusCode::bad_input);
  return mesh.status().message;
}
/// Unit cubes of a lattice at these places. Vertices are numbered as cubes first name them: those of the first are 0
/// to 7.
MeshInput<3> cubes(const std::vector<std::array<int, 3>>& places) {
  MeshInput<3> in;
  for (const auto& p : places) {
    Corners<3> cell;
    for (int k = 0; k < 8; ++k) {
      const Point<3> x(p[0] + (k & 1), p[1] + (k >> 1 & 1), p[2] + (k >> 2 & 1));
      const auto at = std::find(in.points.begin(), in.points.end(), x);
      cell[k] = static_cast<VertexId>(at - in.points.begin());
      if (at == in.points.end()) in.points.push_back(x);
    }
    in.cells.push_back(cell);
  }
  return in;
}
/// As make_mesh begins, without any check.
Mesh<3> connected(const MeshInput<3>& in) {
  Mesh<3> mesh;
  mesh.points = in.points;
  mesh.cells = in.cells;
  REQUIRE(connect_cells(mesh).ok());
  return mesh;
}
int count(const std::vector<Defect>& defects, Defect::Kind kind) {
  return static_cast<int>(std::count_if(defects.begin(), defects.end(), [&](auto& d) { return d.kind == kind; }));
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
  in.points = {Point<2>(0, 0), Point<2>(2, 0), Point<2>(3, 0), Point<2>(0, 2),
               Point<2>(2, 2), Point<2>(3, 1), Point<2>(2, 1), Point<2>(3, 2)};
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
  CHECK(says(refusal(MeshInput<2>{}), "no cells"));
  CHECK(says(refusal(MeshInput<3>{}), "no cells"));
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

TEST_CASE("cubes that share facets are accepted, whichever axes they share them along") {
  CHECK(make_mesh(cubes({{0, 0, 0}})).ok());
  CHECK(make_mesh(cubes({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}})).ok());
  auto turned = cubes({{0, 0, 0}, {1, 0, 0}});
  auto& c = turned.cells[1];  // local axes x, y, z become y, z, x
  c = {c[0], c[2], c[4], c[6], c[1], c[3], c[5], c[7]};
  CHECK(make_mesh(turned).ok());
}

TEST_CASE("an inside-out hex is refused by number and line, and all of them are counted") {
  auto in = cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  for (const int i : {1, 2}) {
    auto& c = in.cells[i];
    c = {c[1], c[0], c[3], c[2], c[5], c[4], c[7], c[6]};
  }
  in.cell_lines = {20, 21, 22};
  const std::string text = refusal(in);
  CHECK(says(text, "hex 1 at (1.5, 0.5, 0.5) is inside out"));
  CHECK(says(text, "line 21"));
  CHECK(says(text, "1 more defect, in hex 2"));
}

TEST_CASE("a hex with one corner pushed through is refused with the vertex") {
  auto in = cubes({{0, 0, 0}, {1, 0, 0}});
  in.points[in.cells[1][7]] = Point<3>(1.2, 0.2, 0.2);
  const std::string text = refusal(in);
  CHECK(says(text, "hex 1 is inverted"));
}

TEST_CASE("a hex that names a vertex twice is refused") {
  auto in = cubes({{0, 0, 0}, {1, 0, 0}});
  in.cells[1][7] = in.cells[1][5];
  CHECK(says(refusal(in), "hex 1 is degenerate"));
}

TEST_CASE("two hexes that share two facets are found, and told as the cause of the inverted one") {
  //  y
  //  2-------3         The second hex lies around the edge 3-7 of the cube: its section is 1, 8, 2, 3. At vertex 3 both
  //  |  hex  | \       hexes have the same three edges, so one of them is inverted wherever the vertices are.
  //  |   0   |1 8
  //  0-------1   x
  auto in = cubes({{0, 0, 0}});
  in.points.push_back(Point<3>(2, 2, 0));
  in.points.push_back(Point<3>(2, 2, 1));
  in.cells.push_back({1, 8, 3, 2, 5, 9, 7, 6});
  const auto defects = find_adjacency_defects(connected(in), 20);
  REQUIRE(defects.size() == 1);
  CHECK(defects[0].kind == Defect::Kind::shared_facets);
  CHECK(defects[0].message == "hex 0 and hex 1 share two facets");
  const std::string text = refusal(in);
  CHECK(says(text, "hex 1 is inverted"));
  CHECK(says(text, "shares two facets with hex 0"));
}

TEST_CASE("three hexes at one facet are refused") {
  auto in = cubes({{0, 0, 0}, {1, 0, 0}});
  const auto c = in.cells[1];
  for (int k = 0; k < 4; ++k) in.points.push_back(Point<3>(3, k & 1, k >> 1));
  in.cells.push_back({c[0], 12, c[2], 13, c[4], 14, c[6], 15});
  const std::string text = refusal(in);
  CHECK(says(text, "more than two cells meet at one facet"));
  CHECK(says(text, "cells 0 and 2 and cell 1"));
}

TEST_CASE("hexes that touch at an edge only are refused by number") {
  const auto in = cubes({{0, 0, 0}, {1, 1, 0}});
  const auto defects = find_adjacency_defects(connected(in), 20);
  CHECK(count(defects, Defect::Kind::non_manifold_edge) == 1);
  CHECK(count(defects, Defect::Kind::non_manifold_vertex) == 2);
  const std::string text = refusal(in);
  CHECK(says(text, "4 boundary facets, of hex 0, hex 1, meet at the edge of vertices 3 and 7 at (1, 1, 0)"));
}

TEST_CASE("an edge where the mesh touches itself is found though the cells at its vertices are connected") {
  // Four cubes below, two above that share with each other only the upright edge at (1, 1).
  const auto in = cubes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 1, 1}});
  const auto defects = find_adjacency_defects(connected(in), 20);
  CHECK(count(defects, Defect::Kind::non_manifold_edge) == 1);
  CHECK(says(refusal(in), "of hex 4, hex 5"));
}

TEST_CASE("hexes that touch at a vertex only are refused by number") {
  const auto in = cubes({{0, 0, 0}, {1, 1, 1}});
  const auto defects = find_adjacency_defects(connected(in), 20);
  REQUIRE(defects.size() == 1);
  CHECK(defects[0].kind == Defect::Kind::non_manifold_vertex);
  CHECK(defects[0].vertex == 7);
  CHECK(says(refusal(in), "touches itself"));
  CHECK(says(refusal(in), "hex 1 and hex 0 are not"));
}

TEST_CASE("a facet that is split on one side only is found") {
  auto in = cubes({{0, 0, 0}});
  in.points.push_back(Point<3>(1, 0, 0.5));
  in.points.push_back(Point<3>(1, 1, 0.5));
  const auto add = [&](const std::array<VertexId, 4>& left, double low, double high) {
    Corners<3> cell;
    for (int k = 0; k < 4; ++k) {
      cell[2 * k] = left[k];
      cell[2 * k + 1] = static_cast<VertexId>(in.points.size());
      in.points.push_back(Point<3>(2, k & 1, k >> 1 ? high : low));
    }
    in.cells.push_back(cell);
  };
  add({1, 3, 8, 9}, 0, 0.5);
  add({8, 9, 5, 7}, 0.5, 1);
  const std::string text = refusal(in);
  CHECK(says(text, "not conforming"));
  CHECK(says(text, "vertex 8"));
}

TEST_CASE("a hex with positive corners that is inverted inside is reported, and not refused") {
  const Point<3> corners[8] = {Point<3>(1, -1, -3), Point<3>(5, 0, -1), Point<3>(1, 6, 2), Point<3>(5, 1, -2),
                               Point<3>(0, 2, 4),   Point<3>(4, 1, 4),  Point<3>(0, 4, 1), Point<3>(1, 7, 5)};
  auto in = cubes({{0, 0, 0}});
  in.points.assign(corners, corners + 8);
  const auto mesh = make_mesh(in);
  REQUIRE(mesh.ok());
  CHECK(validate(*mesh).ok());
  const auto defects = find_inside_defects(*mesh);
  REQUIRE(defects.size() == 1);
  CHECK(defects[0].kind == Defect::Kind::inverted_inside);
  CHECK(says(defects[0].message, "hex 0 is inverted inside"));
  CHECK(says(defects[0].message, "(0, 1, 0.5)"));  // the middle of an edge, by a search over such hexes
  CHECK(find_inside_defects(make_grid<3>({3, 3, 3}, Point<3>(0, 0, 0), Point<3>(1, 1, 1))).empty());
  CHECK(find_inside_defects(*make_mesh(two_quads())).empty());
}

TEST_CASE("the Jacobian inside agrees with the corners and with differences") {
  const auto mesh = *make_mesh([] {
    auto in = cubes({{0, 0, 0}});
    in.points[7] = Point<3>(1.4, 1.2, 0.7);
    in.points[2] = Point<3>(-0.2, 0.8, 0.1);
    return in;
  }());
  const auto position = [&](int k) -> const Point<3>& { return mesh.points[mesh.cells[0][k]]; };
  for (int k = 0; k < 8; ++k)
    CHECK(jacobian_at({1.0 * (k & 1), 1.0 * (k >> 1 & 1), 1.0 * (k >> 2)}, position) ==
          Approx(corner_jacobian<3>(k, position)));
  const auto map = [&](double u, double v, double w) {
    Point<3> x = Point<3>::Zero();
    for (int k = 0; k < 8; ++k) x += (k & 1 ? u : 1 - u) * (k & 2 ? v : 1 - v) * (k & 4 ? w : 1 - w) * position(k);
    return x;
  };
  // The map is linear along each axis, so that differences are derivatives.
  const Point<3> o = map(0.3, 0.6, 0.2);
  CHECK(jacobian_at({0.3, 0.6, 0.2}, position) ==
        Approx(triple((map(0.4, 0.6, 0.2) - o) / 0.1, (map(0.3, 0.7, 0.2) - o) / 0.1, (map(0.3, 0.6, 0.3) - o) / 0.1)));
}

TEST_CASE("a long list of defects is told by the first cells and the number") {
  auto mesh = make_grid<3>({20, 1, 1}, Point<3>(0, 0, 0), Point<3>(20, 1, 1));
  for (auto& p : mesh.points) p[1] = -p[1];
  const std::string text = validate(mesh).message;
  CHECK(says(text, "hex 0 at"));
  CHECK(says(text, "; 19 more defects, in hexes 1, 2, 3, 4, 5, 6, 7, 8, ..."));
  CHECK(says(describe<3>(find_cell_defects(mesh, 5), 5), "at least 4 more defects"));
}

}  // namespace validate_test
