// A metric looked up instead of computed: a quadtree of quadratic polynomials, made where it is first asked.
//
// What is kept is the size tensor H = M^(-1/2), whose eigenvalues are the sizes: where sizes grow linearly it is linear,
// and a length is |H^-1 e|. Each leaf holds the biquadratic interpolant of H at 3 x 3 points.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "pillowmesh/metric/field.h"

namespace pillowmesh {

/// H = (a b; b c), symmetric positive definite, in the unit of the coordinates.
struct SizeTensor {
  double a, b, c;
};

/// H and its derivatives.
struct SizeJet {
  SizeTensor H, dx, dy;
};

/// H = M^(-1/2).
SizeTensor size_tensor(const SymTensor<2>& M);

struct BackgroundOptions {
  /// A leaf is divided while, between its points, H is further than this from the metric's own, relative to H:
  /// |H^-1 (interpolated - H)| in the Frobenius norm.
  double tolerance = 2e-3;
  /// A leaf smaller than this share of the smallest size in it is not divided any more: kinks and jumps of the metric
  /// are as wide as that.
  double smallest = 0.25;
};

/// Lookups of a metric over a box. The error of a length is about `tolerance`, at kinks about smallest / 8 of the
/// change of the sizes across a unit length. Results depend on the position alone, not on what was asked before.
class Background {
 public:
  /// Points outside the box are moved to its nearest point.
  Background(MetricField<2> field, const Point<2>& low, const Point<2>& high, const BackgroundOptions& options = {});

  /// Cost: about 20 ns; where nobody asked before, 41 evaluations of the metric for each level that is new.
  SizeTensor at(const Point<2>& p) { return evaluate(locate(p, last_)); }
  SizeJet jet(const Point<2>& p) { return evaluate_jet(locate(p, last_)); }
  /// The same, less than that where p is near the point that `hint` (kNone at first) was last used for.
  SizeTensor at(const Point<2>& p, Index& hint) { return evaluate(locate(p, hint)); }
  SizeJet jet(const Point<2>& p, Index& hint) { return evaluate_jet(locate(p, hint)); }

  /// From here on for `field`, which asks for sizes half as large everywhere, as if it had been made for that: nothing is
  /// computed again. Hints from before are void. Cost: the leaves.
  void halve_sizes(MetricField<2> field);
  [[nodiscard]] bool is_for(const Point<2>& low, const Point<2>& high) const { return low == low_ && high == high_; }

  [[nodiscard]] std::size_t leaves() const { return leaves_.size(); }

 private:
  static constexpr int kDepth = 24;
  /// Two lines of the cache.
  struct alignas(64) Leaf {
    double x, y;  ///< its centre
    /// Coefficients of u^i v^j of a, b and c at [3 * j + i], u and v from -1 to 1 in the leaf.
    std::array<std::array<float, 9>, 3> k;
    std::uint8_t depth;
  };
  /// child >= 0: the first of four nodes; else leaf ~child, which may have to be divided.
  struct Node {
    Index child;
    std::uint8_t rough;  ///< 0: good; 1: to be divided; n: to be divided when sizes are halved for the (n - 1)th time
  };
  struct Place {
    const Leaf* leaf;
    double u, v;
    [[nodiscard]] std::array<double, 9> coefficients(int e) const {
      std::array<double, 9> k;
      for (int i = 0; i < 9; ++i) k[i] = leaf->k[e][i];
      return k;
    }
  };

  [[nodiscard]] Place place(const Leaf& leaf, const Point<2>& p) const {
    const Point<2>& scale = scale_[leaf.depth];
    return {&leaf, (p[0] - leaf.x) * scale[0], (p[1] - leaf.y) * scale[1]};
  }
  Place locate(const Point<2>& p, Index& hint) {
    // Who asks for one point often asks for another near it.
    if (hint >= 0) {
      const Place at = place(leaves_[hint], p);
      if (std::abs(at.u) < 1.0 && std::abs(at.v) < 1.0) return at;
    }
    return descend(p, hint);
  }
  Place descend(const Point<2>& p, Index& leaf);
  void divide(Index node, double x, double y, int depth);
  /// Of a square with this centre, whose children are of this depth.
  void make_children(Index first, double x, double y, int depth);
  [[nodiscard]] static SizeTensor evaluate(const Place& at);
  [[nodiscard]] SizeJet evaluate_jet(const Place& at) const;

  MetricField<2> field_;
  BackgroundOptions options_;
  Point<2> low_, high_, cell_;
  std::array<Point<2>, kDepth + 1> scale_;  ///< of leaves by their depth: u = (p[0] - x) scale[0]
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  Index last_ = kNone;
};

}  // namespace pillowmesh
