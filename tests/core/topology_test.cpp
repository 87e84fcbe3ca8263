#include "pillowmesh/mesh/topology.h"

#include <set>

#include "../catch.h"
#include "checks.h"
#include "meshes.h"

namespace topology_test {

using namespace pillowmesh;

namespace {

template <int Dim>
void check_walks(const Mesh<Dim>& mesh) {
  using C = Cell<Dim>;
  // By brute force: who has this vertex, who has this edge.
  std::vector<std::vector<CellId>> at(mesh.points.size());
  std::map<std::array<VertexId, 2>, std::set<CellId>> at_edge;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    for (const VertexId v : mesh.cells[c]) at[v].push_back(c);
    for (int e = 0; e < C::edges; ++e) {
      const VertexId a = mesh.cells[c][C::edge_from(e)], b = mesh.cells[c][C::edge_to(e)];
      at_edge[{std::min(a, b), std::max(a, b)}].insert(c);
    }
  }
  std::vector<CellCorner> star;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    vertex_star(mesh, v, star);
    std::vector<CellId> cells;
    for (const auto& [c, k] : star) {
      REQUIRE(mesh.cells[c][k] == v);
      REQUIRE(corner_of(mesh, c, v) == k);
      cells.push_back(c);
    }
    std::sort(cells.begin(), cells.end());
    REQUIRE(cells == at[v]);
  }
  std::size_t represented = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int e = 0; e < C::edges; ++e) {
      const VertexId a = mesh.cells[c][C::edge_from(e)], b = mesh.cells[c][C::edge_to(e)];
      const auto& expected = at_edge[{std::min(a, b), std::max(a, b)}];
      std::set<CellId> met;
      for_each_cell_at_edge(mesh, {c, e}, [&](CellId n, int f) {
        REQUIRE(met.insert(n).second);  // each once
        REQUIRE(edge_between(mesh, n, a, b) == f);
        REQUIRE(edge_between(mesh, n, b, a) == f);
      });
      REQUIRE(met == expected);
      REQUIRE(represents_edge(mesh, {c, e}) == (c == *expected.begin()));
      represented += represents_edge(mesh, {c, e});
    }
  const auto edges = unique_edges(mesh);
  CHECK(edges.size() == at_edge.size());
  CHECK(represented == at_edge.size());
  std::set<std::array<VertexId, 2>> seen;
  for (const auto& [a, b] : edges) CHECK(seen.insert({std::min(a, b), std::max(a, b)}).second);
}

}  // namespace

TEST_CASE("stars and edge rings hold exactly the cells there, each once") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    check_walks(mesh);
  }
  for (const auto& [name, mesh] : corpus::meshes<3>()) {
    INFO(name);
    check_walks(mesh);
  }
}

TEST_CASE("discs and balls have Euler number 1, what goes round 0, and a box the numbers one can count") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    CHECK(checks::euler(mesh) == (name == "annulus" || name == "snail" ? 0 : 1));
  }
  for (const auto& [name, mesh] : corpus::meshes<3>()) CHECK(checks::euler(mesh) == 1);
  // n x m x k cells: n (m + 1) (k + 1) edges along the first axis, and so on.
  const auto box = make_grid<3>({2, 3, 4}, Point<3>(0, 0, 0), Point<3>(2, 3, 4));
  CHECK(unique_edges(box).size() == 2 * 4 * 5 + 3 * 3 * 5 + 4 * 3 * 4);
}

TEST_CASE("adjacency does not depend on what was there before, nor on dead cells") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    auto again = mesh;
    again.twins.clear();
    again.vertex_cell.clear();
    REQUIRE(connect_cells(again).ok());
    for (CellId c = 0; c < mesh.cell_count(); ++c)
      for (int f = 0; f < 4; ++f) CHECK(again.neighbour(c, f) == mesh.neighbour(c, f));
  }
  auto grid = make_grid<2>({3, 1}, Point<2>(0, 0), Point<2>(3, 1));
  grid.cells[1].fill(kNone);
  REQUIRE(connect_cells(grid).ok());
  for (int f = 0; f < 4; ++f) {
    CHECK(grid.on_boundary(0, f));
    CHECK(grid.on_boundary(2, f));
  }
}

TEST_CASE("cells that do not fit together are refused with their numbers") {
  Mesh<2> mesh;
  mesh.points = {Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1), Point<2>(1, 1), Point<2>(2, 0), Point<2>(2, 1)};
  mesh.cells = {{0, 1, 2, 3}, {4, 1, 5, 3}};  // the second is clockwise: both see edge 1-3 the same way
  const Status s = connect_cells(mesh);
  INFO(s.message);
  CHECK(s.code == StatusCode::bad_input);
  CHECK(s.message.find('1') != std::string::npos);
}

TEST_CASE("the corners of a facet go round its outward normal with facet_sign") {
  const auto square = make_grid<2>({1, 1}, Point<2>(0, 0), Point<2>(1, 1));
  for (int f = 0; f < 4; ++f) {
    const auto v = square.facet_vertices(0, f);
    const Point<2> e = facet_sign<2>(f) * (square.points[v[1]] - square.points[v[0]]);
    const Point<2> outward = 0.5 * (square.points[v[0]] + square.points[v[1]]) - Point<2>(0.5, 0.5);
    CHECK(cross(outward, e) > 0);  // counterclockwise
  }
  const auto cube = make_grid<3>({1, 1, 1}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  for (int f = 0; f < 6; ++f) {
    const auto v = cube.facet_vertices(0, f);
    const Point<3> a = cube.points[v[1]] - cube.points[v[0]], b = cube.points[v[2]] - cube.points[v[0]];
    const Point<3> outward = 0.5 * (cube.points[v[0]] + cube.points[v[3]]) - Point<3>(0.5, 0.5, 0.5);
    CHECK(facet_sign<3>(f) * triple(a, b, outward) > 0);
  }
}

}  // namespace topology_test
