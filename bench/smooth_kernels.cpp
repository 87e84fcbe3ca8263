// What relocation costs: vertex moves per second in sweeps over a mesh as the layers leave it.
#include <benchmark/benchmark.h>

#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/smooth/relocate.h"

namespace {

using namespace pillowmesh;

/// The first sweeps of the smoother: all vertices are active.
void sweep(benchmark::State& state, const char* name) {
  const Case& example = *find_case(name);
  const auto field = *MetricField<2>::from_formula(example.formula);
  AdaptOptions options;
  options.smoothing = Smoothing::none;
  Adapter<2> adapter(std::get<Mesh<2>>(*parse_primitive(example.mesh)), field, options);
  if (!adapter.run().ok()) state.SkipWithError("the layers could not be inserted");
  std::int64_t moved = 0;
  for (auto _ : state) {
    state.PauseTiming();
    auto mesh = adapter.mesh();
    Relocator<2> relocator(mesh, field);
    state.ResumeTiming();
    for (int i = 0; i < 3; ++i) moved += relocator.sweep().moved;
  }
  state.SetItemsProcessed(moved);
}
BENCHMARK_CAPTURE(sweep, iso2d, "iso2d")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sweep, aniso2d, "aniso2d")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sweep, circle2d, "circle2d")->Unit(benchmark::kMillisecond);

}  // namespace
