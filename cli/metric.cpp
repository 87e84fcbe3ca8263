// pillowmesh metric
#include "cli/commands.h"
#include "cli/problem.h"
#include "pillowmesh/io/sol.h"
#include "pillowmesh/mesh/boundary.h"

namespace pillowmesh::cli {
namespace {

template <int Dim>
int write_metric(const Mesh<Dim>& mesh, const MetricFlags& flags) {
  auto field = problem_metric<Dim>(flags.problem, mesh);
  if (!field) return fail(field.status());
  std::vector<SymTensor<Dim>> tensors(mesh.points.size());
  field->evaluate(mesh.points, tensors);
  const Status s = write_text_file(write_sol(sol_of_metric<Dim>(tensors), flags.output), flags.output);
  return s.ok() ? 0 : fail(s);
}

}  // namespace

int metric(const MetricFlags& flags) {
  if (!flags.output.ends_with(".sol") && !flags.output.ends_with(".solb"))
    return fail(Status::usage(flags.output + ": a metric is written as .sol or .solb"));
  if (Status s = check_not_input(flags.output, flags.problem.metric_file); !s.ok()) return fail(s);
  auto mesh = problem_mesh(flags.problem);
  if (!mesh) return fail(mesh.status());
  return std::visit([&](const auto& m) { return write_metric(m, flags); }, *mesh);
}

}  // namespace pillowmesh::cli
