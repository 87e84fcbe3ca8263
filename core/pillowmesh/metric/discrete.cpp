#include "pillowmesh/metric/discrete.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh {
namespace {

/// Weights nearer to zero than this may belong to the neighbour as well: rounding must not decide between the two.
constexpr double kDoubtful = 1e-10;
/// A walk longer than this costs more than a search from the root.
constexpr int kSteps = 20;

/// cosh(r) and sinh(r) / r with r^2 = square.
struct Hyperbolic {
  double cosine, sine_ratio;
};
Hyperbolic hyperbolic(double square) {
  if (square < 1e-6) return {1.0 + square * (0.5 + square / 24.0), 1.0 + square * (1.0 / 6.0 + square / 120.0)};
  const double r = std::sqrt(square), e = portable::exp(r), i = 1.0 / e;
  return {0.5 * (e + i), 0.5 * (e - i) / r};
}

}  // namespace

template <>
void exp_lanes<2>(int count, TensorLanes<2>& out) {
  // exp(m I + D) = e^m (cosh(r) I + sinh(r) / r D), r^2 = -det D.
  for (int i = 0; i < count; ++i) {
    const double m = 0.5 * (out[0][i] + out[2][i]), d = 0.5 * (out[0][i] - out[2][i]), b = out[1][i];
    const Hyperbolic h = hyperbolic(d * d + b * b);
    const double scale = portable::exp(m), c = scale * h.cosine, s = scale * h.sine_ratio;
    out[0][i] = c + s * d;
    out[1][i] = s * b;
    out[2][i] = c - s * d;
  }
}

template <>
void exp_lanes<3>(int count, TensorLanes<3>& out) {
  // exp(m I + D) = e^m (a I + b D + c D^2): with D^3 = p D + q I (Cayley and Hamilton; D has no trace) every power of D
  // is such a sum, so that scaling and squaring, and Taylor's polynomial by Horner's rule, deal with three numbers.
  // Lane beside lane, so that the loops vectorise.
  constexpr int kDegree = 12;
  Lanes a, b, c, p, q, scale, squarings;
  double most = 0.0;
  for (int i = 0; i < count; ++i) {
    const double m = (out[0][i] + out[2][i] + out[5][i]) / 3.0;
    const double x = out[0][i] - m, y = out[2][i] - m, z = out[5][i] - m, u = out[1][i], v = out[3][i], w = out[4][i];
    p[i] = 0.5 * (x * x + y * y + z * z) + u * u + v * v + w * w;
    q[i] = x * (y * z - w * w) - u * (u * z - w * v) + v * (u * w - y * v);
    scale[i] = 1.0;
    squarings[i] = 0.0;
    for (double square = 2.0 * p[i]; square > 0.25 && squarings[i] < 20.0; square *= 0.25) {
      scale[i] *= 0.5;
      squarings[i] += 1.0;
    }
    most = std::max(most, squarings[i]);
  }
  for (int i = 0; i < count; ++i) {
    p[i] *= scale[i] * scale[i];
    q[i] *= scale[i] * scale[i] * scale[i];
    a[i] = 1.0;
    b[i] = c[i] = 0.0;
  }
  for (int n = kDegree; n >= 1; --n) {  // R <- I + D R / n
    const double share = 1.0 / n;
    for (int i = 0; i < count; ++i) {
      const double next = (a[i] + p[i] * c[i]) * share;
      a[i] = 1.0 + q[i] * c[i] * share;
      c[i] = b[i] * share;
      b[i] = next;
    }
  }
  for (double n = 0.0; n < most; n += 1.0) {  // R <- R^2
    for (int i = 0; i < count; ++i) {
      const double cc = c[i] * c[i], bc = 2.0 * b[i] * c[i];
      const double next_a = a[i] * a[i] + bc * q[i], next_b = 2.0 * a[i] * b[i] + bc * p[i] + cc * q[i],
                   next_c = 2.0 * a[i] * c[i] + b[i] * b[i] + cc * p[i];
      const bool more = n < squarings[i];
      a[i] = more ? next_a : a[i];
      b[i] = more ? next_b : b[i];
      c[i] = more ? next_c : c[i];
    }
  }
  for (int i = 0; i < count; ++i) {
    const double m = (out[0][i] + out[2][i] + out[5][i]) / 3.0, s = portable::exp(m);
    const double x = out[0][i] - m, y = out[2][i] - m, z = out[5][i] - m, u = out[1][i], v = out[3][i], w = out[4][i];
    const double A = s * a[i], B = s * b[i] * scale[i], C = s * c[i] * scale[i] * scale[i];
    out[0][i] = A + B * x + C * (x * x + u * u + v * v);
    out[1][i] = B * u + C * (u * (x + y) + v * w);
    out[2][i] = A + B * y + C * (u * u + y * y + w * w);
    out[3][i] = B * v + C * (v * (x + z) + u * w);
    out[4][i] = B * w + C * (w * (y + z) + u * v);
    out[5][i] = A + B * z + C * (v * v + w * w + z * z);
  }
}

template <int Dim>
Expected<std::shared_ptr<const DiscreteMetric<Dim>>> DiscreteMetric<Dim>::make(std::vector<Point<Dim>> points,
                                                                               std::vector<Simplex<Dim>> simplices,
                                                                               std::vector<SymTensor<Dim>> logs) {
  if (logs.size() != points.size())
    return Status::bad_input("the background has " + std::to_string(points.size()) + " vertices, but " +
                             std::to_string(logs.size()) + " tensors");
  for (const Simplex<Dim>& s : simplices)
    for (const VertexId v : s)
      if (v < 0 || v >= static_cast<VertexId>(points.size()))
        return Status::bad_input("the background names vertex " + std::to_string(v) + " of " +
                                 std::to_string(points.size()));
  std::erase_if(simplices, [&](const Simplex<Dim>& s) {
    double longest = 0.0, scale = 1.0;
    for (int k = 1; k <= Dim; ++k) longest = std::max(longest, (points[s[k]] - points[s[0]]).squaredNorm());
    for (int d = 0; d < Dim; ++d) scale *= longest;
    const double volume = simplex_determinant<Dim>(points, s);
    return !(volume * volume > 1e-28 * scale);
  });
  if (simplices.empty()) return Status::bad_input("the background has no cell with a volume");
  return std::shared_ptr<const DiscreteMetric>(
      new DiscreteMetric(std::move(points), std::move(simplices), std::move(logs)));
}

template <int Dim>
DiscreteMetric<Dim>::DiscreteMetric(std::vector<Point<Dim>> points, std::vector<Simplex<Dim>> simplices,
                                    std::vector<SymTensor<Dim>> logs)
    : points_(std::move(points)), logs_(std::move(logs)), simplices_(std::move(simplices)), tree_(points_, simplices_) {
  put_points_in_order();
  rooms_.resize(simplices_.size());
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    Room& room = rooms_[i];
    room.vertices = simplices_[i];
    room.origin = points_[room.vertices[0]];
    room.neighbours.fill(kNone);
    for (int d = 0; d < Dim; ++d) {
      const Weights<Dim> w = barycentric<Dim>(points_, room.vertices, room.origin + Point<Dim>::Unit(d));
      for (int k = 0; k < Dim; ++k) room.rows[k][d] = w[k + 1];
    }
  }
  find_neighbours();
  fill_bins();
}

template <int Dim>
void DiscreteMetric<Dim>::find_neighbours() {
  struct Facet {
    std::array<VertexId, Dim - 1> others;  ///< ascending, above the first
    Index simplex;
    int opposite;
  };
  // Those with the same lowest vertex side by side, then sorted: points are numbered in the order of the tree, so that this
  // is near in memory.
  const auto corners_of = [&](Index i, int f) {
    std::array<VertexId, Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = rooms_[i].vertices[(f + 1 + k) % (Dim + 1)];
    std::sort(v.begin(), v.end());
    return v;
  };
  std::vector<Index> first(points_.size() + 2, 0);
  const auto count = static_cast<Index>(rooms_.size());
  for (Index i = 0; i < count; ++i)
    for (int f = 0; f <= Dim; ++f) ++first[corners_of(i, f)[0] + 2];
  for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<Facet> facets(rooms_.size() * (Dim + 1));
  for (Index i = 0; i < count; ++i)
    for (int f = 0; f <= Dim; ++f) {
      const auto v = corners_of(i, f);
      Facet& facet = facets[first[v[0] + 1]++];
      std::copy(v.begin() + 1, v.end(), facet.others.begin());
      facet.simplex = i;
      facet.opposite = f;
    }
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    const std::span<Facet> here(facets.data() + first[v], static_cast<std::size_t>(first[v + 1] - first[v]));
    std::sort(here.begin(), here.end(), [](const Facet& a, const Facet& b) {
      return a.others != b.others ? a.others < b.others : a.simplex < b.simplex;
    });
    for (std::size_t k = 0; k + 1 < here.size(); ++k) {
      const Facet &a = here[k], &b = here[k + 1];
      if (a.others != b.others) continue;
      rooms_[a.simplex].neighbours[a.opposite] = b.simplex;
      rooms_[b.simplex].neighbours[b.opposite] = a.simplex;
    }
  }
}

/// In the order in which the simplices, which are in that of the tree, name them: near in memory what is near in space.
template <int Dim>
void DiscreteMetric<Dim>::put_points_in_order() {
  std::vector<VertexId> renumbered(points_.size(), kNone);
  std::vector<Point<Dim>> points;
  std::vector<SymTensor<Dim>> logs;
  points.reserve(points_.size());
  logs.reserve(points_.size());
  for (Simplex<Dim>& s : simplices_) {
    for (VertexId& v : s) {
      if (renumbered[v] == kNone) {
        renumbered[v] = static_cast<VertexId>(points.size());
        points.push_back(points_[v]);
        logs.push_back(logs_[v]);
      }
      v = renumbered[v];
    }
  }
  points_ = std::move(points);
  logs_ = std::move(logs);
}

template <int Dim>
Index DiscreteMetric<Dim>::bin_of(const Point<Dim>& p) const {
  Index bin = 0;
  for (int d = Dim - 1; d >= 0; --d) {
    const double t = (p[d] - bins_.low[d]) * bins_.per_length[d];
    const Index last = bins_.count[d] - 1;
    bin = bin * bins_.count[d] + (t > 0.0 ? (t < last ? static_cast<Index>(t) : last) : 0);
  }
  return bin;
}

template <int Dim>
void DiscreteMetric<Dim>::fill_bins() {
  bins_.low = bins_.high = points_[0];
  for (const Point<Dim>& p : points_) {
    for (int d = 0; d < Dim; ++d) {
      bins_.low[d] = std::min(bins_.low[d], p[d]);
      bins_.high[d] = std::max(bins_.high[d], p[d]);
    }
  }
  // Cubes, were it not for sides so short that they have one bin.
  double volume = 1.0, total = 1.0;
  for (int d = 0; d < Dim; ++d) volume *= bins_.high[d] - bins_.low[d];
  const double each = volume / static_cast<double>(points_.size());
  const double width = Dim == 2 ? std::sqrt(each) : portable::pow(each, 1.0 / 3.0);
  for (int d = 0; d < Dim; ++d) {
    const double side = bins_.high[d] - bins_.low[d];
    bins_.count[d] = static_cast<Index>(std::clamp(side / width, 1.0, 2e3));
    bins_.per_length[d] = bins_.count[d] / side;
    total *= bins_.count[d];
  }
  bins_.width2 = width * width;
  bins_.start.assign(static_cast<std::size_t>(total), kNone);
  for (Index i = 0; i < static_cast<Index>(simplices_.size()); ++i) {
    Point<Dim> centre = Point<Dim>::Zero();
    for (const VertexId v : simplices_[i]) centre += points_[v] / (Dim + 1);
    Index& start = bins_.start[bin_of(centre)];
    if (start == kNone) start = i;
  }
  // Empty ones take that of the bin before, those at the beginning that of the first.
  Index last = *std::find_if(bins_.start.begin(), bins_.start.end(), [](Index i) { return i != kNone; });
  for (Index& start : bins_.start) {
    if (start == kNone)
      start = last;
    else
      last = start;
  }
}

template <int Dim>
Weights<Dim> DiscreteMetric<Dim>::weights_in(const Room& room, const Point<Dim>& p) const {
  Weights<Dim> w;
  w[0] = 1.0;
  for (int k = 0; k < Dim; ++k) {
    double sum = 0.0;
    for (int d = 0; d < Dim; ++d) sum += room.rows[k][d] * (p[d] - room.origin[d]);
    w[k + 1] = sum;
    w[0] -= sum;
  }
  return w;
}

/// p lies on the facet of a simplex, to rounding, and away from its rim. What the tree would find, without it: the first
/// of the two simplices that p is in, or at the boundary the nearest place. kNone: the tree is to be asked.
template <int Dim>
SimplexPlace<Dim> DiscreteMetric<Dim>::at_facet(const Point<Dim>& p, Index simplex, int opposite) const {
  const Index other = rooms_[simplex].neighbours[opposite];
  for (const Index i : {std::min(simplex, other), std::max(simplex, other)}) {
    if (i == kNone) continue;
    const Simplex<Dim>& s = simplices_[i];
    const Weights<Dim> w = barycentric<Dim>(points_, s, p);
    bool in_box = true;
    for (int d = 0; d < Dim; ++d) {
      double low = points_[s[0]][d], high = low;
      for (int k = 1; k <= Dim; ++k) {
        low = std::min(low, points_[s[k]][d]);
        high = std::max(high, points_[s[k]][d]);
      }
      in_box = in_box && low <= p[d] && p[d] <= high;
    }
    if (*std::min_element(w.begin(), w.end()) >= 0.0) return {in_box ? i : kNone, w};
    constexpr double kRounding = 1e-14;
    if (other != kNone || w[opposite] < -kRounding) continue;
    SimplexPlace<Dim> place{i, {}};
    nearest_in_simplex<Dim>(points_, s, w, p, place.weights);
    return place;
  }
  return {};
}

template <int Dim>
SimplexPlace<Dim> DiscreteMetric<Dim>::locate(const Point<Dim>& p, Index hint) const {
  for (int step = 0; hint != kNone && step < kSteps; ++step) {
    const Room& room = rooms_[hint];
    const Weights<Dim> w = weights_in(room, p);
    int least = 0, doubtful = 0;
    for (int k = 0; k <= Dim; ++k) {
      if (w[k] < w[least]) least = k;
      doubtful += std::fabs(w[k]) <= kDoubtful;
    }
    if (w[least] > kDoubtful) return {hint, w};
    if (w[least] > -kDoubtful) {
      if (doubtful > 1) break;
      const SimplexPlace<Dim> found = at_facet(p, hint, least);
      if (found.simplex == kNone) break;
      const Weights<Dim> inside = weights_in(rooms_[found.simplex], p);
      return *std::min_element(inside.begin(), inside.end()) > kDoubtful ? SimplexPlace<Dim>{found.simplex, inside}
                                                                         : found;
    }
    hint = room.neighbours[least];
  }
  const SimplexPlace<Dim> found = tree_.nearest(points_, simplices_, p);
  // The same bits as at the end of a walk: the value must not depend on the points asked before.
  const Weights<Dim> w = weights_in(rooms_[found.simplex], p);
  return *std::min_element(w.begin(), w.end()) > kDoubtful ? SimplexPlace<Dim>{found.simplex, w} : found;
}

template <int Dim>
void DiscreteMetric<Dim>::evaluate(const PointLanes<Dim>& points, int count, TensorLanes<Dim>& out) const {
  constexpr int kSize = SymTensor<Dim>::size;
  Index hint = kNone;
  Point<Dim> last = Point<Dim>::Zero();
  for (int i = 0; i < count; ++i) {
    Point<Dim> p;
    double gap2 = 0.0;
    for (int d = 0; d < Dim; ++d) {
      p[d] = points[d][i];
      gap2 += (p[d] - last[d]) * (p[d] - last[d]);
    }
    const bool near = hint != kNone && gap2 < bins_.width2;
    const SimplexPlace<Dim> at = locate(p, near ? hint : bins_.start[bin_of(p)]);
    hint = at.simplex;
    last = p;
    const Simplex<Dim>& v = rooms_[at.simplex].vertices;
    double log[kSize] = {};
    for (int k = 0; k <= Dim; ++k)
      for (int e = 0; e < kSize; ++e) log[e] += at.weights[k] * logs_[v[k]].m[e];
    for (int e = 0; e < kSize; ++e) out[e][i] = log[e];
  }
  exp_lanes<Dim>(count, out);
}

template class DiscreteMetric<2>;
template class DiscreteMetric<3>;

}  // namespace pillowmesh
