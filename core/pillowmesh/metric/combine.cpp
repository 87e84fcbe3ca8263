#include "pillowmesh/metric/combine.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "pillowmesh/mesh/number.h"
#include "pillowmesh/mesh/portable_math.h"
#include "pillowmesh/metric/gradation.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/metric/sample.h"
#include "pillowmesh/metric/volume.h"

namespace pillowmesh {
namespace {

Status set_above(std::string_view name, std::string_view value, double above, double& out) {
  double number = 0.0;
  if (!parse_double(value, number) || !(number > above) || !(number < 1e100))
    return Status::usage("--" + std::string(name) + " takes a number above " + rounded_text(above, 3) + ", not '" +
                         std::string(value) + "'");
  out = number;
  return {};
}

template <int Dim>
double measured_complexity(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  return complexity(mesh, field, VolumeOptions::for_panel(Dim, default_panel<Dim>(mesh.points), 1e-3));
}

template <int Dim>
Expected<MetricField<Dim>> field_of(const MetricSource<Dim>& source) {
  if (const auto* field = std::get_if<MetricField<Dim>>(&source)) return *field;
  return look_up(std::get<NodalMetric<Dim>>(source));
}

/// The intersection of the sources, without the operations.
template <int Dim>
Expected<NodalMetric<Dim>> intersection_of(const std::vector<MetricSource<Dim>>& sources, const Mesh<Dim>& mesh) {
  if (sources.size() == 1) {
    if (const auto* nodal = std::get_if<NodalMetric<Dim>>(&sources[0])) return *nodal;
  }
  std::vector<MetricField<Dim>> fields;
  for (const MetricSource<Dim>& source : sources) {
    auto field = field_of(source);
    if (!field) return field.status();
    if (Status s = field->check(mesh.points); !s.ok()) return s;
    fields.push_back(std::move(*field));
  }
  Point<Dim> low = mesh.points[0], high = low;
  for (const Point<Dim>& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<SymTensor<Dim>> other;
  const Evaluate<Dim> all = [&](std::span<const Point<Dim>> points, std::span<SymTensor<Dim>> out) {
    fields[0].evaluate(points, out);
    other.resize(points.size());
    for (std::size_t k = 1; k < fields.size(); ++k) {
      fields[k].evaluate(points, other);
      for (std::size_t i = 0; i < points.size(); ++i) out[i] = intersect(out[i], other[i]);
    }
  };
  return sample<Dim>(all, low, high);
}

template <int Dim>
NodalMetric<Dim> operated(const NodalMetric<Dim>& base, double scale, const MetricOperations& operations) {
  NodalMetric<Dim> out = base;
  for (SymTensor<Dim>& M : out.tensors) {
    M = (1.0 / (scale * scale)) * M;
    if (operations.bounds.any()) M = bound_sizes(M, operations.bounds);
  }
  if (operations.gradation > 0.0) limit_gradation(out, operations.gradation);
  return out;
}

}  // namespace

Status set_operation(MetricOperations& operations, std::string_view name, std::string_view value) {
  SizeBounds& b = operations.bounds;
  if (name == "hmin") return set_above(name, value, 0.0, b.smallest);
  if (name == "hmax") return set_above(name, value, 0.0, b.largest);
  if (name == "max-anisotropy") {
    if (Status s = set_above(name, value, 0.0, b.anisotropy); !s.ok()) return s;
    return b.anisotropy >= 1.0
               ? Status{}
               : Status::usage("--max-anisotropy takes a number from 1, not '" + std::string(value) + "'");
  }
  if (name == "gradation") {
    if (Status s = set_above(name, value, 1.0, operations.gradation); !s.ok()) return s;
    return operations.gradation >= 1.01
               ? Status{}
               : Status::usage("--gradation takes a number from 1.01, not '" + std::string(value) + "'");
  }
  if (name == "target-cells") return set_above(name, value, 0.0, operations.cells);
  return Status::usage("there is no metric operation --" + std::string(name));
}

void use_picture_defaults(MetricOperations& operations, double error) {
  if (operations.cells == 0.0 && error == 0.0) operations.cells = 6000.0;
  if (operations.gradation == 0.0) operations.gradation = 1.5;
}

template <int Dim>
double scale_to_cells(const MetricField<Dim>& field, const Mesh<Dim>& mesh, double cells) {
  const double ratio = measured_complexity(mesh, field) / cells;
  return Dim == 2 ? std::sqrt(ratio) : portable::pow(ratio, 1.0 / 3.0);
}

template <int Dim>
Expected<NodalMetric<Dim>> combine(const std::vector<MetricSource<Dim>>& sources, const MetricOperations& operations,
                                   const Mesh<Dim>& mesh) {
  if (operations.bounds.smallest > operations.bounds.largest) return Status::usage("--hmin is above --hmax");
  auto base = intersection_of(sources, mesh);
  if (!base) return base.status();
  if (Status s = check_tensors<Dim>(base->tensors, base->points.size()); !s.ok()) return s;
  if (operations.cells == 0.0) return operated(*base, 1.0, operations);

  // log(cells) falls with log(scale), by Dim where bounds and gradation do not bend it: secants inside of a bracket.
  const double wanted = portable::log(operations.cells);
  double at = 0.0, slope = -Dim, found = 0.0, low = -70.0, high = 70.0, last_at = 0.0, last_value = 0.0;
  NodalMetric<Dim> out;
  for (int i = 0; i < 25; ++i) {
    out = operated(*base, portable::exp(at), operations);
    auto field = look_up(out);
    if (!field) return field.status();
    found = measured_complexity(mesh, *field);
    const double value = portable::log(found) - wanted;
    if (std::fabs(value) < 2e-3) return out;
    (value > 0.0 ? low : high) = at;
    if (i > 0 && at != last_at) slope = std::clamp((value - last_value) / (at - last_at), -2.0 * Dim, -0.1);
    last_at = at;
    last_value = value;
    at -= value / slope;
    if (!(at > low && at < high)) at = 0.5 * (low + high);
    if (high - low < 1e-3) break;
  }
  if (std::fabs(found / operations.cells - 1.0) < 0.02) return out;
  return Status::usage("--target-cells " + rounded_text(operations.cells, 6) +
                       " cannot be met within the bounds on sizes: they lead to about " + rounded_text(found, 3) +
                       " cells; widen --hmin, --hmax or --gradation");
}

template <int Dim>
Expected<MetricField<Dim>> combine_field(const std::vector<MetricSource<Dim>>& sources,
                                         const MetricOperations& operations, const Mesh<Dim>& mesh) {
  if (sources.size() == 1 && operations.only_scale()) {
    auto field = field_of(sources[0]);
    if (!field) return field.status();
    if (Status s = field->check(mesh.points); !s.ok()) return s;
    if (operations.cells == 0.0) return field;
    return field->scaled(scale_to_cells(*field, mesh, operations.cells));
  }
  auto nodal = combine(sources, operations, mesh);
  if (!nodal) return nodal.status();
  return look_up(std::move(*nodal));
}

#define PILLOWMESH_INSTANTIATE(D)                                                                                  \
  template Expected<NodalMetric<D>> combine<D>(const std::vector<MetricSource<D>>&, const MetricOperations&,       \
                                               const Mesh<D>&);                                                    \
  template Expected<MetricField<D>> combine_field<D>(const std::vector<MetricSource<D>>&, const MetricOperations&, \
                                                     const Mesh<D>&);                                              \
  template double scale_to_cells<D>(const MetricField<D>&, const Mesh<D>&, double);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
