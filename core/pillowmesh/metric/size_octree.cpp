#include "pillowmesh/metric/size_octree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

constexpr int kOctreeRoots = 8;  ///< along each side of the box
constexpr int kOctreeDepth = 12;

/// The metric whose sizes are H: (H^2)^-1.
SymTensor<3> metric_of(const SymTensor<3>& H) {
  const double a = H.m[0], b = H.m[1], c = H.m[2], d = H.m[3], e = H.m[4], f = H.m[5];
  const SymTensor<3> square{{a * a + b * b + d * d, a * b + b * c + d * e, b * b + c * c + e * e, a * d + b * e + d * f,
                             b * d + c * e + e * f, d * d + e * e + f * f}};
  const SymTensor<3> adjoint = adjugate(square);
  return (1.0 / (square.m[0] * adjoint.m[0] + square.m[1] * adjoint.m[1] + square.m[3] * adjoint.m[3])) * adjoint;
}

/// |H^-1/2 (K - H) H^-1/2|_F, the root of the trace of (H^-1 K - I)^2.
double difference(const SymTensor<3>& H, const SymTensor<3>& K) {
  const SymTensor<3> inverse = (1.0 / determinant(H)) * adjugate(H);
  double trace = 0.0, P[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      P[i][j] = 0.0;
      for (int k = 0; k < 3; ++k) P[i][j] += inverse(i, k) * (K(k, j) - H(k, j));
    }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) trace += P[i][j] * P[j][i];
  return std::sqrt(std::max(trace, 0.0));
}

SymTensor<3> interpolate(const std::array<std::array<double, 6>, 8>& k, double u, double v, double w) {
  const double uv = u * v, uw = u * w, vw = v * w, uvw = uv * w;
  SymTensor<3> H;
  for (int e = 0; e < 6; ++e)
    H.m[e] = (k[0][e] + u * k[1][e]) + (v * k[2][e] + uv * k[3][e]) +
             ((w * k[4][e] + uw * k[5][e]) + (vw * k[6][e] + uvw * k[7][e]));
  return H;
}

}  // namespace

SymTensor<3> size_tensor(const SymTensor<3>& M) {
  return map_eigenvalues(M, [](double v) { return 1.0 / std::sqrt(v); });
}

SizeOctree::SizeOctree(const MetricField<3>& field, const Point<3>& low, const Point<3>& high,
                       const SizeOctreeOptions& options)
    : low_(low) {
  const Point<3> half = (high - low) / (2 * kOctreeRoots);
  for (int d = 0; d < 3; ++d) per_cell_[d] = 0.5 / half[d];
  nodes_.assign(kOctreeRoots * kOctreeRoots * kOctreeRoots, {kNone});
  std::vector<Open> open, next;
  for (Index n = 0; n < static_cast<Index>(nodes_.size()); ++n) {
    Point<3> middle;
    for (int d = 0, rest = n; d < 3; ++d, rest /= kOctreeRoots)
      middle[d] = low[d] + (2 * (rest % kOctreeRoots) + 1) * half[d];
    open.push_back({n, middle, half});
  }
  std::size_t divisions = 0;
  for (int depth = 0; depth < kOctreeDepth && !open.empty(); ++depth) {
    next.clear();
    for (const Open& o : open)
      if (divisions++ < options.divisions) divide(field, o, options.smallest, options.tolerance, next);
    std::swap(open, next);
  }
}

/// The leaf that p is in, or kNone.
Index SizeOctree::find(const Point<3>& p) const {
  Index n = 0;
  double u[3];
  for (int d = 2; d >= 0; --d) {
    const double f = (p[d] - low_[d]) * per_cell_[d];
    if (!(f >= 0.0 && f <= kOctreeRoots)) return kNone;
    const int i = std::min(static_cast<int>(f), kOctreeRoots - 1);
    n = n * kOctreeRoots + i;
    u[d] = 2.0 * (f - i) - 1.0;
  }
  while (nodes_[n].child >= 0) {
    n = nodes_[n].child;
    for (int d = 0; d < 3; ++d) {
      const int far = u[d] >= 0.0;
      n += far << d;
      u[d] = 2.0 * u[d] + (far ? -1.0 : 1.0);
    }
  }
  return nodes_[n].child == kNone ? kNone : ~nodes_[n].child - 1;
}

int SizeOctree::look_up(const PointLanes<3>& points, int count, TensorLanes<3>& out,
                        std::array<int, kLanes>& missed) const {
  int misses = 0;
  for (int i = 0; i < count; ++i) {
    const Point<3> p(points[0][i], points[1][i], points[2][i]);
    const Index leaf = find(p);
    if (leaf == kNone) {
      missed[misses++] = i;
      continue;
    }
    const Leaf& l = leaves_[leaf];
    const SymTensor<3> M =
        metric_of(interpolate(l.k, (p[0] - l.middle[0]) * l.per_length[0], (p[1] - l.middle[1]) * l.per_length[1],
                              (p[2] - l.middle[2]) * l.per_length[2]));
    for (int e = 0; e < 6; ++e) out[e][i] = M.m[e];
  }
  return misses;
}

void SizeOctree::divide(const MetricField<3>& field, const Open& open, double smallest, double tolerance,
                        std::vector<Open>& next) {
  const Point<3>&middle = open.middle, &half = open.half;
  // 3 x 3 x 3 points are the corners of the children; each is compared in its middle and at four places around it.
  constexpr int kCorners = 27, kProbes = 5;
  constexpr double kPlaces[kProbes][3] = {
      {0, 0, 0}, {0.5, 0.5, 0.5}, {-0.5, -0.5, 0.5}, {-0.5, 0.5, -0.5}, {0.5, -0.5, -0.5}};
  std::array<Point<3>, kCorners + 8 * kProbes> points;
  std::array<SymTensor<3>, kCorners + 8 * kProbes> H;
  for (int i = 0; i < kCorners; ++i)
    for (int d = 0, rest = i; d < 3; ++d, rest /= 3) points[i][d] = middle[d] + (rest % 3 - 1) * half[d];
  const auto side = [](int child, int d) { return (child >> d) & 1 ? 1.0 : -1.0; };
  for (int k = 0; k < 8; ++k)
    for (int q = 0; q < kProbes; ++q)
      for (int d = 0; d < 3; ++d)
        points[kCorners + kProbes * k + q][d] = middle[d] + 0.5 * (side(k, d) + kPlaces[q][d]) * half[d];
  field.evaluate(points, H);
  for (SymTensor<3>& M : H) M = size_tensor(M);

  const auto first = static_cast<Index>(nodes_.size());
  nodes_[open.node].child = first;
  for (int k = 0; k < 8; ++k) {
    nodes_.push_back({kNone});
    Leaf leaf;
    for (int a = 0; a < 8; ++a) {
      int place = 0;
      for (int d = 2; d >= 0; --d) place = 3 * place + ((k >> d) & 1) + ((a >> d) & 1);
      leaf.k[a] = H[place].m;
    }
    // Along one axis after the other: f(-1), f(1) -> coefficients of 1 and u.
    for (int axis = 1; axis < 8; axis *= 2) {
      for (int a = 0; a < 8; ++a) {
        if (a & axis) continue;
        for (int e = 0; e < 6; ++e) {
          const double low = leaf.k[a][e], high = leaf.k[a | axis][e];
          leaf.k[a][e] = 0.5 * (low + high);
          leaf.k[a | axis][e] = 0.5 * (high - low);
        }
      }
    }
    bool good = true;
    double least = std::numeric_limits<double>::infinity();
    for (int q = 0; q < kProbes; ++q) {
      const SymTensor<3>& here = H[kCorners + kProbes * k + q];
      good = good && difference(here, interpolate(leaf.k, kPlaces[q][0], kPlaces[q][1], kPlaces[q][2])) <= tolerance;
      least = std::min(least, spectrum(here).value[0]);
    }
    for (int d = 0; d < 3; ++d) {
      leaf.middle[d] = middle[d] + 0.5 * side(k, d) * half[d];
      leaf.per_length[d] = 2.0 / half[d];
    }
    if (good) {
      nodes_.back().child = ~(static_cast<Index>(leaves_.size()) + 1);
      leaves_.push_back(leaf);
    } else if (half.maxCoeff() > smallest * least) {  // the child is as wide as `half`
      next.push_back({first + k, leaf.middle, Point<3>(0.5 * half)});
    }
  }
}

}  // namespace pillowmesh
