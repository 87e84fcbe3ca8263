#include "pillowmesh/mesh/circle_fit.h"

#include <algorithm>
#include <cmath>

namespace pillowmesh {
namespace {

constexpr double kTolerance =
    1e-6;                     ///< of the shortest edge: what is left of coordinates that a file gives in 7 digits
constexpr Index kFewest = 5;  ///< there is a circle through any three, and through an isosceles trapezium

class Fitter {
 public:
  Fitter(const std::vector<Point<2>>& points, const Chain& chain) : points_(points), chain_(chain) {}

  bool fit(Index first, Index count, bool around, Circle& circle) const {
    Point<2> mean = Point<2>::Zero();
    for (Index k = 0; k < count; ++k) mean += at(first + k) / count;
    double xx = 0, xy = 0, yy = 0, xr = 0, yr = 0, shortest2 = INFINITY, longest2 = 0;
    for (Index k = 0; k < count; ++k) {
      const Point<2> d = at(first + k) - mean;
      const double r2 = d.squaredNorm();
      xx += d[0] * d[0];
      xy += d[0] * d[1];
      yy += d[1] * d[1];
      xr += d[0] * r2;
      yr += d[1] * r2;
      if (k + 1 == count && !around) break;
      const double edge2 = (at(first + (k + 1) % count) - at(first + k)).squaredNorm();
      shortest2 = std::min(shortest2, edge2);
      longest2 = std::max(longest2, edge2);
    }
    const double det = xx * yy - xy * xy;
    if (!(det > 1e-10 * (xx + yy) * (xx + yy))) return false;  // nearly straight
    const Point<2> c(0.5 * (yy * xr - xy * yr) / det, 0.5 * (xx * yr - xy * xr) / det);
    circle = {mean + c, std::sqrt(c.squaredNorm() + (xx + yy) / count)};
    if (!(longest2 < 3.6 * circle.radius * circle.radius)) return false;  // an arc is less than half of it
    const double most = kTolerance * std::sqrt(shortest2);
    for (Index k = 0; k < count; ++k)
      if (!(std::abs(std::sqrt((at(first + k) - circle.centre).squaredNorm()) - circle.radius) <= most)) return false;
    return true;
  }

  /// The longest run from `first` that fits: twice as many vertices while that fits, then between.
  bool longest(Index first, Index most, CircleRun& run) const {
    if (most < kFewest || !fit(first, kFewest, false, run.circle)) return false;
    Index good = kFewest, bad = most + 1;
    Circle circle;
    while (good + 1 < bad) {
      const Index next = bad > most && 2 * good <= most ? 2 * good : (good + bad) / 2;
      if (fit(first, next, false, circle)) {
        good = next;
        run.circle = circle;
      } else {
        bad = next;
      }
    }
    run.first = first;
    run.count = good;
    return true;
  }

 private:
  [[nodiscard]] const Point<2>& at(Index k) const { return points_[chain_.vertex(k)]; }
  const std::vector<Point<2>>& points_;
  const Chain& chain_;
};

}  // namespace

std::vector<CircleRun> find_circles(const std::vector<Point<2>>& points, const Chain& chain) {
  const Fitter fitter(points, chain);
  const Index n = static_cast<Index>(chain.vertices.size());
  std::vector<CircleRun> runs;
  CircleRun run;
  if (n < kFewest) return runs;
  Index first = 0, last = n - 1;
  if (chain.closed) {
    if (fitter.fit(0, n, true, run.circle)) return {{0, n, run.circle}};
    // Begin where a run ends, so that none is cut in two.
    while (first < n && !fitter.longest(first, n, run)) ++first;
    if (first == n) return runs;
    first += run.count - 1;
    last = first + n;
  }
  while (first + kFewest - 1 <= last) {
    if (fitter.longest(first, last - first + 1, run)) {
      runs.push_back(run);
      first += run.count - 1;
    } else {
      ++first;
    }
  }
  return runs;
}

}  // namespace pillowmesh
