#include "pillowmesh/adapt/longest_edge.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "pillowmesh/mesh/frozen.h"
#include "pillowmesh/metric/length.h"

namespace pillowmesh {
namespace {

template <int Dim>
std::vector<double> lengths_of(std::span<const std::array<VertexId, 2>> edges, const Mesh<Dim>& mesh,
                               const MetricField<Dim>& field) {
  std::vector<double> lengths(edges.size());
  edge_lengths<Dim>(field, mesh.points, edges, lengths, {kLongestEdgeTolerance, 0.0, 6});
  return lengths;
}

template <int Dim>
std::vector<std::array<VertexId, 2>> free_edges(const Mesh<Dim>& mesh) {
  auto edges = unique_edges(mesh);
  if (mesh.frozen) std::erase_if(edges, [&](const auto& e) { return is_frozen_edge(mesh, e[0], e[1]); });
  return edges;
}

}  // namespace

template <int Dim>
double longest_edge(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  const auto lengths = lengths_of<Dim>(free_edges(mesh), mesh, field);
  return lengths.empty() ? 0.0 : *std::max_element(lengths.begin(), lengths.end());
}

std::vector<std::array<VertexId, 2>> longer_edges(const Mesh<2>& mesh, const MetricField<2>& field, double length,
                                                  std::span<const unsigned char> touched) {
  auto edges = free_edges(mesh);
  if (!touched.empty()) std::erase_if(edges, [&](const auto& e) { return touched[e[0]] == 0 && touched[e[1]] == 0; });
  const auto keep = [&](auto&& which) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (which(i)) edges[count++] = edges[i];
    edges.resize(count);
  };
  // By chance, the rules for five samples agree on a length that is off by a few hundredths.
  constexpr double nearly = 0.8;
  std::vector<unsigned char> tagged(edges.size());
  tag_long_edges<2>(field, mesh.points, edges, nearly * length, 0.0, tagged);
  keep([&](std::size_t i) { return tagged[i] != 0; });
  const auto lengths = lengths_of<2>(edges, mesh, field);
  keep([&](std::size_t i) { return lengths[i] > length; });
  return edges;
}

template <int Dim>
double mean_edge_length(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  const auto lengths = lengths_of<Dim>(unique_edges(mesh), mesh, field);
  double sum = 0.0;
  for (const double l : lengths) sum += l;
  return lengths.empty() ? 0.0 : sum / static_cast<double>(lengths.size());
}

template <int Dim>
Status check_frozen_edges(const Mesh<Dim>& mesh, const MetricField<Dim>& field, double threshold) {
  if (!mesh.frozen || mesh.frozen->edges.empty()) return {};
  const auto lengths = lengths_of(mesh.frozen->edges, mesh, field);
  const auto count = std::count_if(lengths.begin(), lengths.end(),
                                   [&](double l) { return l > threshold * (1.0 + kLongestEdgeTolerance); });
  if (count == 0) return {};
  return Status::limit_not_met(std::to_string(count) + (count == 1 ? " edge is" : " edges are") +
                               " longer than the threshold, but frozen");
}

template double longest_edge(const Mesh<2>&, const MetricField<2>&);
template double longest_edge(const Mesh<3>&, const MetricField<3>&);
template double mean_edge_length(const Mesh<2>&, const MetricField<2>&);
template double mean_edge_length(const Mesh<3>&, const MetricField<3>&);
template Status check_frozen_edges(const Mesh<2>&, const MetricField<2>&, double);
template Status check_frozen_edges(const Mesh<3>&, const MetricField<3>&, double);

}  // namespace pillowmesh
