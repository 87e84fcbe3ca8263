// Which edges are too long: most are so clearly shorter or longer that even samples tell.
#include <algorithm>
#include <cmath>
#include <vector>

#include "pillowmesh/metric/even_samples.h"
#include "pillowmesh/metric/length.h"

namespace pillowmesh {

template <int Dim>
void tag_long_edges(const MetricField<Dim>& field, std::span<const Point<Dim>> points,
                    std::span<const std::array<VertexId, 2>> edges, double threshold, double panel,
                    std::span<unsigned char> tagged) {
  constexpr std::size_t kEnough = 2048;  // samples
  const double margin = 1e-7 * threshold;
  const MetricField<Dim> approximated = field.approximated();
  EvenSamples<Dim> samples(approximated);
  std::vector<int> panels;
  std::vector<std::array<VertexId, 2>> doubtful;
  std::vector<std::size_t> places;
  for (std::size_t start = 0; start < edges.size();) {
    samples.clear();
    panels.clear();
    std::size_t end = start;
    for (; end < edges.size() && samples.size() < kEnough; ++end) {
      const Point<Dim>&a = points[edges[end][0]], &b = points[edges[end][1]];
      panels.push_back(panel_count(std::sqrt((b - a).squaredNorm()), panel));
      const int steps = 4 * panels.back();
      samples.add(a, b - a, 0.0, 1.0 / steps, steps + 1);
    }
    const double* f = samples.speeds();
    for (std::size_t i = start; i < end; ++i, ++f) {
      // The differences of the other rules from Boole's: more than its error.
      double sum = 0.0, error = 0.0;
      const int n = panels[i - start];
      for (int k = 0; k < n; ++k, f += 4) {
        const EvenMeans mean(f);
        sum += mean.boole;
        error += 2.0 * std::fabs(mean.boole - mean.simpson) + std::fabs(mean.boole - mean.trapezoids);
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
