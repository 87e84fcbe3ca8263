#include "pillowmesh/metric/simplex_tree.h"

#include <algorithm>
#include <random>

#include "../catch.h"
#include "pillowmesh/metric/nodal.h"

namespace simplex_tree_test {

using namespace pillowmesh;

namespace {

template <int Dim>
Point<Dim> place_of(std::span<const Point<Dim>> points, std::span<const Simplex<Dim>> simplices,
                    const SimplexPlace<Dim>& at) {
  Point<Dim> p = Point<Dim>::Zero();
  for (int k = 0; k <= Dim; ++k) p += at.weights[k] * points[simplices[at.simplex][k]];
  return p;
}

/// A box with its last cell taken out: the domain is not convex.
template <int Dim>
NodalMetric<Dim> notched(int n) {
  std::array<int, Dim> count;
  count.fill(n);
  NodalMetric<Dim> grid = nodal_grid<Dim>(count, Point<Dim>::Zero(), Point<Dim>::Ones());
  std::erase_if(grid.simplices, [&](const Simplex<Dim>& s) {
    Point<Dim> c = Point<Dim>::Zero();
    for (const VertexId v : s) c += grid.points[v] / (Dim + 1);
    return c.minCoeff() > 0.5;
  });
  return grid;
}

template <int Dim>
void check_nearest() {
  NodalMetric<Dim> grid = notched<Dim>(4);
  const SimplexTree<Dim> tree(grid.points, grid.simplices);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-0.5, 1.5);
  for (int i = 0; i < 2000; ++i) {
    Point<Dim> p;
    for (int d = 0; d < Dim; ++d) p[d] = any(random);
    // The nearest point of the unit box without its upper corner [1/2, 1]^Dim.
    Point<Dim> nearest = p.cwiseMax(0.0).cwiseMin(1.0);
    if (nearest.minCoeff() > 0.5) {
      double best = 1e300;
      const Point<Dim> inside = nearest;
      for (int d = 0; d < Dim; ++d) {
        Point<Dim> q = inside;
        q[d] = 0.5;
        if ((q - p).norm() < best) best = (q - p).norm(), nearest = q;
      }
    }
    const auto at = tree.nearest(grid.points, grid.simplices, p);
    REQUIRE(at.simplex >= 0);
    CHECK(*std::min_element(at.weights.begin(), at.weights.end()) >= 0.0);
    const double found = (place_of<Dim>(grid.points, grid.simplices, at) - p).norm();
    CHECK(found == Approx((nearest - p).norm()).margin(1e-12));
  }
}

}  // namespace

TEST_CASE("points inside are found, points outside are moved to the nearest place") {
  check_nearest<2>();
  check_nearest<3>();
}

TEST_CASE("the tree finds places in a mesh whose sizes vary by orders of magnitude") {
  NodalMetric<2> grid = nodal_grid<2>({40, 40}, {0.0, 0.0}, {1.0, 1.0});
  for (Point<2>& p : grid.points) p = Point<2>(std::pow(p[0], 9.0), std::pow(p[1], 9.0));
  const SimplexTree<2> tree(grid.points, grid.simplices);
  for (double x = 1e-12; x < 1.0; x *= 3.0) {
    const Point<2> p(x, 0.5 * x);
    CHECK((place_of<2>(grid.points, grid.simplices, tree.nearest(grid.points, grid.simplices, p)) - p).norm() <=
          1e-12 * x + 1e-16);
  }
}

}  // namespace simplex_tree_test
