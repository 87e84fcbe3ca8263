#include "pillowmesh/metric/quad_area.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pillowmesh/metric/even_samples.h"

namespace pillowmesh {
namespace {

// Two orbits of three points, whose barycentric coordinates are kNear, kNear, 1 - 2 kNear, and so on, and the centroid.
// [J. Radon, Zur mechanischen Kubatur, Monatsh. Math. 52 (1948)]
constexpr double kNear = 0.1012865073234563388009874, kFar = 0.4701420641051150897704412;
constexpr double kWeight = 0.225, kWeightNear = 0.1259391805448271525956839, kWeightFar = 0.1323941527885061807376495;
// Of the centroid and the near orbit alone: exact to degree 2 where the mean of a squared coordinate is 1/6.
constexpr double kCheckNear = (1.0 / 6) / (3 * (2 * kNear * kNear + (1 - 2 * kNear) * (1 - 2 * kNear)) - 1);
constexpr int kPoints = 7;

struct Triangle {
  Index owner;
  std::array<Point<2>, 3> p;
};

double cross(const Point<2>& a, const Point<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

// The quarters of a chunk of quadrilaterals, breadth first: the order in which those of one are summed does not depend on
// the others.
class AreaIntegrator {
 public:
  static constexpr std::size_t kChunk = 64;  // quadrilaterals

  AreaIntegrator(const MetricField<2>& field, const VolumeOptions& options) : field_(field), options_(options) {}

  void run(std::span<const CornerPoints<2>> quads, std::span<CornerAreas> areas) {
    std::array<bool, kChunk> convex;
    triangles_.clear();
    for (std::size_t i = 0; i < quads.size(); ++i) convex[i] = add(static_cast<Index>(i), quads[i]);
    integrate();
    for (std::size_t i = 0; i < quads.size(); ++i)
      for (int k = 0; k < 4; ++k) {
        const double* part = &area_[4 * i];
        areas[i][kAround[k]] = convex[i] ? part[k] + part[(k + 3) & 3] : part[k];
      }
  }

 private:
  static constexpr std::array<int, 4> kAround{0, 1, 3, 2};  // corners counterclockwise
  static constexpr int kBatch = kLanes / kPoints;
  static constexpr int kMaxDepth = 20, kMostPanels = 8;  // halvings

  /// Part k lies between the corners k and k + 1, counterclockwise; that of what is not convex is the corner triangle k.
  bool add(Index quad, const CornerPoints<2>& corners) {
    std::array<Point<2>, 4> p;
    for (int k = 0; k < 4; ++k) p[k] = corners[kAround[k]];
    const Point<2> d = p[2] - p[0], e = p[3] - p[1];
    const double all = cross(d, e), u = cross(p[1] - p[0], e) / all, v = cross(p[1] - p[0], d) / all;
    const bool convex = u > 0 && u < 1 && v > 0 && v < 1;
    const Point<2> middle = p[0] + u * d;
    for (int k = 0; k < 4; ++k)
      add_panels({4 * quad + k, {p[k], p[(k + 1) & 3], convex ? middle : p[(k + 3) & 3]}}, kMostPanels);
    return convex;
  }

  void add_panels(const Triangle& t, int more) {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, (t.p[(k + 1) % 3] - t.p[k]).squaredNorm());
    if (more == 0 || !(options_.panel > 0.0) || !(longest > options_.panel * options_.panel)) return triangles_.push_back(t);
    for (const Triangle& half : halves(t)) add_panels(half, more - 1);
  }

  static std::array<Triangle, 2> halves(const Triangle& t) {
    int first = 0;  // of the longest edge
    for (int k = 1; k < 3; ++k)
      if ((t.p[(k + 1) % 3] - t.p[k]).squaredNorm() > (t.p[(first + 1) % 3] - t.p[first]).squaredNorm()) first = k;
    const Point<2>&a = t.p[first], &b = t.p[(first + 1) % 3], &c = t.p[(first + 2) % 3], middle = 0.5 * (a + b);
    return {{{t.owner, {c, a, middle}}, {t.owner, {b, c, middle}}}};
  }

  void integrate() {
    area_.fill(0.0);
    std::array<double, 4 * kChunk> reference{};
    for (int depth = 0; !triangles_.empty(); ++depth) {
      estimate();
      if (depth == 0)
        for (std::size_t i = 0; i < triangles_.size(); ++i) reference[triangles_[i].owner] += std::fabs(fine_[i]);
      next_.clear();
      for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const Triangle& t = triangles_[i];
        // As in volume.cpp: between a share per triangle and a share per area.
        const double allowed = 3.0 * options_.tolerance * std::sqrt(std::fabs(fine_[i]) * reference[t.owner]);
        if (depth < kMaxDepth && difference_[i] > allowed) {
          for (const Triangle& half : halves(t)) next_.push_back(half);
        } else {
          area_[t.owner] += fine_[i];
        }
      }
      triangles_.swap(next_);
    }
  }

  // Both rules on every triangle. One beside the other, so that loops vectorise.
  void estimate() {
    fine_.resize(triangles_.size());
    difference_.resize(triangles_.size());
    for (std::size_t start = 0; start < triangles_.size(); start += kBatch) {
      const int n = static_cast<int>(std::min<std::size_t>(kBatch, triangles_.size() - start));
      for (int i = 0; i < n; ++i) {
        const std::array<Point<2>, 3>& p = triangles_[start + i].p;
        for (int d = 0; d < 2; ++d) {
          const double sum = p[0][d] + p[1][d] + p[2][d];
          points_[d][i] = sum / 3;
          for (int k = 0; k < 3; ++k) {
            points_[d][(1 + k) * n + i] = kNear * sum + (1 - 3 * kNear) * p[k][d];
            points_[d][(4 + k) * n + i] = kFar * sum + (1 - 3 * kFar) * p[k][d];
          }
        }
      }
      field_.evaluate(points_, kPoints * n, tensors_);
      Lanes densities;
      for (int i = 0; i < kPoints * n; ++i) densities[i] = density(tensors_, i);
      for (int i = 0; i < n; ++i) {
        const double* f = &densities[i];
        const double near = f[n] + f[2 * n] + f[3 * n], far = f[4 * n] + f[5 * n] + f[6 * n];
        const std::array<Point<2>, 3>& p = triangles_[start + i].p;
        const double area = 0.5 * cross(p[1] - p[0], p[2] - p[0]);
        const double fine = kWeight * f[0] + kWeightNear * near + kWeightFar * far;
        fine_[start + i] = area * fine;
        difference_[start + i] = std::fabs(area * (fine - ((1 - 3 * kCheckNear) * f[0] + kCheckNear * near)));
      }
    }
  }

  const MetricField<2>& field_;
  VolumeOptions options_;
  std::vector<Triangle> triangles_, next_;
  std::vector<double> fine_, difference_;
  std::array<double, 4 * kChunk> area_;
  PointLanes<2> points_;
  TensorLanes<2> tensors_;
};

}  // namespace

void quad_areas(const MetricField<2>& field, std::span<const CornerPoints<2>> quads, std::span<CornerAreas> areas,
                const VolumeOptions& options) {
  AreaIntegrator integrator(field, options);
  for (std::size_t start = 0; start < quads.size(); start += AreaIntegrator::kChunk) {
    const std::size_t count = std::min(AreaIntegrator::kChunk, quads.size() - start);
    integrator.run(quads.subspan(start, count), areas.subspan(start, count));
  }
}

namespace {

// Of a triangle, exact to degree 3: shares of the mean over its sides, of its corners, and of the centroid.
// Half and half of sides and centroid is exact to degree 2.
constexpr double kSides = 0.6, kCorners = -0.05, kCentroid = 0.45;

// The triangle at corner k: its neighbours counterclockwise.
constexpr std::array<std::array<int, 2>, 4> kNext{{{1, 2}, {3, 0}, {0, 3}, {2, 1}}};

/// Of each corner triangle: its sides' mean densities, and those of its corners.
struct Rim {
  double sides, corners;
};
std::array<Rim, 4> rims(const QuadLines& l) {
  const auto rim = [](const LineIntegral& a, const LineIntegral& b, const LineIntegral& c) -> Rim {
    return {(a.density + b.density + c.density) / 3, (a.ends + b.ends + c.ends) / 6};
  };
  return {rim(l.s01, l.s02, l.d12), rim(l.s01, l.s13, l.d03), rim(l.s02, l.s23, l.d03), rim(l.s13, l.s23, l.d12)};
}

enum class Found { good, rough, high };  // not good enough; where something may hide from the lines

/// \param centroids densities there
Found areas_by_lines(const CornerPoints<2>& quad, const QuadLines& lines, const double* centroids, CornerAreas& areas,
                    const VolumeOptions& options) {
  const std::array<Rim, 4> rim = rims(lines);
  bool good = true, high = false;
  for (int k = 0; k < 4; ++k) {
    const Point<2> a = quad[kNext[k][0]] - quad[k], b = quad[kNext[k][1]] - quad[k];
    const double twice = cross(a, b);
    const double mean = kSides * rim[k].sides + kCorners * rim[k].corners + kCentroid * centroids[k];
    const double rougher = 0.5 * (rim[k].sides + centroids[k]);
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
    areas[k] = 0.5 * twice * mean;
    good = good && !(std::fabs(mean - rougher) > 3.0 * options.tolerance * mean);
    high = high || (options.panel > 0.0 && twice * twice > options.panel * options.panel * longest);
  }
  return high ? Found::high : (good ? Found::good : Found::rough);
}

}  // namespace

void quad_areas(const MetricField<2>& field, std::span<const CornerPoints<2>> quads, std::span<const QuadLines> lines,
                std::span<CornerAreas> areas, const VolumeOptions& options) {
  constexpr std::size_t batch = kLanes / 4;
  struct Again {
    std::vector<CornerPoints<2>> quads;
    std::vector<std::size_t> places;
  } rough, high;
  PointLanes<2> points{};
  TensorLanes<2> tensors{};
  Lanes densities;
  for (std::size_t start = 0; start < quads.size(); start += batch) {
    const std::size_t count = std::min(batch, quads.size() - start);
    for (std::size_t i = 0; i < count; ++i) {
      const CornerPoints<2>& q = quads[start + i];
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < 2; ++d) points[d][4 * i + k] = (q[k][d] + q[kNext[k][0]][d] + q[kNext[k][1]][d]) / 3;
    }
    field.evaluate(points, static_cast<int>(4 * count), tensors);
    for (int i = 0; i < kLanes; ++i) densities[i] = density(tensors, i);
    for (std::size_t i = 0; i < count; ++i) {
      const Found found = areas_by_lines(quads[start + i], lines[start + i], &densities[4 * i], areas[start + i], options);
      if (found == Found::good) continue;
      Again& again = found == Found::rough ? rough : high;
      again.quads.push_back(quads[start + i]);
      again.places.push_back(start + i);
    }
  }
  const auto integrate = [&](const Again& again, double panel) {
    std::vector<CornerAreas> found(again.quads.size());
    quad_areas(field, again.quads, found, {options.tolerance, panel});
    for (std::size_t i = 0; i < found.size(); ++i) areas[again.places[i]] = found[i];
  };
  integrate(rough, 0.0);
  integrate(high, options.panel);
}

}  // namespace pillowmesh
