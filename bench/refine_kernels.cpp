// What topology costs: buffer layers inserted, in new cells per second, whatever the size of the mesh around them.
#include <benchmark/benchmark.h>

#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/refine/buffer_layer.h"

namespace {

using namespace pillowmesh;

/// Layers of 16 cells, one in every fourth row, are inserted one after the other in a mesh of n x n cells; the copy of
/// the mesh that each round starts from is not timed.
void insert_layers(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const auto initial = make_grid<2>({n, n}, Point<2>(0, 0), Point<2>(1, 1));
  const int length = 16;
  std::vector<std::vector<CellId>> sets;
  for (int j = 2; j + 2 < n; j += 4) {
    for (int i = 2; i + length + 2 < n; i += length + 4) {
      sets.emplace_back();
      for (int k = 0; k < length; ++k) sets.back().push_back(j * n + i + k);
    }
  }
  PillowWorkspace<2> work;
  BufferLayer<2> layer;
  std::int64_t cells = 0;
  for (auto _ : state) {
    state.PauseTiming();
    auto mesh = initial;
    state.ResumeTiming();
    for (const auto& set : sets) {
      if (!insert_buffer_layer<2>(mesh, set, {}, work, layer).ok()) state.SkipWithError("a layer was refused");
      cells += layer.cell_count;
    }
  }
  state.SetItemsProcessed(cells);
}
BENCHMARK(insert_layers)->Arg(100)->Arg(400)->Arg(1600)->Unit(benchmark::kMillisecond);

/// The same in 3D: plates of 8 x 8 hexes, in n x n x n cells.
void insert_plates(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0)), length = 8;
  const auto initial = make_grid<3>({n, n, n}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  std::vector<std::vector<CellId>> sets;
  for (int k = 2; k + 2 < n; k += 4) {
    for (int j = 2; j + length + 2 < n; j += length + 4) {
      for (int i = 2; i + length + 2 < n; i += length + 4) {
        sets.emplace_back();
        for (int c = 0; c < length * length; ++c)
          sets.back().push_back((k * n + j + c / length) * n + i + c % length);
      }
    }
  }
  PillowWorkspace<3> work;
  BufferLayer<3> layer;
  std::int64_t cells = 0;
  for (auto _ : state) {
    state.PauseTiming();
    auto mesh = initial;
    state.ResumeTiming();
    for (const auto& set : sets) {
      if (!insert_buffer_layer<3>(mesh, set, {}, work, layer).ok()) state.SkipWithError("a layer was refused");
      cells += layer.cell_count;
    }
  }
  state.SetItemsProcessed(cells);
}
BENCHMARK(insert_plates)->Arg(16)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond);

}  // namespace
