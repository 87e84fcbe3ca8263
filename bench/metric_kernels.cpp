// What a metric costs: tensors per second at points, and exact edge lengths per second.
#include <benchmark/benchmark.h>

#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/background.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/metric/nodal.h"

namespace {

using namespace pillowmesh;

MetricField<2> field_of(const char* name) { return *MetricField<2>::from_formula(find_case(name)->formula); }

Mesh<2> mesh_of(const char* name) { return std::get<Mesh<2>>(*parse_primitive(find_case(name)->mesh)); }

/// A grid of n x n cells on the case's domain.
Mesh<2> fine_mesh_of(const char* name, int n) {
  const Mesh<2> coarse = mesh_of(name);
  Point<2> low = coarse.points[0], high = coarse.points[0];
  for (const auto& p : coarse.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return make_grid<2>({n, n}, low, high);
}

/// The same metric from the vertices of a background of 317 x 317 vertices.
MetricField<2> sampled(const char* name) {
  return *look_up(sample_at_vertices(field_of(name), fine_mesh_of(name, 316)));
}

void evaluate_metric(benchmark::State& state, const char* name, bool from_background) {
  const auto field = from_background ? sampled(name) : field_of(name);
  const auto mesh = fine_mesh_of(name, 100);
  std::vector<SymTensor<2>> tensors(mesh.points.size());
  for (auto _ : state) {
    field.evaluate(mesh.points, tensors);
    benchmark::DoNotOptimize(tensors.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(tensors.size()));
}
BENCHMARK_CAPTURE(evaluate_metric, iso2d, "iso2d", false);
BENCHMARK_CAPTURE(evaluate_metric, aniso2d, "aniso2d", false);
BENCHMARK_CAPTURE(evaluate_metric, circle2d, "circle2d", false);
BENCHMARK_CAPTURE(evaluate_metric, iso2d_background, "iso2d", true);
BENCHMARK_CAPTURE(evaluate_metric, circle2d_background, "circle2d", true);

/// What the adaptation loop asks, most often near the place before: look-ups in the quadtree over the metric.
void look_up_in_loop(benchmark::State& state, const char* name, bool from_background) {
  const auto mesh = fine_mesh_of(name, 100);
  Background background(from_background ? sampled(name) : field_of(name), mesh.points.front(), mesh.points.back());
  for (const auto& p : mesh.points) background.at(p);
  for (auto _ : state)
    for (const auto& p : mesh.points) benchmark::DoNotOptimize(background.at(p));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.points.size()));
}
BENCHMARK_CAPTURE(look_up_in_loop, iso2d_formula, "iso2d", false);
BENCHMARK_CAPTURE(look_up_in_loop, iso2d_background, "iso2d", true);
BENCHMARK_CAPTURE(look_up_in_loop, circle2d_formula, "circle2d", false);
BENCHMARK_CAPTURE(look_up_in_loop, circle2d_background, "circle2d", true);

void measure_edges(benchmark::State& state, const char* name) {
  const auto field = field_of(name);
  const auto mesh = fine_mesh_of(name, static_cast<int>(state.range(0)));
  const auto edges = unique_edges(mesh);
  std::vector<double> lengths(edges.size());
  for (auto _ : state) {
    edge_lengths<2>(field, mesh.points, edges, lengths);
    benchmark::DoNotOptimize(lengths.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(edges.size()));
}
// Long edges see much of the metric, short ones little: both occur in a run.
BENCHMARK_CAPTURE(measure_edges, iso2d, "iso2d")->Arg(10)->Arg(100);
BENCHMARK_CAPTURE(measure_edges, aniso2d, "aniso2d")->Arg(10)->Arg(100);
BENCHMARK_CAPTURE(measure_edges, circle2d, "circle2d")->Arg(10)->Arg(100);

}  // namespace

BENCHMARK_MAIN();
