#include "pillowmesh/quality/jacobian.h"

#include <cmath>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/quality/valence.h"

namespace jacobian_test {

using namespace pillowmesh;

TEST_CASE("the scaled Jacobian of a rectangle or box is one") {
  CHECK(scaled_jacobian(make_grid<2>({1, 1}, Point<2>(0, 0), Point<2>(10, 1)), 0) == Approx(1.0));
  CHECK(scaled_jacobian(make_grid<3>({1, 1, 1}, Point<3>(0, 0, 0), Point<3>(10, 1, 0.1)), 0) == Approx(1.0));
}

TEST_CASE("in 2D it is the sine of the worst corner") {
  Mesh<2> mesh = make_grid<2>({1, 1}, Point<2>(0, 0), Point<2>(1, 1));
  // A parallelogram of 60 degrees.
  mesh.points[2] = Point<2>(0.5, std::sqrt(0.75));
  mesh.points[3] = Point<2>(1.5, std::sqrt(0.75));
  CHECK(scaled_jacobian(mesh, 0) == Approx(std::sqrt(0.75)));
  mesh.points[3] = Point<2>(0.5, 0.4);
  CHECK(scaled_jacobian(mesh, 0) < 0.0);
}

TEST_CASE("in 3D one bad corner counts") {
  Mesh<3> mesh = make_grid<3>({1, 1, 1}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  mesh.points[7] = Point<3>(1, 1, 0.5);
  // At corner 7 the edges are (-1, 0, 0.5), (0, -1, 0.5), (0, 0, -0.5); at 5 and 6 as well one is tilted.
  CHECK(scaled_jacobian(mesh, 0) == Approx(1.0 / 1.25));
  mesh.points[7] = Point<3>(0.2, 0.2, 0.2);
  CHECK(scaled_jacobian(mesh, 0) < 0.0);
}

TEST_CASE("a collapsed edge gives zero") {
  Mesh<2> mesh = make_grid<2>({1, 1}, Point<2>(0, 0), Point<2>(1, 1));
  mesh.points[1] = mesh.points[0];
  CHECK(scaled_jacobian(mesh, 0) == 0.0);
}

TEST_CASE("the lowest Jacobian on the lattice is that of its 27 points one by one") {
  const auto mesh = corpus::shaken(make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(4, 4, 4)), 1.0, 0.5, 3);
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    const auto position = [&](int k) -> const Point<3>& { return mesh.points[mesh.cells[c][k]]; };
    double lowest = jacobian_at({0, 0, 0}, position);
    for (int i = 0; i < 27; ++i)
      lowest = std::min(lowest, jacobian_at({0.5 * (i % 3), 0.5 * (i / 3 % 3), 0.5 * (i / 9)}, position));
    CHECK(min_lattice_jacobian(position) == Approx(lowest).margin(1e-12));
    CHECK(min_lattice_jacobian(position) <= min_corner_jacobian(mesh, c));
  }
}

}  // namespace jacobian_test
