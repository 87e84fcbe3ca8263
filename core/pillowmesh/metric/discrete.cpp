#include "pillowmesh/metric/discrete.h"

#include <algorithm>
#include <cmath>
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
  // Scaling and squaring: exp(m I + D) = e^m (exp(2^-k D))^(2^k), with Taylor's polynomial of degree 9 by Horner's
  // rule.
  for (int i = 0; i < count; ++i) {
    const double m = (out[0][i] + out[2][i] + out[5][i]) / 3.0;
    double D[6] = {out[0][i] - m, out[1][i], out[2][i] - m, out[3][i], out[4][i], out[5][i] - m};
    double norm = D[0] * D[0] + D[2] * D[2] + D[5] * D[5] + 2.0 * (D[1] * D[1] + D[3] * D[3] + D[4] * D[4]);
    int squarings = 0;
    double scale = 1.0;
    for (; norm > 0.0625 && squarings < 20; norm *= 0.25, ++squarings) scale *= 0.5;
    for (double& d : D) d *= scale;
    const auto multiply = [](const double* A, const double* B, double* C) {  // of tensors that commute
      const double c[6] = {A[0] * B[0] + A[1] * B[1] + A[3] * B[3], A[0] * B[1] + A[1] * B[2] + A[3] * B[4],
                           A[1] * B[1] + A[2] * B[2] + A[4] * B[4], A[0] * B[3] + A[1] * B[4] + A[3] * B[5],
                           A[1] * B[3] + A[2] * B[4] + A[4] * B[5], A[3] * B[3] + A[4] * B[4] + A[5] * B[5]};
      std::copy(c, c + 6, C);
    };
    // E = exp(D) - I, so that nothing is lost where D is small.
    double E[6];
    for (int k = 0; k < 6; ++k) E[k] = D[k] / 9.0;
    for (int n = 8; n >= 1; --n) {  // E <- D (I + E) / n
      E[0] += 1.0, E[2] += 1.0, E[5] += 1.0;
      multiply(D, E, E);
      if (n > 1)
        for (double& e : E) e /= n;
    }
    for (int k = 0; k < squarings; ++k) {  // I + E <- (I + E)^2
      double S[6];
      multiply(E, E, S);
      for (int j = 0; j < 6; ++j) E[j] = 2.0 * E[j] + S[j];
    }
    const double s = portable::exp(m);
    for (int k = 0; k < 6; ++k) out[k][i] = s * (E[k] + (k == 0 || k == 2 || k == 5 ? 1.0 : 0.0));
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
}

template <int Dim>
void DiscreteMetric<Dim>::find_neighbours() {
  struct Facet {
    std::array<VertexId, Dim> vertices;
    Index simplex;
    int opposite;
  };
  std::vector<Facet> facets;
  facets.reserve(rooms_.size() * (Dim + 1));
  for (Index i = 0; i < static_cast<Index>(rooms_.size()); ++i) {
    for (int f = 0; f <= Dim; ++f) {
      Facet facet{{}, i, f};
      for (int k = 0; k < Dim; ++k) facet.vertices[k] = rooms_[i].vertices[(f + 1 + k) % (Dim + 1)];
      std::sort(facet.vertices.begin(), facet.vertices.end());
      facets.push_back(facet);
    }
  }
  std::sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.simplex < b.simplex;
  });
  for (std::size_t k = 0; k + 1 < facets.size(); ++k) {
    const Facet &a = facets[k], &b = facets[k + 1];
    if (a.vertices != b.vertices) continue;
    rooms_[a.simplex].neighbours[a.opposite] = b.simplex;
    rooms_[b.simplex].neighbours[b.opposite] = a.simplex;
  }
}

template <int Dim>
SimplexPlace<Dim> DiscreteMetric<Dim>::locate(const Point<Dim>& p, Index hint) const {
  const auto weights_in = [&](const Room& room) {
    Weights<Dim> w;
    w[0] = 1.0;
    for (int k = 0; k < Dim; ++k) {
      double sum = 0.0;
      for (int d = 0; d < Dim; ++d) sum += room.rows[k][d] * (p[d] - room.origin[d]);
      w[k + 1] = sum;
      w[0] -= sum;
    }
    return w;
  };
  for (int step = 0; hint != kNone && step < kSteps; ++step) {
    const Room& room = rooms_[hint];
    const Weights<Dim> w = weights_in(room);
    int least = 0;
    for (int k = 1; k <= Dim; ++k)
      if (w[k] < w[least]) least = k;
    if (w[least] > kDoubtful) return {hint, w};
    if (w[least] > -kDoubtful) break;
    hint = room.neighbours[least];
  }
  const SimplexPlace<Dim> found = tree_.nearest(points_, simplices_, p);
  // The same bits as at the end of a walk: the value must not depend on the points asked before.
  const Weights<Dim> w = weights_in(rooms_[found.simplex]);
  return *std::min_element(w.begin(), w.end()) > kDoubtful ? SimplexPlace<Dim>{found.simplex, w} : found;
}

template <int Dim>
void DiscreteMetric<Dim>::evaluate(const PointLanes<Dim>& points, int count, TensorLanes<Dim>& out) const {
  constexpr int kSize = SymTensor<Dim>::size;
  Index hint = kNone;
  for (int i = 0; i < count; ++i) {
    Point<Dim> p;
    for (int d = 0; d < Dim; ++d) p[d] = points[d][i];
    const SimplexPlace<Dim> at = locate(p, hint);
    hint = at.simplex;
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
