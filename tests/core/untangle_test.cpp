#include "pillowmesh/refine/untangle.h"

#include <algorithm>
#include <set>

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/mesh/validate.h"

namespace untangle_test {

using namespace pillowmesh;

namespace {

template <int Dim>
std::vector<VertexId> inner_vertices(const Mesh<Dim>& mesh) {
  std::vector<VertexId> inner;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.support[v].dim == Dim) inner.push_back(v);
  return inner;
}

/// `mesh` with `vertices` free; its cells are to have the form that they have in `wanted`.
template <int Dim>
bool untangle(Mesh<Dim>& mesh, const Mesh<Dim>& wanted, const std::vector<VertexId>& vertices) {
  TangledPatch<Dim> patch;
  extend<Dim>(patch, wanted, vertices);
  std::int64_t most_work = 1'000'000;
  return untangle<Dim>(mesh, patch, 0.0, most_work);
}

template <int Dim>
bool positive(const Mesh<Dim>& mesh) {
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    if (!(min_corner_jacobian(mesh, c) > 0)) return false;
  return true;
}

}  // namespace

TEST_CASE("vertices that were thrown about are brought back to where no cell is inside out") {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const auto squares = make_grid<2>({5, 5}, Point<2>(0, 0), Point<2>(5, 5));
    auto quads = corpus::shaken(squares, 1.0, 0.9, seed);
    REQUIRE_FALSE(positive(quads));
    CHECK(untangle(quads, squares, inner_vertices(quads)));
    CHECK(validate(quads).message == "");
    const auto cubes = make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(4, 4, 4));
    auto hexes = corpus::shaken(cubes, 1.0, 0.9, seed);
    REQUIRE_FALSE(positive(hexes));
    CHECK(untangle(hexes, cubes, inner_vertices(hexes)));
    CHECK(validate(hexes).message == "");
    CHECK(find_inside_defects(hexes).empty());
  }
}

TEST_CASE("only the vertices named move, and boundary vertices along their side") {
  const auto squares = make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(4, 4));
  auto mesh = squares;
  // Vertex 6 is pushed across the side of the square, its neighbour 1 on that side past the one after it.
  mesh.points[6] = Point<2>(2.5, 0.6);
  mesh.points[1] = Point<2>(1.9, 0.0);
  const auto before = mesh;
  CHECK(untangle(mesh, squares, {1, 6}));
  CHECK(positive(mesh));
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (v != 1 && v != 6) CHECK(mesh.points[v] == before.points[v]);
  CHECK(mesh.points[1][1] == 0.0);
  CHECK(checks::distance_from_geometry(mesh) < 1e-12);
}

TEST_CASE("what cannot be untangled is reported") {
  // The middle vertex of a 2 x 2 grid is free, but a corner of its frame has been pushed beyond the opposite one.
  const auto squares = make_grid<2>({2, 2}, Point<2>(0, 0), Point<2>(2, 2));
  auto mesh = squares;
  mesh.points[0] = Point<2>(3, 3);
  CHECK_FALSE(untangle(mesh, squares, {4}));
}

TEST_CASE("a corner of the domain stays even if it is named") {
  const auto squares = make_grid<2>({2, 2}, Point<2>(0, 0), Point<2>(2, 2));
  auto mesh = squares;
  mesh.points[4] = Point<2>(-0.5, -0.5);
  CHECK(untangle(mesh, squares, {0, 4}));
  CHECK(mesh.points[0] == Point<2>(0, 0));
  CHECK(positive(mesh));
}

TEST_CASE("cells keep their stretching where there is room for it") {
  // A slab of hexes 100 times as wide as thick, one vertex pushed through the slab's top layer.
  const auto slab = make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(4, 4, 0.04));
  auto mesh = slab;
  const VertexId v = 62;  // the middle: (2, 2, 0.02)
  REQUIRE((mesh.points[v] - Point<3>(2, 2, 0.02)).norm() < 1e-12);
  mesh.points[v][2] = 0.035;
  REQUIRE_FALSE(positive(mesh));
  CHECK(untangle(mesh, slab, {v}));
  CHECK((mesh.points[v] - slab.points[v]).norm() < 0.01);
}

TEST_CASE("a patch has every cell at its free vertices once, each in the form from before it was touched") {
  const auto cubes = make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(4, 4, 4));
  TangledPatch<3> patch;
  extend<3>(patch, cubes, std::vector<VertexId>{62, 62, 0});  // the middle, twice, and a corner of the domain
  CHECK(patch.free == std::vector<VertexId>{62});
  CHECK(patch.cells.size() == 8);
  extend<3>(patch, cubes, std::vector<VertexId>{61, 62, 63});
  CHECK(patch.free == std::vector<VertexId>{61, 62, 63});
  CHECK(patch.cells.size() == 16);
  CHECK(std::is_sorted(patch.known.begin(), patch.known.end()));
  CHECK(std::set<CellId>(patch.cells.begin(), patch.cells.end()).size() == 16);
  for (std::size_t i = 0; i < patch.cells.size(); ++i)
    for (int k = 0; k < 8; ++k) CHECK(patch.shapes[i][k] == cubes.points[cubes.cells[patch.cells[i]][k]]);
}

}  // namespace untangle_test
