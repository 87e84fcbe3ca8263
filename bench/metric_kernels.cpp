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

/// What the smoother of hexahedra asks: a vertex and the middles of its edges at once (smooth/hex_star.cpp), of the formula
/// or of a background of 47 x 47 x 47 vertices.
void evaluate_stars(benchmark::State& state, const char* name, bool from_background) {
  const auto formula = *MetricField<3>::from_formula(find_case(name)->formula);
  const Point<3> low(0, 0, 0), high(1, 1, 1);
  const auto field =
      (from_background ? *look_up(sample_at_vertices(formula, make_grid<3>({46, 46, 46}, low, high))) : formula)
          .approximated();
  // Vertices away from those of the background, as those of an adapted mesh are.
  const auto mesh = make_grid<3>({11, 12, 13}, low, high);
  std::vector<std::array<Point<3>, 7>> stars;
  for (const auto& p : mesh.points) {
    auto& star = stars.emplace_back();
    star[0] = (p + Point<3>(0.003, 0.004, 0.005)).cwiseMin(high);
    for (int k = 0; k < 6; ++k)
      star[k + 1] = (star[0] + (k % 2 ? 0.04 : -0.04) * Point<3>::Unit(k / 2)).cwiseMax(low).cwiseMin(high);
  }
  std::array<SymTensor<3>, 7> tensors;
  for (auto _ : state) {
    for (const auto& star : stars) {
      field.evaluate(star, tensors);
      benchmark::DoNotOptimize(tensors.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(7 * stars.size()));
}
BENCHMARK_CAPTURE(evaluate_stars, linear3d_formula, "linear3d", false);
BENCHMARK_CAPTURE(evaluate_stars, linear3d_background, "linear3d", true);
BENCHMARK_CAPTURE(evaluate_stars, sphere3d_formula, "sphere3d", false);
BENCHMARK_CAPTURE(evaluate_stars, sphere3d_background, "sphere3d", true);

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
