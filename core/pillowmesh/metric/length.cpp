#include "pillowmesh/metric/length.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace pillowmesh {
namespace {

// Lobatto's 4 points, Kronrod's extension to 7, and that to 13: exact to degree 5, 9, 17. Each rule keeps the points of
// the one before. They include the ends, so that no kink hides between the outermost point and the end, where the rules
// would agree on a wrong value. [W. Gander, W. Gautschi, Adaptive Quadrature - Revisited, BIT 40 (2000)]
constexpr double kNode4 = 0.4472135954999579392818347;
constexpr double kNode7 = 0.8164965809277260327324280;
constexpr double kNode13[3] = {0.2363831996621498802822238, 0.6418533423457813057812355, 0.9428824156954797190563518};

// Sampling order: the middle, then pairs -+node.
constexpr double kFirst[7] = {0.0, -1.0, 1.0, -kNode4, kNode4, -kNode7, kNode7};
constexpr double kMore[6] = {-kNode13[0], kNode13[0], -kNode13[1], kNode13[1], -kNode13[2], kNode13[2]};

constexpr double kWeight4[2] = {0.1666666666666666666666667, 0.8333333333333333333333333};
constexpr double kWeight7[4] = {0.4571428571428571428571429, 0.05238095238095238095238095, 0.4251700680272108843537415,
                                0.2938775510204081632653061};
constexpr double kWeight13[7] = {0.2426110719014077337996410, 0.01582719197348018308716999, 0.1997734052268585267920680,
                                 0.1550719873365853962536360, 0.2249264653333395270160177,  0.1888215739601824544200053,
                                 0.09427384021885004553128251};

// An edge as the integrand sees it. The end point with the smaller coordinates comes first, so that the length does not
// depend on the direction.
template <int Dim>
struct Edge {
  Point<Dim> origin;
  Point<Dim> vector;

  Edge() = default;
  Edge(const Point<Dim>& a, const Point<Dim>& b) {
    const bool forward = std::lexicographical_compare(a.data(), a.data() + Dim, b.data(), b.data() + Dim);
    origin = forward ? a : b;
    vector = forward ? Point<Dim>(b - a) : Point<Dim>(a - b);
  }
  [[nodiscard]] double euclidean_length() const {
    double sum = 0.0;
    for (int d = 0; d < Dim; ++d) sum += vector[d] * vector[d];
    return std::sqrt(sum);
  }
};

// A piece of an edge: the parameters middle -+ half.
struct Piece {
  Index edge;
  double middle;
  double half;
};

// A piece with what has been sampled of it.
struct Sampled {
  Piece piece;
  double first[7];
  double value;  // of the 7-point rule
  double error;  // its difference from the 4-point rule
};

double rule4(const double* f) { return kWeight4[0] * (f[1] + f[2]) + kWeight4[1] * (f[3] + f[4]); }
double rule7(const double* f) {
  return kWeight7[0] * f[0] + kWeight7[1] * (f[1] + f[2]) + kWeight7[2] * (f[3] + f[4]) + kWeight7[3] * (f[5] + f[6]);
}
double rule13(const double* f, const double* g) {
  double sum = kWeight13[0] * f[0];
  for (int i = 0; i < 3; ++i) sum += kWeight13[1 + i] * (f[2 * i + 1] + f[2 * i + 2]);
  for (int i = 0; i < 3; ++i) sum += kWeight13[4 + i] * (g[2 * i] + g[2 * i + 1]);
  return sum;
}

// Samples |dP/dt| in the metric at some nodes of several pieces at once.
template <int Dim>
class Sampler {
 public:
  explicit Sampler(const MetricField<Dim>& field) : field_(field) {}

  /// \pre the pieces added since the last evaluation, times the nodes that come, fit in kLanes.
  void add(const Edge<Dim>& edge, const Piece& piece) {
    for (int d = 0; d < Dim; ++d) {
      origin_[d][used_] = edge.origin[d];
      vector_[d][used_] = edge.vector[d];
    }
    middle_[used_] = piece.middle;
    half_[used_++] = piece.half;
  }

  /// At node i of the k-th of n pieces: result[i * n + k]. One piece beside the other, so that the loops vectorise.
  const double* evaluate(const double* nodes, int count) {
    if (used_ == kUsual)
      evaluate(nodes, count, std::integral_constant<int, kUsual>());
    else
      evaluate(nodes, count, used_);
    used_ = 0;
    return speed_.data();
  }

  /// Pieces that are best evaluated together, with 7 nodes.
  static constexpr int kUsual = 8;

 private:
  static constexpr int kMost = 10;  // pieces
  using Each = std::array<double, kMost>;

  template <class Count>
  void evaluate(const double* nodes, int count, Count n) {
    const std::array<Each, Dim> o = origin_, v = vector_;
    const Each middle = middle_, half = half_;
    for (int i = 0; i < count; ++i) {
      Each t;
      for (int k = 0; k < n; ++k) t[k] = middle[k] + half[k] * nodes[i];
      for (int d = 0; d < Dim; ++d) {
        double* points = points_[d].data() + i * n;
        for (int k = 0; k < n; ++k) points[k] = o[d][k] + t[k] * v[d][k];
      }
    }
    field_.evaluate(points_, n * count, tensors_);
    for (int i = 0; i < count; ++i) {
      const auto m = [&](int entry) { return tensors_[entry].data() + i * n; };
      Each square;
      for (int k = 0; k < n; ++k) {
        square[k] = m(0)[k] * v[0][k] * v[0][k] + 2.0 * m(1)[k] * v[0][k] * v[1][k] + m(2)[k] * v[1][k] * v[1][k];
        if constexpr (Dim == 3) {
          square[k] += 2.0 * v[2][k] * (m(3)[k] * v[0][k] + m(4)[k] * v[1][k]) + m(5)[k] * v[2][k] * v[2][k];
        }
      }
      // Rounding may leave a tiny negative number; what is not a number stays so.
      double* speed = speed_.data() + i * n;
      for (int k = 0; k < n; ++k) speed[k] = std::sqrt(square[k] < 0.0 ? 0.0 : square[k]);
    }
  }

  const MetricField<Dim>& field_;
  std::array<Each, Dim> origin_, vector_;
  Each middle_, half_;
  PointLanes<Dim> points_;
  TensorLanes<Dim> tensors_;
  Lanes speed_;
  int used_ = 0;
};

// Integrates a chunk of edges together, breadth first: pieces in order, then those of their halves that are needed. The
// order in which the pieces of one edge are summed is thus independent of the other edges.
template <int Dim>
class Integrator {
 public:
  static constexpr int kChunk = 72;  // edges

  Integrator(const MetricField<Dim>& field, const LengthOptions& options) : sampler_(field), options_(options) {
    options_.tolerance = std::max(options.tolerance, field.accuracy());
  }

  void clear() {
    edges_ = 0;
    pieces_.clear();
  }
  [[nodiscard]] bool full() const { return edges_ == kChunk; }
  [[nodiscard]] int edge_count() const { return edges_; }

  void add(const Edge<Dim>& edge) {
    constexpr double kMostPanels = 4096.0;
    const double wanted = options_.panel > 0.0 ? std::ceil(edge.euclidean_length() / options_.panel) : 1.0;
    const int panels = wanted > 1.0 ? static_cast<int>(std::min(wanted, kMostPanels)) : 1;
    const double half = 0.5 / panels;
    for (int i = 0; i < panels; ++i) pieces_.push_back({edges_, (2 * i + 1) * half, half});
    edge_[edges_++] = edge;
  }

  /// Estimates of the lengths and of their errors by the 7-point rule on every piece.
  void estimate() {
    for (int e = 0; e < edges_; ++e) length_[e] = error_[e] = 0.0;
    for (std::size_t start = 0; start < pieces_.size(); start += kBatch) {
      const std::size_t end = std::min(pieces_.size(), start + kBatch);
      for (std::size_t i = start; i < end; ++i) sampler_.add(edge_[pieces_[i].edge], pieces_[i]);
      const double* f = sampler_.evaluate(kFirst, 7);
      const std::size_t n = end - start;
      double rule[2][kBatch];
      for (std::size_t k = 0; k < n; ++k) {
        const double g[7] = {f[k], f[n + k], f[2 * n + k], f[3 * n + k], f[4 * n + k], f[5 * n + k], f[6 * n + k]};
        rule[0][k] = rule7(g);
        rule[1][k] = rule4(g);
      }
      for (std::size_t k = 0; k < n; ++k) {
        const Piece& piece = pieces_[start + k];
        const double value = piece.half * rule[0][k];
        length_[piece.edge] += value;
        error_[piece.edge] += std::fabs(value - piece.half * rule[1][k]);
      }
    }
  }

  void integrate() {
    sample();
    for (int e = 0; e < edges_; ++e) length_[e] = 0.0;
    for (const Sampled& s : sampled_) length_[s.piece.edge] += s.value;
    for (int e = 0; e < edges_; ++e) {
      allowed_[e] = options_.tolerance * length_[e];
      length_[e] = 0.0;
    }
    for (int depth = 0; !pieces_.empty(); ++depth) {
      if (depth > 0) sample();
      settle(depth >= options_.max_depth);
    }
  }

  [[nodiscard]] double length(int e) const { return length_[e]; }
  /// Of estimate(): twice what the rules disagree by.
  [[nodiscard]] double error(int e) const { return 2.0 * error_[e]; }

 private:
  static constexpr std::size_t kBatch = Sampler<Dim>::kUsual;

  // The 7-point rule on every piece.
  void sample() {
    sampled_.resize(pieces_.size());
    for (std::size_t start = 0; start < pieces_.size(); start += kBatch) {
      const std::size_t end = std::min(pieces_.size(), start + kBatch);
      for (std::size_t i = start; i < end; ++i) sampler_.add(edge_[pieces_[i].edge], pieces_[i]);
      const double* f = sampler_.evaluate(kFirst, 7);
      for (std::size_t i = start; i < end; ++i, ++f) {
        Sampled& s = sampled_[i];
        s.piece = pieces_[i];
        for (std::size_t k = 0; k < 7; ++k) s.first[k] = f[k * (end - start)];
        s.value = s.piece.half * rule7(s.first);
        s.error = std::fabs(s.value - s.piece.half * rule4(s.first));
      }
    }
  }

  // Adds the pieces that have converged; leaves in pieces_ the halves of the others.
  void settle(bool last) {
    std::size_t doubtful = 0;
    for (const Sampled& s : sampled_) {
      if (s.error > allowed_[s.piece.edge]) {
        sampled_[doubtful++] = s;
      } else {
        length_[s.piece.edge] += s.value;
      }
    }
    pieces_.clear();
    for (std::size_t start = 0; start < doubtful; start += kBatch) {
      const std::size_t end = std::min(doubtful, start + kBatch);
      for (std::size_t i = start; i < end; ++i) {
        sampler_.add(edge_[sampled_[i].piece.edge], sampled_[i].piece);
      }
      const double* found = sampler_.evaluate(kMore, 6);
      for (std::size_t i = start; i < end; ++i, ++found) {
        const Sampled& s = sampled_[i];
        double g[6];
        for (std::size_t k = 0; k < 6; ++k) g[k] = found[k * (end - start)];
        const double value = s.piece.half * rule13(s.first, g);
        if (!last && std::fabs(value - s.value) > allowed_[s.piece.edge]) {
          const double half = 0.5 * s.piece.half;
          pieces_.push_back({s.piece.edge, s.piece.middle - half, half});
          pieces_.push_back({s.piece.edge, s.piece.middle + half, half});
        } else {
          length_[s.piece.edge] += value;
        }
      }
    }
  }

  Sampler<Dim> sampler_;
  LengthOptions options_;
  int edges_ = 0;
  std::array<Edge<Dim>, kChunk> edge_;
  std::array<double, kChunk> length_, error_, allowed_;
  std::vector<Piece> pieces_;
  std::vector<Sampled> sampled_;
};

}  // namespace

template <int Dim>
double edge_length(const MetricField<Dim>& field, const Point<Dim>& a, const Point<Dim>& b,
                   const LengthOptions& options) {
  const Edge<Dim> edge(a, b);
  if (!(options.panel > 0.0) || edge.euclidean_length() <= options.panel) {
    // One piece that converges, the usual case, without the machinery: the same sums as Integrator's.
    Sampler<Dim> sampler(field);
    const Piece whole{0, 0.5, 0.5};
    double nodes[13];
    std::copy(kMore, kMore + 6, std::copy(kFirst, kFirst + 7, nodes));
    sampler.add(edge, whole);
    const double* f = sampler.evaluate(nodes, 13);
    const double value7 = whole.half * rule7(f);
    const double allowed = std::max(options.tolerance, field.accuracy()) * value7;
    if (!(std::fabs(value7 - whole.half * rule4(f)) > allowed)) return value7;
    const double value13 = whole.half * rule13(f, f + 7);
    if (!(std::fabs(value13 - value7) > allowed)) return value13;
  }
  Integrator<Dim> integrator(field, options);
  integrator.add(edge);
  integrator.integrate();
  return integrator.length(0);
}

template <int Dim>
void edge_lengths(const MetricField<Dim>& field, std::span<const Point<Dim>> points,
                  std::span<const std::array<VertexId, 2>> edges, std::span<double> lengths,
                  const LengthOptions& options) {
  Integrator<Dim> integrator(field, options);
  for (std::size_t start = 0; start < edges.size();) {
    integrator.clear();
    std::size_t end = start;
    for (; end < edges.size() && !integrator.full(); ++end)
      integrator.add({points[edges[end][0]], points[edges[end][1]]});
    integrator.integrate();
    for (std::size_t i = start; i < end; ++i) lengths[i] = integrator.length(static_cast<int>(i - start));
    start = end;
  }
}

template <int Dim>
void tag_long_edges(const MetricField<Dim>& field, std::span<const Point<Dim>> points,
                    std::span<const std::array<VertexId, 2>> edges, double threshold, double panel,
                    std::span<unsigned char> tagged) {
  const LengthOptions options{.tolerance = 1e-7, .panel = panel};
  const double margin = 1e-7 * threshold;
  const MetricField<Dim> approximated = field.approximated();
  Integrator<Dim> quick(approximated, options);
  Integrator<Dim> exact(approximated, options);
  std::array<std::size_t, Integrator<Dim>::kChunk> doubtful;
  const auto decide_doubtful = [&] {
    exact.integrate();
    for (int k = 0; k < exact.edge_count(); ++k) tagged[doubtful[k]] = exact.length(k) > threshold ? 1 : 0;
    exact.clear();
  };
  for (std::size_t start = 0; start < edges.size();) {
    quick.clear();
    std::size_t end = start;
    for (; end < edges.size() && !quick.full(); ++end) quick.add({points[edges[end][0]], points[edges[end][1]]});
    quick.estimate();
    for (std::size_t i = start; i < end; ++i) {
      const int k = static_cast<int>(i - start);
      if (std::fabs(quick.length(k) - threshold) > quick.error(k) + margin) {
        tagged[i] = quick.length(k) > threshold ? 1 : 0;
        continue;
      }
      doubtful[exact.edge_count()] = i;
      exact.add({points[edges[i][0]], points[edges[i][1]]});
      if (exact.full()) decide_doubtful();
    }
    start = end;
  }
  decide_doubtful();
}

template <int Dim>
double default_panel(std::span<const Point<Dim>> points) {
  if (points.empty()) return 0.0;
  Point<Dim> low = points[0];
  Point<Dim> high = points[0];
  for (const Point<Dim>& p : points) {
    for (int d = 0; d < Dim; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  }
  return Edge<Dim>(low, high).euclidean_length() / 256.0;
}

#define PILLOWMESH_INSTANTIATE(D)                                                                                      \
  template double edge_length<D>(const MetricField<D>&, const Point<D>&, const Point<D>&, const LengthOptions&);       \
  template void edge_lengths<D>(const MetricField<D>&, std::span<const Point<D>>,                                      \
                                std::span<const std::array<VertexId, 2>>, std::span<double>, const LengthOptions&);    \
  template void tag_long_edges<D>(const MetricField<D>&, std::span<const Point<D>>,                                    \
                                  std::span<const std::array<VertexId, 2>>, double, double, std::span<unsigned char>); \
  template double default_panel<D>(std::span<const Point<D>>);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
