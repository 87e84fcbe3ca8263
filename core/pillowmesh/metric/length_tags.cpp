// Which edges are too long: most are so clearly shorter or longer that even samples tell.
#include <algorithm>
#include <cmath>
#include <vector>

#include "pillowmesh/metric/length.h"

namespace pillowmesh {
namespace {

// Samples |dP/dt| in the metric at even steps along many edges, all lanes in use.
template <int Dim>
class EvenSampler {
 public:
  explicit EvenSampler(const MetricField<Dim>& field) : field_(field) {}

  void clear() { speeds_.clear(); }
  [[nodiscard]] std::size_t size() const { return speeds_.size() + used_; }

  /// Samples at t = 0, 1 / steps, ..., 1.
  void add(const Point<Dim>& from, const Point<Dim>& to, int steps) {
    const Point<Dim> vector = to - from;
    const double step = 1.0 / steps;
    for (int k = 0; k <= steps;) {
      const int count = std::min(steps + 1 - k, kLanes - used_);
      for (int d = 0; d < Dim; ++d) {
        double *points = points_[d].data() + used_, *vectors = vector_[d].data() + used_;
        const double o = from[d], v = vector[d];
        for (int i = 0; i < count; ++i) {
          points[i] = o + (k + i) * step * v;
          vectors[i] = v;
        }
      }
      k += count;
      used_ += count;
      if (used_ == kLanes) evaluate();
    }
  }

  /// All speeds since clear(), edge after edge.
  const double* finish() {
    if (used_ > 0) evaluate();
    return speeds_.data();
  }

 private:
  void evaluate() {
    field_.evaluate(points_, used_, tensors_);
    const auto& m = tensors_;
    const auto& v = vector_;
    Lanes speed;
    for (int i = 0; i < kLanes; ++i) {
      double square = m[0][i] * v[0][i] * v[0][i] + 2.0 * m[1][i] * v[0][i] * v[1][i] + m[2][i] * v[1][i] * v[1][i];
      if constexpr (Dim == 3)
        square += 2.0 * v[2][i] * (m[3][i] * v[0][i] + m[4][i] * v[1][i]) + m[5][i] * v[2][i] * v[2][i];
      // Rounding may leave a tiny negative number; what is not a number stays so.
      speed[i] = std::sqrt(square < 0.0 ? 0.0 : square);
    }
    speeds_.insert(speeds_.end(), speed.begin(), speed.begin() + used_);
    used_ = 0;
  }

  const MetricField<Dim>& field_;
  PointLanes<Dim> points_{}, vector_{};
  TensorLanes<Dim> tensors_{};
  std::vector<double> speeds_;
  int used_ = 0;
};

}  // namespace

template <int Dim>
void tag_long_edges(const MetricField<Dim>& field, std::span<const Point<Dim>> points,
                    std::span<const std::array<VertexId, 2>> edges, double threshold, double panel,
                    std::span<unsigned char> tagged) {
  constexpr std::size_t kEnough = 2048;  // samples
  const double margin = 1e-7 * threshold;
  const MetricField<Dim> approximated = field.approximated();
  EvenSampler<Dim> sampler(approximated);
  std::vector<int> panels;
  std::vector<std::array<VertexId, 2>> doubtful;
  std::vector<std::size_t> places;
  for (std::size_t start = 0; start < edges.size();) {
    sampler.clear();
    panels.clear();
    std::size_t end = start;
    for (; end < edges.size() && sampler.size() < kEnough; ++end) {
      const Point<Dim>&a = points[edges[end][0]], &b = points[edges[end][1]];
      panels.push_back(panel_count(std::sqrt((b - a).squaredNorm()), panel));
      sampler.add(a, b, 4 * panels.back());
    }
    const double* f = sampler.finish();
    for (std::size_t i = start; i < end; ++i, ++f) {
      // Boole's rule on each panel, and how far Simpson's and the trapezoids are off: more than the error. At a kink
      // either of them can agree by chance, hardly both.
      double sum = 0.0, error = 0.0;
      const int n = panels[i - start];
      for (int k = 0; k < n; ++k, f += 4) {
        const double boole = (7.0 * (f[0] + f[4]) + 32.0 * (f[1] + f[3]) + 12.0 * f[2]) / 90.0;
        sum += boole;
        error += 2.0 * std::fabs(boole - (f[0] + f[4] + 4.0 * (f[1] + f[3]) + 2.0 * f[2]) / 12.0) +
                 std::fabs(boole - (0.5 * (f[0] + f[4]) + f[1] + f[2] + f[3]) / 4.0);
      }
      const double length = sum / n;
      if (std::fabs(length - threshold) > error / n + margin) {
        tagged[i] = length > threshold ? 1 : 0;
        continue;
      }
      doubtful.push_back(edges[i]);
      places.push_back(i);
    }
    start = end;
  }
  std::vector<double> lengths(doubtful.size());
  edge_lengths<Dim>(approximated, points, doubtful, lengths, {.tolerance = 1e-7, .panel = panel});
  for (std::size_t k = 0; k < places.size(); ++k) tagged[places[k]] = lengths[k] > threshold ? 1 : 0;
}

template void tag_long_edges<2>(const MetricField<2>&, std::span<const Point<2>>,
                                std::span<const std::array<VertexId, 2>>, double, double, std::span<unsigned char>);
template void tag_long_edges<3>(const MetricField<3>&, std::span<const Point<3>>,
                                std::span<const std::array<VertexId, 2>>, double, double, std::span<unsigned char>);

}  // namespace pillowmesh
