// Samples of a metric at even steps along many straight lines, all lanes in use, and the rules that integrate them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "pillowmesh/metric/field.h"

namespace pillowmesh {

// Rounding may leave tiny negative squares and determinants; what is not a number stays so.

/// sqrt(det M) of its entries.
inline double density(double m11, double m12, double m22) {
  const double det = m11 * m22 - m12 * m12;
  return std::sqrt(det < 0.0 ? 0.0 : det);
}
/// In lane i.
inline double density(const TensorLanes<2>& m, int i) { return density(m[0][i], m[1][i], m[2][i]); }

/// |v| in the metric. \param m, v entries of M as they are packed, and of v, by their number
template <int Dim, class Entries, class Coordinates>
inline double speed(const Entries& m, const Coordinates& v) {
  double square = m(0) * v(0) * v(0) + 2.0 * m(1) * v(0) * v(1) + m(2) * v(1) * v(1);
  if constexpr (Dim == 3) square += 2.0 * v(2) * (m(3) * v(0) + m(4) * v(1)) + m(5) * v(2) * v(2);
  return std::sqrt(square < 0.0 ? 0.0 : square);
}

/// |dP/dt| in the metric, and sqrt(det M) if asked for, at even steps of t along lines.
template <int Dim, bool WithDensity = false>
class EvenSamples {
 public:
  explicit EvenSamples(const MetricField<Dim>& field) : field_(field) {}

  void clear() { speeds_.clear(), densities_.clear(); }
  [[nodiscard]] std::size_t size() const { return speeds_.size() + used_; }

  /// At t = first, first + step, ...; t = 0 is `from`, 1 is from + vector.
  void add(const Point<Dim>& from, const Point<Dim>& vector, double first, double step, int samples) {
    for (int k = 0; k < samples;) {
      const int count = std::min(samples - k, kLanes - used_);
      for (int d = 0; d < Dim; ++d) {
        double *points = points_[d].data() + used_, *vectors = vector_[d].data() + used_;
        const double o = from[d], v = vector[d];
        for (int i = 0; i < count; ++i) {
          points[i] = o + (first + (k + i) * step) * v;
          vectors[i] = v;
        }
      }
      k += count;
      used_ += count;
      if (used_ == kLanes) evaluate();
    }
  }

  /// All since clear(), line after line. Evaluates what is waiting.
  const double* speeds() {
    if (used_ > 0) evaluate();
    return speeds_.data();
  }
  const double* densities() {
    if (used_ > 0) evaluate();
    return densities_.data();
  }

 private:
  void evaluate() {
    field_.evaluate(points_, used_, tensors_);
    Lanes values;
    for (int i = 0; i < kLanes; ++i)
      values[i] = speed<Dim>([&](int k) { return tensors_[k][i]; }, [&](int d) { return vector_[d][i]; });
    speeds_.insert(speeds_.end(), values.begin(), values.begin() + used_);
    if constexpr (WithDensity) {
      static_assert(Dim == 2);
      for (int i = 0; i < kLanes; ++i) values[i] = density(tensors_, i);
      densities_.insert(densities_.end(), values.begin(), values.begin() + used_);
    }
    used_ = 0;
  }

  const MetricField<Dim>& field_;
  PointLanes<Dim> points_{}, vector_{};
  TensorLanes<Dim> tensors_{};
  std::vector<double> speeds_, densities_;
  int used_ = 0;
};

/// Means over an interval by its five even samples: Boole's rule, exact to degree 5, and rules of less degree, Simpson's and
/// the trapezoids, which tell how far it may be off. At a kink either of them can agree with it by chance, hardly both.
struct EvenMeans {
  double boole, simpson, trapezoids;

  explicit EvenMeans(const double* f)
      : boole((7.0 * (f[0] + f[4]) + 32.0 * (f[1] + f[3]) + 12.0 * f[2]) / 90.0),
        simpson((f[0] + f[4] + 4.0 * (f[1] + f[3]) + 2.0 * f[2]) / 12.0),
        trapezoids((0.5 * (f[0] + f[4]) + f[1] + f[2] + f[3]) / 4.0) {}
};

}  // namespace pillowmesh
