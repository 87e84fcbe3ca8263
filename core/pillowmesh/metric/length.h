// Metric length of straight edges, [Paper] Eq. (1), to a stated tolerance.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pillowmesh/metric/field.h"

namespace pillowmesh {

/// How finely an edge is looked at.
struct LengthOptions {
  /// Relative error aimed at.
  double tolerance = 1e-8;
  /// Longest piece, in the unit of the coordinates, that is integrated without looking inside: narrow features of the
  /// metric must not fall between the sample points. 0: one piece per edge.
  double panel = 0.0;
  /// Bisections at the most; reached only at jumps of the metric.
  int max_depth = 30;
};

/// Metric length of the segment from a to b: adaptive Gauss-Kronrod quadrature that bisects at kinks.
template <int Dim>
double edge_length(const MetricField<Dim>& field, const Point<Dim>& a, const Point<Dim>& b,
                   const LengthOptions& options = {});

/// Many at once: `edges` are pairs of indices into `points`. Works in batches of fixed size; memory does not grow
/// with the number of edges. \pre lengths.size() == edges.size()
template <int Dim>
void edge_lengths(const MetricField<Dim>& field, std::span<const Point<Dim>> points,
                  std::span<const std::array<VertexId, 2>> edges, std::span<double> lengths,
                  const LengthOptions& options = {});

}  // namespace pillowmesh
