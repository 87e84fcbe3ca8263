// What relocation costs: vertex moves per second in sweeps over a mesh as the layers leave it.
#include <benchmark/benchmark.h>

#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/smooth/relocate.h"

namespace {

using namespace pillowmesh;

/// The first sweeps of the smoother: all vertices are active.
template <int Dim>
void sweep(benchmark::State& state, const char* name, double scale) {
  const Case& example = *find_case(name);
  const auto field = MetricField<Dim>::from_formula(example.formula)->scaled(scale);
  AdaptOptions options;
  options.method = Method::paper;
  options.smoothing = Smoothing::none;
  Adapter<Dim> adapter(std::get<Mesh<Dim>>(*parse_primitive(example.mesh)), field, options);
  if (!adapter.run().ok()) state.SkipWithError("the layers could not be inserted");
  std::int64_t moved = 0;
  for (auto _ : state) {
    state.PauseTiming();
    auto mesh = adapter.mesh();
    Relocator<Dim> relocator(mesh, field);
    state.ResumeTiming();
    for (int i = 0; i < 3; ++i) moved += relocator.sweep().moved;
  }
  state.SetItemsProcessed(moved);
}
void sweep_quads(benchmark::State& state, const char* name) { sweep<2>(state, name, 1.0); }
BENCHMARK_CAPTURE(sweep_quads, iso2d, "iso2d")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sweep_quads, aniso2d, "aniso2d")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sweep_quads, circle2d, "circle2d")->Unit(benchmark::kMillisecond);


/// linear3d finer than the case, so that the mesh does not fit in the nearest cache. Finding the stars is not timed.
void sweep_hexes(benchmark::State& state, const char* name, double scale) { sweep<3>(state, name, scale); }
BENCHMARK_CAPTURE(sweep_hexes, linear3d, "linear3d", 0.5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sweep_hexes, cube_linear, "cube-linear", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sweep_hexes, sphere3d, "sphere3d", 1.0)->Unit(benchmark::kMillisecond);

}  // namespace
