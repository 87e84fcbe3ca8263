// Metric length of straight edges, [Paper] Eq. (1), to a stated tolerance.
#pragma once

#include <array>
#include <span>

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

/// Metric length of the segment from a to b: nested Gauss-Lobatto-Kronrod rules of 4, 7 and 13 points, bisecting where
/// they disagree, so that kinks are closed in on. The same bits for (a, b) and (b, a), alone and among others. Not a
/// number where the metric is not. Cost: 7 or 13 evaluations of the metric where it is smooth.
template <int Dim>
double edge_length(const MetricField<Dim>& field, const Point<Dim>& a, const Point<Dim>& b,
                   const LengthOptions& options = {});

/// Many at once: `edges` are pairs of indices into `points`. Works in batches of fixed size; memory does not grow
/// with the number of edges. \pre lengths.size() == edges.size()
template <int Dim>
void edge_lengths(const MetricField<Dim>& field, std::span<const Point<Dim>> points,
                  std::span<const std::array<VertexId, 2>> edges, std::span<double> lengths,
                  const LengthOptions& options = {});

/// tagged[i] = 1 where edge i is longer than `threshold`, else 0: looks only as closely as the decision needs, at four
/// even steps in each panel of most edges. Right for all lengths further than 1e-6 * threshold from the threshold, by an
/// approximated field (MetricField::approximated) further than 3e-3 * threshold.
/// \param panel as in LengthOptions. \pre tagged.size() == edges.size()
template <int Dim>
void tag_long_edges(const MetricField<Dim>& field, std::span<const Point<Dim>> points,
                    std::span<const std::array<VertexId, 2>> edges, double threshold, double panel,
                    std::span<unsigned char> tagged);

/// The number of panels of an edge of this length: 4096 at the most.
int panel_count(double length, double panel);

/// A panel that misses no feature wider than a thousandth of the domain: the diagonal of the bounding box / 256.
template <int Dim>
double default_panel(std::span<const Point<Dim>> points);

}  // namespace pillowmesh
