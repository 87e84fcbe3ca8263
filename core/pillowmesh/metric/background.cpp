#include "pillowmesh/metric/background.h"

#include <algorithm>
#include <cmath>

namespace pillowmesh {
namespace {

constexpr int kRoots = 16;  ///< along each side of the box

/// |H^-1 (K - H)|_F
double difference(const SizeTensor& H, const SizeTensor& K) {
  const double det = H.a * H.c - H.b * H.b;
  const double a = K.a - H.a, b = K.b - H.b, c = K.c - H.c;
  const double p = H.c * a - H.b * b, q = H.c * b - H.b * c, r = H.a * b - H.b * a, s = H.a * c - H.b * b;
  return std::sqrt(p * p + q * q + r * r + s * s) / det;
}

/// The interpolant at the four corners in place of the one at nine points: it cannot overshoot, so that H stays positive
/// definite where the metric jumps.
void make_bilinear(std::array<std::array<float, 9>, 3>& coefficients) {
  for (auto& k : coefficients) {
    // Step by step: of one formula for all four corners GCC 12, which computes them at once, makes other numbers now and then.
    std::array<double, 3> left, right;
    for (int j = 0; j < 3; ++j) {
      const double even = k[3 * j], odd = k[3 * j + 1], square = k[3 * j + 2];
      left[j] = (even - odd) + square, right[j] = (even + odd) + square;
    }
    const double a = (left[0] - left[1]) + left[2], b = (right[0] - right[1]) + right[2], c = (left[0] + left[1]) + left[2],
                 d = (right[0] + right[1]) + right[2];
    const std::array<double, 9> bilinear{0.25 * (a + b + c + d), 0.25 * (b + d - a - c), 0, 0.25 * (c + d - a - b), 0.25 * (a + d - b - c), 0, 0, 0, 0};
    std::copy(bilinear.begin(), bilinear.end(), k.begin());
  }
}

double smallest_size(const SizeTensor& H) {
  const double m = 0.5 * (H.a + H.c), d = 0.5 * (H.a - H.c);
  return m - std::sqrt(d * d + H.b * H.b);
}

}  // namespace

SizeTensor size_tensor(const SymTensor<2>& M) {
  // sqrt(M) = (M + s I) / t with s = sqrt(det M), t = sqrt(tr M + 2 s); its inverse by the adjugate, det sqrt(M) = s.
  const double s = std::sqrt(determinant(M)), t = std::sqrt(M.m[0] + M.m[2] + 2.0 * s), i = 1.0 / (s * t);
  return {(M.m[2] + s) * i, -M.m[1] * i, (M.m[0] + s) * i};
}

Background::Background(MetricField<2> field, const Point<2>& low, const Point<2>& high,
                       const BackgroundOptions& options)
    : field_(std::move(field)), options_(options), low_(low), high_(high), cell_((high - low) / kRoots) {
  for (int depth = 0; depth <= kDepth; ++depth) {
    const double twice = 2.0 * static_cast<double>(1 << depth);
    scale_[depth] = {twice / cell_[0], twice / cell_[1]};
  }
  nodes_.resize(kRoots * kRoots);
  leaves_.reserve(4096);
  for (int j = 0; j < kRoots; j += 2)
    for (int i = 0; i < kRoots; i += 2) {
      // Four roots at a time are the children of a square twice as large.
      const Index first = static_cast<Index>(nodes_.size());
      nodes_.resize(nodes_.size() + 4);
      make_children(first, low_[0] + (i + 1) * cell_[0], low_[1] + (j + 1) * cell_[1], 0);
      for (int k = 0; k < 4; ++k) nodes_[(j + (k >> 1)) * kRoots + i + (k & 1)] = nodes_[first + k];
      nodes_.resize(first);
    }
}

Background::Place Background::descend(const Point<2>& p, Index& leaf) {
  const double fx = std::clamp((p[0] - low_[0]) / cell_[0], 0.0, double{kRoots});
  const double fy = std::clamp((p[1] - low_[1]) / cell_[1], 0.0, double{kRoots});
  const int i = std::min(static_cast<int>(fx), kRoots - 1), j = std::min(static_cast<int>(fy), kRoots - 1);
  Index n = j * kRoots + i;
  double u = 2.0 * (fx - i) - 1.0, v = 2.0 * (fy - j) - 1.0;
  std::int64_t column = i, row = j;  // of the square among those of its level: where it is must not depend on p's rounding
  for (int depth = 0;; ++depth) {
    if (nodes_[n].child < 0) {
      if (nodes_[n].rough != 1 || depth == kDepth) break;
      const Point<2>& s = scale_[depth];
      divide(n, low_[0] + static_cast<double>(2 * column + 1) / s[0], low_[1] + static_cast<double>(2 * row + 1) / s[1], depth + 1);
    }
    const int right = u >= 0, up = v >= 0;
    n = nodes_[n].child + 2 * up + right;
    u = 2.0 * u + (right ? -1.0 : 1.0);
    v = 2.0 * v + (up ? -1.0 : 1.0);
    column = 2 * column + right;
    row = 2 * row + up;
  }
  leaf = ~nodes_[n].child;  // one that is never divided
  // Not u and v: they are rounded otherwise, and outside of the box they are not those of p.
  const Point<2> inside(low_[0] + fx * cell_[0], low_[1] + fy * cell_[1]);
  return place(leaves_[leaf], fx > 0 && fx < kRoots && fy > 0 && fy < kRoots ? p : inside);
}

void Background::divide(Index node, double x, double y, int depth) {
  const Index first = static_cast<Index>(nodes_.size());
  nodes_.resize(nodes_.size() + 4);
  make_children(first, x, y, depth);
  // What was a leaf was never handed out: the last child takes its place.
  Node& last = nodes_[first + 3];
  leaves_[~nodes_[node].child] = leaves_.back();
  leaves_.pop_back();
  last.child = nodes_[node].child;
  nodes_[node].child = first;
}

void Background::make_children(Index first, double x, double y, int depth) {
  const double half_x = 2.0 / scale_[depth][0], half_y = 2.0 / scale_[depth][1];
  // 5 x 5 points are the 3 x 3 of each child; 2 x 2 more in each child are where it is compared.
  std::array<Point<2>, 41> points;
  std::array<SymTensor<2>, 41> M;
  std::array<SizeTensor, 41> sizes;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) points[5 * j + i] = {x + (0.5 * i - 1.0) * half_x, y + (0.5 * j - 1.0) * half_y};
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      points[25 + 4 * j + i] = {x + (0.5 * i - 0.75) * half_x, y + (0.5 * j - 0.75) * half_y};
  field_.evaluate(points, M);
  for (int i = 0; i < 41; ++i) sizes[i] = size_tensor(M[i]);
  for (int k = 0; k < 4; ++k) {
    Leaf leaf;
    leaf.x = x + ((k & 1) ? 0.5 : -0.5) * half_x;
    leaf.y = y + ((k >> 1) ? 0.5 : -0.5) * half_y;
    leaf.depth = static_cast<std::uint8_t>(depth);
    for (int e = 0; e < 3; ++e) {
      std::array<double, 9> f;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const SizeTensor& H = sizes[5 * (2 * (k >> 1) + j) + 2 * (k & 1) + i];
          f[3 * j + i] = e == 0 ? H.a : (e == 1 ? H.b : H.c);
        }
      // Along u, then along v: f(-1), f(0), f(1) -> coefficients of 1, u, u^2.
      for (int j = 0; j < 3; ++j) {
        const double l = f[3 * j], m = f[3 * j + 1], r = f[3 * j + 2];
        f[3 * j] = m, f[3 * j + 1] = 0.5 * (r - l), f[3 * j + 2] = 0.5 * (r + l) - m;
      }
      for (int i = 0; i < 3; ++i) {
        const double l = f[i], m = f[3 + i], r = f[6 + i];
        f[i] = m, f[3 + i] = 0.5 * (r - l), f[6 + i] = 0.5 * (r + l) - m;
      }
      std::copy(f.begin(), f.end(), leaf.k[e].begin());
    }
    double worst = 0.0, size = 1e300;
    for (int q = 0; q < 4; ++q) {
      const SizeTensor& H = sizes[25 + 4 * (2 * (k >> 1) + (q >> 1)) + 2 * (k & 1) + (q & 1)];
      const Place at{&leaf, (q & 1) ? 0.5 : -0.5, (q >> 1) ? 0.5 : -0.5};
      const double d = difference(H, evaluate(at));
      worst = d > worst || !(d == d) ? d : worst;
      size = std::min(size, smallest_size(H));
    }
    // The children's side is half_x.
    const bool good = worst <= options_.tolerance;
    std::uint8_t rough = 0;
    if (!good) {
      constexpr std::uint8_t never = 64;
      for (rough = 1; rough < never && !(std::max(half_x, half_y) > options_.smallest * size); ++rough) size *= 0.5;
    }
    if (rough > 1) make_bilinear(leaf.k);
    nodes_[first + k] = {~static_cast<Index>(leaves_.size()), rough};
    leaves_.push_back(leaf);  // doubled where there is no room: what is not used of that takes no memory
  }
}

void Background::halve_sizes(MetricField<2> field) {
  field_ = std::move(field);
  // Rough leaves make four each, others are divided here and there. To copy them now is cheaper than later, when a finer mesh
  // is in memory, too. Where memory is given out by pages what stays unused takes none.
  constexpr std::size_t times = 4;
  leaves_.reserve(times * leaves_.size());
  nodes_.reserve(times * nodes_.size());
  for (Leaf& leaf : leaves_)
    for (auto& k : leaf.k)
      for (float& coefficient : k) coefficient *= 0.5f;
  for (Node& node : nodes_)
    if (node.rough > 1) --node.rough;
  last_ = kNone;
}

SizeTensor Background::evaluate(const Place& at) {
  const double u = at.u, v = at.v;
  std::array<double, 3> out;
  for (int e = 0; e < 3; ++e) {
    const std::array<double, 9> k = at.coefficients(e);
    out[e] = (k[0] + u * (k[1] + u * k[2])) + v * ((k[3] + u * (k[4] + u * k[5])) + v * (k[6] + u * (k[7] + u * k[8])));
  }
  return {out[0], out[1], out[2]};
}

SizeJet Background::evaluate_jet(const Place& at) const {
  const double u = at.u, v = at.v;
  const Point<2>& scale = scale_[at.leaf->depth];
  std::array<double, 3> f, fu, fv;
  for (int e = 0; e < 3; ++e) {
    const std::array<double, 9> k = at.coefficients(e);
    const double r0 = k[0] + u * (k[1] + u * k[2]), r1 = k[3] + u * (k[4] + u * k[5]), r2 = k[6] + u * (k[7] + u * k[8]);
    const double s0 = k[1] + 2.0 * u * k[2], s1 = k[4] + 2.0 * u * k[5], s2 = k[7] + 2.0 * u * k[8];
    f[e] = r0 + v * (r1 + v * r2);
    fu[e] = (s0 + v * (s1 + v * s2)) * scale[0];
    fv[e] = (r1 + 2.0 * v * r2) * scale[1];
  }
  return {{f[0], f[1], f[2]}, {fu[0], fu[1], fu[2]}, {fv[0], fv[1], fv[2]}};
}

}  // namespace pillowmesh
