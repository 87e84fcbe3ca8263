#include "pillowmesh/mesh/circle_fit.h"

#include <cmath>
#include <numeric>

#include "../catch.h"

namespace circle_fit_test {

using namespace pillowmesh;

namespace {

Chain chain_of(std::size_t vertices, bool closed) {
  Chain chain;
  chain.closed = closed;
  chain.vertices.resize(vertices);
  std::iota(chain.vertices.begin(), chain.vertices.end(), 0);
  chain.pieces.resize(closed ? vertices : vertices - 1);
  std::iota(chain.pieces.begin(), chain.pieces.end(), 0);
  chain.reversed.resize(chain.pieces.size(), 0);
  return chain;
}

Point<2> on_circle(const Point<2>& centre, double radius, double angle) {
  return centre + radius * Point<2>(std::cos(angle), std::sin(angle));
}

/// Two half circles of radius 1 about (0, 0) and (6, 0), n arcs each, the sides between them in `side` pieces.
std::vector<Point<2>> slot(int n, int side) {
  std::vector<Point<2>> points;
  for (int i = 0; i <= n; ++i) points.push_back(on_circle({6, 0}, 1, 3.14159265358979 * (i - 0.5 * n) / n));
  for (int i = 1; i < side; ++i) points.push_back(Point<2>(6 - 6.0 * i / side, 1));
  for (int i = 0; i <= n; ++i) points.push_back(on_circle({0, 0}, 1, 3.14159265358979 * (i + 0.5 * n) / n));
  for (int i = 1; i < side; ++i) points.push_back(Point<2>(6.0 * i / side, -1));
  return points;
}

}  // namespace

TEST_CASE("a closed chain on a circle is that circle, whatever the spacing") {
  std::vector<Point<2>> points;
  for (int i = 0; i < 12; ++i) points.push_back(on_circle({1.2, 1}, 0.4, 0.5 * i + 0.1 * std::sin(3.0 * i)));
  const auto runs = find_circles(points, chain_of(points.size(), true));
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].count == 12);
  CHECK((runs[0].circle.centre - Point<2>(1.2, 1)).norm() < 1e-13);
  CHECK(runs[0].circle.radius == Approx(0.4).epsilon(1e-13));
}

TEST_CASE("the arcs of a slot are found wherever its chain begins, and no others") {
  for (const int side : {1, 3}) {
    const auto points = slot(8, side);
    for (std::size_t turn = 0; turn < points.size(); ++turn) {
      auto turned = points;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
      const auto runs = find_circles(turned, chain_of(turned.size(), true));
      INFO("side " << side << " turn " << turn);
      REQUIRE(runs.size() == 2);
      for (const auto& run : runs) {
        CHECK(run.count == 9);
        CHECK(run.circle.radius == Approx(1).epsilon(1e-12));
        CHECK(std::abs(run.circle.centre[1]) < 1e-12);
      }
    }
  }
}

TEST_CASE("what only looks like a circle is none") {
  std::vector<Point<2>> ellipse, few, straight, shaken, half_turns;
  for (int i = 0; i < 40; ++i) ellipse.push_back({std::cos(0.157079632679 * i), 0.9 * std::sin(0.157079632679 * i)});
  CHECK(find_circles(ellipse, chain_of(40, true)).empty());
  for (int i = 0; i < 3; ++i) few.push_back(on_circle({0, 0}, 1, 0.3 * i));
  CHECK(find_circles(few, chain_of(3, false)).empty());
  const std::vector<Point<2>> trapezium{{0, 0}, {1, 0.3}, {5, 0.3}, {6, 0}};  // it has a circle around it, and is none
  CHECK(find_circles(trapezium, chain_of(4, false)).empty());
  for (int i = 0; i < 9; ++i) straight.push_back(Point<2>(0.1 * i, 0.2 * i));
  CHECK(find_circles(straight, chain_of(9, false)).empty());
  for (int i = 0; i < 16; ++i) shaken.push_back(on_circle({0, 0}, i % 2 ? 1 : 1.00001, 0.39269908169872 * i));
  CHECK(find_circles(shaken, chain_of(16, true)).empty());
}

}  // namespace circle_fit_test
