#include "pillowmesh/quality/valence.h"

#include <numeric>

#include "../catch.h"
#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/primitives.h"

namespace valence_test {

using namespace pillowmesh;

namespace {

int count(const std::vector<unsigned char>& marks) { return std::accumulate(marks.begin(), marks.end(), 0); }

// Three quads around a vertex in the middle of a hexagon:
//
//        4---3
//       / \   \        vertex 6 in the middle has valence 3
//      5   6---2
//       \ /   /
//        0---1
MeshInput<2> three_quads() {
  MeshInput<2> input;
  const double s = 0.8660254037844386;
  input.points = {{-0.5, -s}, {0.5, -s}, {1, 0}, {0.5, s}, {-0.5, s}, {-1, 0}, {0, 0}};
  input.cells = {{0, 1, 6, 2}, {6, 2, 4, 3}, {0, 6, 5, 4}};
  return input;
}

}  // namespace

TEST_CASE("a grid has no irregular vertices, its boundary does not count") {
  CHECK(count(irregular_vertices(make_grid<2>({4, 3}, Point<2>(0, 0), Point<2>(1, 1)))) == 0);
  CHECK(count(irregular_vertices(make_grid<3>({3, 3, 3}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)))) == 0);
}

TEST_CASE("three quads around an inner vertex make it irregular") {
  const Expected<Mesh<2>> mesh = make_mesh<2>(three_quads());
  INFO(mesh.status().message);
  REQUIRE(mesh);
  CHECK(count(irregular_vertices(*mesh)) == 1);
}

TEST_CASE("in 3D an irregular edge marks its inner ends") {
  // The three quads, extruded to three layers of hexes: the middle line has inner vertices at heights 1 and 2.
  const MeshInput<2> flat = three_quads();
  MeshInput<3> input;
  const auto n = static_cast<VertexId>(flat.points.size());
  for (int k = 0; k < 4; ++k) {
    for (const Point<2>& p : flat.points) input.points.emplace_back(p[0], p[1], k);
  }
  for (int k = 0; k < 3; ++k) {
    for (const Corners<2>& q : flat.cells) {
      Corners<3> hex;
      for (int i = 0; i < 4; ++i) {
        hex[i] = q[i] + k * n;
        hex[i + 4] = q[i] + (k + 1) * n;
      }
      input.cells.push_back(hex);
    }
  }
  const Expected<Mesh<3>> mesh = make_mesh<3>(input);
  INFO(mesh.status().message);
  REQUIRE(mesh);
  CHECK(count(irregular_vertices(*mesh)) == 2);
}

}  // namespace valence_test
