// Integrals along many straight lines to four or five digits, for what is reported of a mesh: fewer samples than
// length.h takes for eight, most of all at kinks.
#pragma once

#include <span>

#include "pillowmesh/metric/field.h"

namespace pillowmesh {

template <int Dim>
struct Line {
  Point<Dim> from, to;
  /// The metric at the ends where it is known, of both or of none: lines that meet need not ask for it again.
  const SymTensor<Dim> *at_from = nullptr, *at_to = nullptr;
  bool single_panel = false;  ///< however long it is
};

struct LineIntegral {
  double length = 0.0;   ///< in the metric
  double density = 0.0;  ///< 2D: the mean of sqrt(det M) along the line
  double ends = 0.0;     ///< 2D: the sum of sqrt(det M) at its ends
};

struct LineOptions {
  /// Relative error of lengths aimed at.
  double tolerance = 2e-5;
  /// Longest piece, in the unit of the coordinates, that is taken for smooth by five samples (length.h).
  double panel = 0.0;
  /// The same of densities.
  double density_tolerance = 1e-3;
  /// Halvings at the most, but for one; reached only at jumps of the metric.
  int max_depth = 30;
};

/// Boole's rule on panels, halved where it differs from Simpson's, or much from the trapezoids'; halves keep the samples. The
/// error is much less than the tolerance where the metric is smooth, at kinks and jumps some times that. The same bits for
/// both directions of a line, alone and among others. Not a number where the metric is not. Memory does not grow with the
/// number of lines. Cost: 5 evaluations of the metric where it is smooth, 3 where the ends are known, 4 for each halving.
/// \pre integrals.size() == lines.size()
template <int Dim>
void line_integrals(const MetricField<Dim>& field, std::span<const Line<Dim>> lines, std::span<LineIntegral> integrals,
                    const LineOptions& options = {});

}  // namespace pillowmesh
