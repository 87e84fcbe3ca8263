#include "loop.h"

#include <pillowmesh/adapt/adapter.h>
#include <pillowmesh/adapt/transfer.h>
#include <pillowmesh/mesh/primitives.h>
#include <pillowmesh/metric/combine.h>
#include <pillowmesh/metric/hessian.h>

#include <algorithm>
#include <cmath>

namespace solver {

using namespace pillowmesh;

namespace {

int live_cells(const Mesh<2>& mesh) {
  int count = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) count += mesh.alive(c);
  return count;
}

/// The values of live vertices, in order: as solution_on lists the points.
std::vector<double> of_live(const State& state) {
  std::vector<double> out;
  for (VertexId v = 0; v < state.mesh.vertex_count(); ++v)
    if (state.mesh.vertex_cell[v] != kNone) out.push_back(state.values[v]);
  return out;
}

/// Larger curvature in both directions.
SymTensor<2> round(const SymTensor<2>& h) {
  const double half = 0.5 * (h.m[0] + h.m[2]), off = std::hypot(0.5 * (h.m[0] - h.m[2]), h.m[1]);
  SymTensor<2> out = h;
  out.m = {std::abs(half) + off, 0.0, std::abs(half) + off};
  return out;
}

}  // namespace

Expected<MetricField<2>> estimate(const State& state, double cells, bool isotropic) {
  Solution<2> on = solution_on(state.mesh);
  NodalMetric<2> metric;
  metric.points = std::move(on.points);
  metric.simplices = divide<2>(metric.points, on.cells);
  metric.tensors = recover_hessian<2>(metric.points, metric.simplices, of_live(state));
  if (isotropic)
    for (auto& tensor : metric.tensors) tensor = round(tensor);
  if (Status s = multiscale_metric(metric, {}); !s.ok()) return s;
  MetricOperations operations;
  operations.cells = cells;
  operations.gradation = isotropic ? 1.5 : 0.0;
  operations.bounds.largest = 0.3;
  return combine_field<2>({std::move(metric)}, operations, state.mesh);
}

Turn begin(const Known& known, int n, State& state) {
  state.mesh = std::get<Mesh<2>>(*parse_primitive(known.mesh(n)));
  state.values = solve(state.mesh, known.problem);
  return {live_cells(state.mesh), l2_error(state.mesh, state.values, known.exact), NAN};
}

Expected<Turn> turn(const Known& known, double cells, bool isotropic, Effort effort, State& state) {
  auto metric = estimate(state, cells, isotropic);
  if (!metric) return metric.status();
  AdaptOptions options;
  options.effort = effort;
  Adapter<2> adapter(state.mesh, *metric, options);
  if (const Status s = adapter.run(); s.code == StatusCode::bad_input) return s;

  Solution<2> old = solution_on(state.mesh);
  old.fields.push_back({"u", false, false, 1, of_live(state)});
  state.mesh = adapter.mesh();
  const auto carried = carry(old, state.mesh);
  if (!carried) return carried.status();
  std::vector<double> start(state.mesh.points.size(), 0.0);
  for (VertexId v = 0, i = 0; v < state.mesh.vertex_count(); ++v)
    if (state.mesh.vertex_cell[v] != kNone) start[v] = (*carried)[0].values[i++];
  state.values = solve(state.mesh, known.problem);
  if (state.values.empty()) return Status::bad_input("the linear system cannot be solved");
  return Turn{live_cells(state.mesh), l2_error(state.mesh, state.values, known.exact),
              l2_error(state.mesh, start, known.exact)};
}

}  // namespace solver
