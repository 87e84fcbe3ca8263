// From the command line to a metric.
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/problem.h"
#include "pillowmesh/io/background_file.h"
#include "pillowmesh/io/sol.h"
#include "pillowmesh/metric/nodal.h"

namespace pillowmesh::cli {
namespace {

std::string dimensional(int dim) { return std::to_string(dim) + "-dimensional"; }

/// The vertices and cells of the file or primitive that a .sol belongs to.
template <int Dim>
Expected<NodalMetric<Dim>> load_background(const std::string& name, const Mesh<Dim>& input, bool is_input) {
  if (is_input && is_primitive(name)) return NodalMetric<Dim>{input.points, divide<Dim>(input.points, input.cells), {}};
  if (is_primitive(name)) {
    auto mesh = parse_primitive(name);
    if (!mesh) return mesh.status();
    if (const auto* m = std::get_if<Mesh<Dim>>(&*mesh))
      return NodalMetric<Dim>{m->points, divide<Dim>(m->points, m->cells), {}};
    return Status::usage("the background " + name + " is not " + dimensional(Dim) + " as the mesh is");
  }
  auto bytes = read_file(name);
  if (!bytes) return bytes.status();
  auto background = read_background(name, *bytes);
  if (!background) return background.status();
  if (auto* metric = std::get_if<NodalMetric<Dim>>(&*background)) return std::move(*metric);
  return Status::bad_input("the background " + name + " is not " + dimensional(Dim) + " as the mesh is");
}

template <int Dim>
Expected<NodalMetric<Dim>> metric_from_file(const ProblemFlags& flags, const Mesh<Dim>& mesh) {
  const bool own = flags.background.empty();
  auto background = load_background<Dim>(own ? flags.input : flags.background, mesh, own);
  if (!background) return background.status();
  auto bytes = read_file(flags.metric_file);
  if (!bytes) return bytes.status();
  auto sol = read_sol(flags.metric_file, *bytes);
  if (!sol) return sol.status();
  auto tensors = metric_of_sol<Dim>(*sol, flags.metric_file, background->points.size());
  if (!tensors) return tensors.status();
  background->tensors = std::move(*tensors);
  if (Status s = check_tensors<Dim>(background->tensors, background->points.size()); !s.ok())
    return Status::bad_input(flags.metric_file + ": " + s.message);
  return background;
}

/// All that the flags name, each as it is.
template <int Dim>
Expected<std::vector<MetricSource<Dim>>> metric_sources(const ProblemFlags& flags, const Mesh<Dim>& mesh) {
  std::vector<MetricSource<Dim>> sources;
  std::string formula = flags.metric;
  if (!flags.case_name.empty()) {
    auto c = named_case(flags.case_name);
    if (!c) return c.status();
    if ((*c)->dim != Dim)
      return Status::usage("the case " + flags.case_name + " is " + dimensional((*c)->dim) + ", but the mesh is " +
                           dimensional(Dim));
    formula = (*c)->formula;
  }
  if (!formula.empty()) {
    auto field = MetricField<Dim>::from_formula(formula);
    if (!field) return field.status();
    sources.push_back(std::move(*field));
  }
  if (!flags.metric_file.empty()) {
    auto metric = metric_from_file(flags, mesh);
    if (!metric) return metric.status();
    sources.push_back(std::move(*metric));
  }
  return sources;
}

}  // namespace

template <int Dim>
Expected<MetricField<Dim>> problem_metric(const ProblemFlags& flags, const Mesh<Dim>& mesh) {
  auto sources = metric_sources(flags, mesh);
  if (!sources) return sources.status();
  auto field = combine_field(*sources, flags.operations, mesh);
  if (!field || flags.size_scale == 1.0) return field;
  return field->scaled(flags.size_scale);
}

template Expected<MetricField<2>> problem_metric<2>(const ProblemFlags&, const Mesh<2>&);
template Expected<MetricField<3>> problem_metric<3>(const ProblemFlags&, const Mesh<3>&);

}  // namespace pillowmesh::cli
