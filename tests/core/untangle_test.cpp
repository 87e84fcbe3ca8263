#include "pillowmesh/refine/untangle.h"

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/mesh/validate.h"

using namespace pillowmesh;

namespace {

template <int Dim>
std::vector<VertexId> inner_vertices(const Mesh<Dim>& mesh) {
  std::vector<VertexId> inner;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.support[v].dim == Dim) inner.push_back(v);
  return inner;
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
    auto quads = corpus::shaken(make_grid<2>({5, 5}, Point<2>(0, 0), Point<2>(5, 5)), 1.0, 0.9, seed);
    REQUIRE_FALSE(positive(quads));
    CHECK(untangle<2>(quads, inner_vertices(quads)));
    CHECK(validate(quads).message == "");
    auto hexes = corpus::shaken(make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(4, 4, 4)), 1.0, 0.6, seed);
    REQUIRE_FALSE(positive(hexes));
    CHECK(untangle<3>(hexes, inner_vertices(hexes)));
    CHECK(validate(hexes).message == "");
  }
}

TEST_CASE("only the vertices named move, and boundary vertices along their side") {
  auto mesh = make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(4, 4));
  // Vertex 6 is pushed across the side of the square, its neighbour 1 on that side past the one after it.
  mesh.points[6] = Point<2>(2.5, 0.6);
  mesh.points[1] = Point<2>(1.9, 0.0);
  const auto before = mesh;
  const std::vector<VertexId> free{1, 6};
  CHECK(untangle<2>(mesh, free));
  CHECK(positive(mesh));
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (v != 1 && v != 6) CHECK(mesh.points[v] == before.points[v]);
  CHECK(mesh.points[1][1] == 0.0);
  CHECK(checks::distance_from_geometry(mesh) < 1e-12);
}

TEST_CASE("what cannot be untangled is reported") {
  // The middle vertex of a 2 x 2 grid is free, but a corner of its frame has been pushed beyond the opposite one.
  auto mesh = make_grid<2>({2, 2}, Point<2>(0, 0), Point<2>(2, 2));
  mesh.points[0] = Point<2>(3, 3);
  CHECK_FALSE(untangle<2>(mesh, std::vector<VertexId>{4}));
}

TEST_CASE("a corner of the domain stays even if it is named") {
  auto mesh = make_grid<2>({2, 2}, Point<2>(0, 0), Point<2>(2, 2));
  mesh.points[4] = Point<2>(-0.5, -0.5);
  CHECK(untangle<2>(mesh, std::vector<VertexId>{0, 4}));
  CHECK(mesh.points[0] == Point<2>(0, 0));
  CHECK(positive(mesh));
}
