#include "pillowmesh/mesh/primitives.h"

#include "../catch.h"
#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"

using namespace pillowmesh;

TEST_CASE("a grid has the counts of a box and is valid") {
  const auto quads = make_grid<2>({3, 2}, Point<2>(0, 0), Point<2>(3, 2));
  CHECK(quads.cell_count() == 6);
  CHECK(quads.vertex_count() == 12);
  CHECK(unique_edges(quads).size() == 3 * 3 + 4 * 2);  // horizontal + vertical
  CHECK(validate(quads).ok());
  const auto hexes = make_grid<3>({2, 3, 4}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  CHECK(hexes.cell_count() == 24);
  CHECK(unique_edges(hexes).size() == 2 * 4 * 5 + 3 * 3 * 5 + 4 * 3 * 4);
  CHECK(validate(hexes).message == "");
}

TEST_CASE("the sides of a grid are patches and its corners are pinned") {
  const auto mesh = make_grid<2>({3, 2}, Point<2>(0, 0), Point<2>(3, 2));
  CHECK(mesh.patch_groups.size() == 4);
  int pinned = 0, sliding = 0;
  for (const auto& s : mesh.support) pinned += s.dim == 0, sliding += s.dim == 1;
  CHECK(pinned == 4);
  CHECK(sliding == 2 * (2 + 1));
  const auto box = make_grid<3>({2, 2, 2}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  CHECK(box.patch_groups.size() == 6);
  int dims[4] = {};
  for (const auto& s : box.support) ++dims[s.dim];
  CHECK(dims[0] == 8);   // corners
  CHECK(dims[1] == 12);  // one inside each edge of the box
  CHECK(dims[2] == 6);
  CHECK(dims[3] == 1);
  CHECK(box.geometry->curve_patches.size() == 12);
}

TEST_CASE("a grid specification is read, and refused with the reason") {
  const auto mesh = parse_grid("grid:10,5:-1,1,0,.5");
  REQUIRE(mesh.ok());
  CHECK(std::get<Mesh<2>>(*mesh).cell_count() == 50);
  CHECK(std::get<Mesh<3>>(*parse_grid("grid:2,2,2:0,1,0,1,0,1")).cell_count() == 8);
  CHECK(parse_grid("grid:10,5").status().message.find("lacks its bounds") != std::string::npos);
  CHECK(parse_grid("grid:10,a:0,1,0,1").status().message.find("'a'") != std::string::npos);
  CHECK(parse_grid("grid:0,5:0,1,0,1").status().code == StatusCode::usage);
  CHECK(parse_grid("grid:2,2:1,0,0,1").status().code == StatusCode::usage);
}

TEST_CASE("a mesh survives the way out to a file's view and back") {
  const auto box = make_grid<3>({2, 1, 1}, Point<3>(0, 0, 0), Point<3>(2, 1, 1));
  const auto again = make_mesh(to_input(box));
  REQUIRE(again.ok());
  CHECK(again->cells == box.cells);
  CHECK(again->patch_groups.size() == 6);
  CHECK(again->support == box.support);
}
