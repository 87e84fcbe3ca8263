#include "pillowmesh/adapt/continuation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pillowmesh/mesh/portable_math.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

template <int Dim>
double mean_edge(const Mesh<Dim>& mesh) {
  double sum = 0.0;
  const auto edges = unique_edges(mesh);
  for (const auto& [a, b] : edges) sum += std::sqrt((mesh.points[b] - mesh.points[a]).squaredNorm());
  return edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

}  // namespace

template <int Dim>
int steps_for(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  constexpr int steps = 7;
  constexpr double steep = 0.5;
  if (Dim == 2) return 0;
  std::vector<SymTensor<Dim>> tensors(mesh.points.size());
  field.evaluate(mesh.points, tensors);
  std::vector<double> size(tensors.size());
  for (std::size_t v = 0; v < size.size(); ++v) size[v] = 1.0 / std::sqrt(spectrum(tensors[v]).value[Dim - 1]);
  for (const auto& [a, b] : unique_edges(mesh))
    if (std::abs(size[b] - size[a]) > steep * std::sqrt((mesh.points[b] - mesh.points[a]).squaredNorm())) return steps;
  return 0;
}

template <int Dim>
double growth_per_length(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  constexpr int least = 4;
  const double panel = default_panel<Dim>(mesh.points);
  std::vector<Point<Dim>> samples;
  std::vector<SymTensor<Dim>> tensors;
  double greatest = 0.0;
  for (const auto& [a, b] : unique_edges(mesh)) {
    const Point<Dim> edge = mesh.points[b] - mesh.points[a];
    const int pieces = std::max(panel_count(std::sqrt(edge.squaredNorm()), panel), least);
    samples.clear();
    for (int i = 0; i <= pieces; ++i) samples.emplace_back(mesh.points[a] + (static_cast<double>(i) / pieces) * edge);
    tensors.resize(samples.size());
    field.evaluate(samples, tensors);
    double last_size = 0.0, last_length = 0.0;
    for (int i = 0; i <= pieces; ++i) {
      const double size = -0.5 * portable::log(spectrum(tensors[i]).value[Dim - 1]);
      const double length = std::sqrt(dot(tensors[i], edge, edge)) / pieces;
      if (i > 0) greatest = std::max(greatest, std::abs(size - last_size) / (0.5 * (length + last_length)));
      last_size = size;
      last_length = length;
    }
  }
  return greatest;
}

template <int Dim>
double threshold_for(const Mesh<Dim>& mesh, const MetricField<Dim>& field, double threshold) {
  constexpr double well_sized = std::numbers::sqrt2, too_fast = 3.0;
  return threshold > well_sized && growth_per_length(mesh, field) > too_fast ? well_sized : threshold;
}

template <int Dim>
Continuation<Dim>::Continuation(const Mesh<Dim>& mesh, const MetricField<Dim>& field, int steps)
    : steps_(steps >= 0 ? steps : steps_for(mesh, field)), steep_(steps_ > 0) {
  if (steps_ > 0) floor_ = mean_edge(mesh);
}

template <int Dim>
void Continuation<Dim>::next() {
  --steps_;
  floor_ = steps_ > 0 ? 0.5 * floor_ : 0.0;
}

template <int Dim>
MetricField<Dim> Continuation<Dim>::approach(const MetricField<Dim>& field) const {
  return floor_ > 0.0 ? field.floored(floor_) : field;
}

template class Continuation<2>;
template class Continuation<3>;
template int steps_for(const Mesh<2>&, const MetricField<2>&);
template int steps_for(const Mesh<3>&, const MetricField<3>&);
template double threshold_for(const Mesh<2>&, const MetricField<2>&, double);
template double threshold_for(const Mesh<3>&, const MetricField<3>&, double);
template double growth_per_length(const Mesh<2>&, const MetricField<2>&);
template double growth_per_length(const Mesh<3>&, const MetricField<3>&);

}  // namespace pillowmesh
