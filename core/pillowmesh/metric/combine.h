// From what was asked for, any number of metrics, bounds, gradation and a number of cells, to the one metric of a run.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/metric/intersection.h"
#include "pillowmesh/metric/nodal.h"

namespace pillowmesh {

/// In this order: all sizes are multiplied so that `cells` come out in the end, then cut to the bounds, then graded.
struct MetricOperations {
  SizeBounds bounds;
  double gradation = 0.0;  ///< > 1: see gradation.h; 0: none
  double cells = 0.0;      ///< > 0: the complexity, the integral of sqrt(det M) over the mesh; 0: as the sources say

  /// Whether the metric at one point says all: no background is needed.
  [[nodiscard]] bool only_scale() const { return !bounds.any() && gradation == 0.0; }
};

/// Sets an operation by its command-line name without dashes: hmin, hmax, max-anisotropy, gradation, target-cells.
/// \return usage with the allowed values when name or value is wrong
Status set_operation(MetricOperations& operations, std::string_view name, std::string_view value);

/// What a picture does not say itself: 6000 cells, unless `error` or a number is given, and a gradation of 1.5.
void use_picture_defaults(MetricOperations& operations, double error);

/// A field, or tensors on a background of their own.
template <int Dim>
using MetricSource = std::variant<MetricField<Dim>, NodalMetric<Dim>>;

/// The intersection of all sources after the operations, on the background of the source if there is one source and it
/// has one, else sampled (sample.h) over the box around the mesh. \return bad_input where a source is no metric; usage
/// when bounds make the number of cells impossible.
template <int Dim>
Expected<NodalMetric<Dim>> combine(const std::vector<MetricSource<Dim>>& sources, const MetricOperations& operations,
                                   const Mesh<Dim>& mesh);

/// The same as a field; one source that is a field, with no operation but a number of cells, is not sampled.
template <int Dim>
Expected<MetricField<Dim>> combine_field(const std::vector<MetricSource<Dim>>& sources,
                                         const MetricOperations& operations, const Mesh<Dim>& mesh);

/// The factor on all sizes by which the field's complexity over the mesh becomes `cells`.
template <int Dim>
double scale_to_cells(const MetricField<Dim>& field, const Mesh<Dim>& mesh, double cells);

}  // namespace pillowmesh
