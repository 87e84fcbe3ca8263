#include "pillowmesh/metric/line_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "pillowmesh/metric/even_samples.h"
#include "pillowmesh/metric/length.h"

namespace pillowmesh {
namespace {

using Five = std::array<double, 5>;

// Smooth functions are within a thousandth of the trapezoids wherever Simpson's rule is good enough.
double error_of(const EvenMeans& mean) {
  return std::fabs(mean.boole - mean.simpson) + 0.01 * std::fabs(mean.boole - mean.trapezoids);
}

// Lines of a chunk together, breadth first: the order in which the pieces of one line are summed does not depend on the
// others.
template <int Dim>
class LineIntegrator {
 public:
  static constexpr bool kDensity = Dim == 2;

  LineIntegrator(const MetricField<Dim>& field, const LineOptions& options) : samples_(field), options_(options) {
    options_.tolerance = std::max(options.tolerance, field.accuracy());
  }

  /// \return how many lines were integrated: all, or those that make a chunk.
  std::size_t run(std::span<const Line<Dim>> lines, std::span<LineIntegral> integrals) {
    constexpr std::size_t enough = 2048;  // samples
    open_.clear();
    samples_.clear();
    for (; open_.size() < lines.size() && samples_.size() < enough;) add(lines[open_.size()]);
    begin(integrals);
    for (int depth = 1; !pieces_.empty(); ++depth) halve(integrals, depth >= options_.max_depth);
    return open_.size();
  }

 private:
  /// A line from its end with the smaller coordinates, so that integrals do not depend on the direction.
  struct Open {
    Point<Dim> origin, vector;
    const SymTensor<Dim> *at_origin, *at_end;  // null: among the samples
    int panels;
    double allowed_length, allowed_density;  // error of a piece
  };
  /// From t to t + 4 step.
  struct Piece {
    Index line;
    double t, step;
    Five speed, density;
  };

  void add(const Line<Dim>& line) {
    const auto* a = &line.from;
    const auto* b = &line.to;
    auto at_a = line.at_from, at_b = line.at_to;
    if (!std::lexicographical_compare(a->data(), a->data() + Dim, b->data(), b->data() + Dim)) {
      std::swap(a, b);
      std::swap(at_a, at_b);
    }
    const Point<Dim> vector = *b - *a;
    const int panels = line.single_panel ? 1 : panel_count(std::sqrt(vector.squaredNorm()), options_.panel);
    const int known = at_a != nullptr ? 1 : 0;  // at each end
    const double step = 0.25 / panels;
    samples_.add(*a, vector, known * step, step, 4 * panels + 1 - 2 * known);
    open_.push_back({*a, vector, at_a, at_b, panels, 0.0, 0.0});
  }

  /// All samples of a line whose ends are known. The parameters are those between the ends.
  void join(const Open& line, const double* speed_inside, const double* density_inside) {
    const std::size_t inside = 4 * static_cast<std::size_t>(line.panels) - 1;
    const auto fill = [&](std::vector<double>& all, const double* inner, const auto& at) {
      all.resize(inside + 2);
      all.front() = at(*line.at_origin);
      std::copy_n(inner, inside, all.begin() + 1);
      all.back() = at(*line.at_end);
    };
    fill(joined_speeds_, speed_inside, [&](const SymTensor<Dim>& M) {
      return speed<Dim>([&](int k) { return M.m[k]; }, [&](int d) { return line.vector[d]; });
    });
    if constexpr (kDensity)
      fill(joined_densities_, density_inside,
           [](const SymTensor<Dim>& M) { return density(M.m[0], M.m[1], M.m[2]); });
  }

  void begin(std::span<LineIntegral> integrals) {
    const double *next_speed = samples_.speeds(), *next_density = kDensity ? samples_.densities() : nullptr;
    pieces_.clear();
    for (std::size_t i = 0; i < open_.size(); ++i) {
      Open& line = open_[i];
      const int last = 4 * line.panels;
      const double *f = next_speed, *g = next_density;
      const bool known = line.at_origin != nullptr;
      if (known) {
        join(line, f, g);
        f = joined_speeds_.data();
        if constexpr (kDensity) g = joined_densities_.data();
      }
      next_speed += last + (known ? -1 : 1);
      if constexpr (kDensity) next_density += last + (known ? -1 : 1);
      double length = 0.0, density = 0.0;
      for (int k = 0; k < last; k += 4) {
        length += EvenMeans(f + k).boole;
        if constexpr (kDensity) density += EvenMeans(g + k).boole;
      }
      const double share = 1.0 / line.panels;
      line.allowed_length = options_.tolerance * length * share;
      line.allowed_density = options_.density_tolerance * density * share;
      integrals[i] = {};
      if constexpr (kDensity) integrals[i].ends = g[0] + g[last];
      for (int k = 0; k < last; k += 4) {
        if (settle(i, share, f + k, kDensity ? g + k : nullptr, integrals[i])) continue;
        Piece& piece = pieces_.emplace_back();
        piece.line = static_cast<Index>(i), piece.t = k * 0.25 * share, piece.step = 0.25 * share;
        std::copy_n(f + k, 5, piece.speed.begin());
        if constexpr (kDensity) std::copy_n(g + k, 5, piece.density.begin());
      }
    }
  }

  /// Adds five samples of a piece, that is this share of its line, to the integral if they are good enough.
  bool settle(std::size_t i, double share, const double* speed, const double* density, LineIntegral& integral,
              bool last = false) const {
    const Open& line = open_[i];
    const EvenMeans length(speed);
    if (!last && share * error_of(length) > line.allowed_length) return false;
    if constexpr (kDensity) {
      const EvenMeans mean(density);
      if (!last && share * error_of(mean) > line.allowed_density) return false;
      integral.density += share * mean.boole;
    }
    integral.length += share * length.boole;
    return true;
  }

  void halve(std::span<LineIntegral> integrals, bool last) {
    samples_.clear();
    for (const Piece& piece : pieces_) {
      const Open& line = open_[piece.line];
      samples_.add(line.origin, line.vector, piece.t + 0.5 * piece.step, piece.step, 4);
    }
    const double *f = samples_.speeds(), *g = kDensity ? samples_.densities() : nullptr;
    whole_.swap(pieces_);
    pieces_.clear();
    for (const Piece& piece : whole_) {
      for (int half = 0; half < 2; ++half) {
        Piece part{piece.line, piece.t + 2 * half * piece.step, 0.5 * piece.step, {}, {}};
        for (int k = 0; k < 5; ++k) {
          const int old = 2 * half + k / 2;  // of the samples of the whole, or the new one behind it
          part.speed[k] = k % 2 == 0 ? piece.speed[old] : f[old];
          if constexpr (kDensity) part.density[k] = k % 2 == 0 ? piece.density[old] : g[old];
        }
        if (!settle(part.line, 4.0 * part.step, part.speed.data(), part.density.data(), integrals[part.line], last))
          pieces_.push_back(part);
      }
      f += 4;
      if constexpr (kDensity) g += 4;
    }
  }

  EvenSamples<Dim, kDensity> samples_;
  LineOptions options_;
  std::vector<Open> open_;
  std::vector<Piece> pieces_, whole_;
  std::vector<double> joined_speeds_, joined_densities_;
};

}  // namespace

template <int Dim>
void line_integrals(const MetricField<Dim>& field, std::span<const Line<Dim>> lines, std::span<LineIntegral> integrals,
                    const LineOptions& options) {
  LineIntegrator<Dim> integrator(field, options);
  for (std::size_t start = 0; start < lines.size();) start += integrator.run(lines.subspan(start), integrals.subspan(start));
}

template void line_integrals<2>(const MetricField<2>&, std::span<const Line<2>>, std::span<LineIntegral>, const LineOptions&);
template void line_integrals<3>(const MetricField<3>&, std::span<const Line<3>>, std::span<LineIntegral>, const LineOptions&);

}  // namespace pillowmesh
