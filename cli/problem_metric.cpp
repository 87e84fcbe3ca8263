// From the command line to a metric.
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/pictures.h"
#include "cli/problem.h"
#include "pillowmesh/io/background_file.h"
#include "pillowmesh/io/sol.h"
#include "pillowmesh/metric/hessian.h"
#include "pillowmesh/metric/image.h"
#include "pillowmesh/metric/nodal.h"
#include "pillowmesh/metric/portrait.h"
#include "pillowmesh/metric/sketch.h"
#include "pillowmesh/metric/walls.h"

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

/// The background of a .sol and what it says.
template <int Dim>
struct OnBackground {
  NodalMetric<Dim> background;
  SolFile sol;
};
template <int Dim>
Expected<OnBackground<Dim>> load_sol(const std::string& file, const ProblemFlags& flags, const Mesh<Dim>& mesh) {
  const bool own = flags.background.empty();
  if (own && flags.input.empty()) return Status::usage(file + ": give the mesh that it belongs to with --background");
  auto background = load_background<Dim>(own ? flags.input : flags.background, mesh, own);
  if (!background) return background.status();
  auto bytes = read_file(file);
  if (!bytes) return bytes.status();
  auto sol = read_sol(file, *bytes);
  if (!sol) return sol.status();
  return OnBackground<Dim>{std::move(*background), std::move(*sol)};
}

template <int Dim>
Expected<NodalMetric<Dim>> metric_from_file(const ProblemFlags& flags, const Mesh<Dim>& mesh) {
  auto loaded = load_sol(flags.metric_file, flags, mesh);
  if (!loaded) return loaded.status();
  NodalMetric<Dim>& metric = loaded->background;
  auto tensors = metric_of_sol<Dim>(loaded->sol, flags.metric_file, metric.points.size());
  if (!tensors) return tensors.status();
  metric.tensors = std::move(*tensors);
  if (Status s = check_tensors<Dim>(metric.tensors, metric.points.size()); !s.ok())
    return Status::bad_input(flags.metric_file + ": " + s.message);
  return std::move(metric);
}

HessianOptions hessian_options(const ProblemFlags& flags, HessianOptions options = {}) {
  if (flags.norm != 0.0) options.norm = flags.norm;
  options.error = flags.error;
  return options;
}

template <int Dim>
Expected<NodalMetric<Dim>> hessian_from_file(const ProblemFlags& flags, const Mesh<Dim>& mesh) {
  auto loaded = load_sol(flags.hessian_file, flags, mesh);
  if (!loaded) return loaded.status();
  NodalMetric<Dim>& metric = loaded->background;
  auto values = scalar_of_sol(loaded->sol, flags.hessian_file, Dim, metric.points.size());
  if (!values) return values.status();
  metric.tensors = recover_hessian<Dim>(metric.points, metric.simplices, *values);
  if (Status s = multiscale_metric(metric, hessian_options(flags)); !s.ok())
    return Status::bad_input(flags.hessian_file + ": " + s.message);
  return std::move(metric);
}

template <int Dim>
struct Box {
  Point<Dim> low, high;
};
template <int Dim>
Box<Dim> box_of(const Mesh<Dim>& mesh) {
  Box<Dim> box{mesh.points[0], mesh.points[0]};
  for (const Point<Dim>& p : mesh.points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

/// The size where nothing else asks for one: --hmax, or a tenth of the diagonal.
template <int Dim>
double coarsest(const ProblemFlags& flags, const Box<Dim>& box) {
  const double largest = flags.operations.bounds.largest;
  return largest < 1e100 ? largest : 0.1 * (box.high - box.low).norm();
}

/// What only quads have: pictures, sketches and curves.
Expected<std::vector<MetricSource<2>>> flat_sources(const ProblemFlags& flags, const Mesh<2>& mesh) {
  std::vector<MetricSource<2>> sources;
  const Box<2> box = box_of(mesh);
  const bool is_portrait = flags.case_name == portrait_case().name;
  if (!flags.image.empty() || is_portrait) {
    auto image = is_portrait ? Expected<GrayImage>(portrait(256, 320)) : read_image(flags.image);
    if (!image) return image.status();
    ImageOptions options;
    options.hessian = hessian_options(flags, options.hessian);
    auto metric = image_metric(*image, box.low, box.high, options);
    if (!metric) return Status{metric.status().code, flags.image + ": " + metric.status().message};
    sources.push_back(std::move(*metric));
  }
  if (!flags.sketch.empty()) {
    auto dabs = read_sketch(flags.sketch);
    if (!dabs) return dabs.status();
    auto metric = sketch_metric(*dabs, coarsest(flags, box), box.low, box.high);
    if (!metric) return Status{metric.status().code, flags.sketch + ": " + metric.status().message};
    sources.push_back(std::move(*metric));
  }
  if (flags.curvature > 0.0) {
    auto metric = curvature_metric(mesh, flags.curvature, 1.3, coarsest(flags, box));
    if (!metric) return metric.status();
    sources.push_back(std::move(*metric));
  }
  return sources;
}
Expected<std::vector<MetricSource<3>>> flat_sources(const ProblemFlags& flags, const Mesh<3>&) {
  if (!flags.image.empty() || !flags.sketch.empty() || flags.curvature > 0.0)
    return Status::usage("--metric-image, --sketch and --curvature are for two-dimensional meshes");
  return std::vector<MetricSource<3>>{};
}

template <int Dim>
Expected<NodalMetric<Dim>> metric_of_mesh(const ProblemFlags& flags) {
  auto mesh = load_mesh(flags.metric_of);
  if (!mesh) return mesh.status();
  if (const auto* m = std::get_if<Mesh<Dim>>(&*mesh)) return implied_metric(*m);
  return Status::usage("--metric-of " + flags.metric_of + " is not " + dimensional(Dim) + " as the mesh is");
}

template <int Dim>
Expected<NodalMetric<Dim>> layers_metric(const ProblemFlags& flags, const Mesh<Dim>& mesh) {
  std::vector<WallLayer> layers;
  for (const std::string& text : flags.layers) {
    auto layer = parse_wall_layer(text);
    if (!layer) return layer.status();
    layer->along = coarsest(flags, box_of(mesh));
    layers.push_back(std::move(*layer));
  }
  return wall_metric(mesh, layers);
}

/// All that the flags name, each as it is; in the order of makeMetric (wasm/metrics.ts), for intersections depend on
/// it.
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
  Status failed;
  const auto add = [&](bool asked, auto&& make) {
    if (!asked || !failed.ok()) return;
    Expected<NodalMetric<Dim>> metric = make();
    if (metric)
      sources.push_back(std::move(*metric));
    else
      failed = metric.status();
  };
  add(!flags.metric_file.empty(), [&] { return metric_from_file(flags, mesh); });
  add(!flags.hessian_of.empty(), [&]() -> Expected<NodalMetric<Dim>> {
    auto hessian = FormulaHessian<Dim>::from_formula(flags.hessian_of);
    if (!hessian) return hessian.status();
    const Box<Dim> box = box_of(mesh);
    return hessian_metric(*hessian, box.low, box.high, hessian_options(flags));
  });
  add(!flags.hessian_file.empty(), [&] { return hessian_from_file(flags, mesh); });
  if (!failed.ok()) return failed;
  auto flat = flat_sources(flags, mesh);
  if (!flat) return flat.status();
  for (auto& source : *flat) sources.push_back(std::move(source));
  add(!flags.metric_of.empty(), [&] { return metric_of_mesh<Dim>(flags); });
  add(!flags.layers.empty(), [&] { return layers_metric(flags, mesh); });
  if (!failed.ok()) return failed;
  return sources;
}

}  // namespace

template <int Dim>
Expected<MetricField<Dim>> problem_metric(const ProblemFlags& flags, const Mesh<Dim>& mesh) {
  auto sources = metric_sources(flags, mesh);
  if (!sources) return sources.status();
  MetricOperations operations = flags.operations;
  const bool image = !flags.image.empty() || flags.case_name == portrait_case().name;
  if (image) use_picture_defaults(operations, flags.error);
  auto field = combine_field(*sources, operations, mesh);
  if (!field || flags.size_scale == 1.0) return field;
  return field->scaled(flags.size_scale);
}

template Expected<MetricField<2>> problem_metric<2>(const ProblemFlags&, const Mesh<2>&);
template Expected<MetricField<3>> problem_metric<3>(const ProblemFlags&, const Mesh<3>&);

}  // namespace pillowmesh::cli
