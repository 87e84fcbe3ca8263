#include "pillowmesh/metric/size_octree.h"

#include <cmath>
#include <random>

#include "../catch.h"
#include "pillowmesh/metric/nodal.h"
#include "pillowmesh/metric/spectrum.h"

namespace size_octree_test {

using namespace pillowmesh;

namespace {

MetricField<3> formula(std::string_view text) { return *MetricField<3>::from_formula(text); }

/// The largest |log| of a ratio of lengths in two metrics.
double difference(const SymTensor<3>& A, const SymTensor<3>& B) {
  // Eigenvalues of A^-1/2 B A^-1/2, by size tensors: S B S.
  const SymTensor<3> S = size_tensor(A);
  SymTensor<3> C;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i <= j; ++i)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) C(i, j) += S(i, k) * B(k, l) * S(l, j);
  const Spectrum<3> s = spectrum(C);
  return 0.5 * std::max(std::fabs(std::log(s.value[0])), std::fabs(std::log(s.value[2])));
}

std::vector<Point<3>> random_points(int count, double low, double high) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(low, high);
  std::vector<Point<3>> points;
  for (int i = 0; i < count; ++i) points.emplace_back(any(random), any(random), any(random));
  return points;
}

/// Pieces at the points, and the largest difference where there is one.
struct Found {
  int there = 0;
  double worst = 0.0;
};
Found look_up(const SizeOctree& octree, const MetricField<3>& field, const std::vector<Point<3>>& points) {
  Found found;
  for (const Point<3>& p : points) {
    PointLanes<3> lanes;
    TensorLanes<3> out;
    std::array<int, kLanes> missed;
    for (int d = 0; d < 3; ++d) lanes[d][0] = p[d];
    if (octree.look_up(lanes, 1, out, missed) > 0) continue;
    ++found.there;
    SymTensor<3> M;
    for (int e = 0; e < 6; ++e) M.m[e] = out[e][0];
    found.worst = std::max(found.worst, difference(field.evaluate(p), M));
  }
  return found;
}

const Point<3> kLow(0, 0, 0), kHigh(1, 1, 1);

}  // namespace

TEST_CASE("sizes that grow linearly need no more pieces than there are at first") {
  const auto field = formula("h1 = 0.01 + 0.3*z + 0.1*x; h2 = 0.2; h3 = 0.05 + 0.1*y");
  const SizeOctree octree(field, kLow, kHigh);
  CHECK(octree.pieces() == 8 * 8 * 8 * 8);
  const Found found = look_up(octree, field, random_points(500, 0.0, 1.0));
  CHECK(found.there == 500);
  CHECK(found.worst < 1e-12);
}

TEST_CASE("where there is a piece it is as near to the metric as is said") {
  for (const char* text : {"h1 = 0.03 + 0.03*y^2; h2 = 0.06; h3 = 0.05 + 0.1*x*z; theta = x; phi = 0.5*z",
                           "h = 0.02 + abs(x + 0.3*y - 0.6)"}) {
    INFO(text);
    const auto field = formula(text);
    const Found found = look_up(SizeOctree(field, kLow, kHigh), field, random_points(1500, 0.0, 1.0));
    CHECK(found.there > 900);
    CHECK(found.worst < 8e-3);
    const Found fine = look_up(SizeOctree(field, kLow, kHigh, {.tolerance = 2e-4, .smallest = 0.2}), field,
                               random_points(1500, 0.0, 1.0));
    CHECK(fine.worst < 8e-4);
  }
}

TEST_CASE("there is no piece across a jump, outside of the box, and where the metric is not a number") {
  const auto jump = formula("h = if(x < 0.53, 0.5, 0.05)");
  const SizeOctree octree(jump, kLow, kHigh);
  std::vector<Point<3>> near;
  for (int i = 0; i < 200; ++i) near.emplace_back(0.505 + 1e-4 * i, 0.4, 0.7);
  const Found found = look_up(octree, jump, near);
  CHECK(found.there == 0);
  CHECK(look_up(octree, jump, {{0.1, 0.2, 0.3}, {1.0, 0.0, 1.0}}).there == 2);
  CHECK(look_up(octree, jump, {{-0.01, 0.5, 0.5}, {0.5, 0.5, 1.01}, {NAN, 0.5, 0.5}}).there == 0);
  const auto broken = formula("h = x - 0.5");
  CHECK(look_up(SizeOctree(broken, kLow, kHigh), broken, {{0.2, 0.5, 0.5}, {0.49, 0.5, 0.5}}).there == 0);
}

TEST_CASE("divisions end at their number, coarse before fine") {
  const auto field = formula("h = 0.001 + 0.01*abs(sin(40*x)*sin(30*y))");
  const SizeOctree octree(field, kLow, kHigh, {.tolerance = 1e-6, .divisions = 600});
  CHECK(octree.pieces() <= 600 * 8);
}

TEST_CASE("a background in space is approximated, a formula and a scaled field read as they are") {
  const auto exact = formula("h1 = 0.05 + 0.1*y^2; h2 = 0.3; h3 = 0.1 + 0.1*x*z; theta = x + y");
  NodalMetric<3> grid = nodal_grid<3>({16, 16, 16}, kLow, kHigh);
  exact.evaluate(grid.points, grid.tensors);
  const auto field = *pillowmesh::look_up(std::move(grid));
  const auto fast = field.approximated().scaled(2.0), slow = field.scaled(2.0);
  const auto points = random_points(700, -0.1, 1.1);
  std::vector<SymTensor<3>> together(points.size());
  fast.evaluate(points, together);
  bool any = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(fast.evaluate(points[i]) == together[i]);
    const SymTensor<3> M = slow.evaluate(points[i]);
    CHECK(difference(M, together[i]) < 8e-3);
    any = any || !(M == together[i]);
  }
  CHECK(any);
  CHECK(fast.accuracy() > slow.accuracy());
  CHECK(exact.approximated().evaluate(points[0]) == exact.evaluate(points[0]));
  CHECK(exact.approximated().accuracy() == 0.0);
}

}  // namespace size_octree_test
