// Approaching a metric whose sizes change fast: from larger sizes, in steps.
#pragma once

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/metric/field.h"

namespace pillowmesh {

/// The metrics on the way: sizes do not fall below a floor, at first the mean edge of the mesh, then half as much with
/// every step; at last there is none. A layer that is refined for the next size only reaches as far as that size does,
/// where with the whole metric at once thin layers are laid through cells that are far too large for them.
template <int Dim>
class Continuation {
 public:
  /// \param steps 0: the metric itself at once; -1: chosen by steps_for.
  Continuation(const Mesh<Dim>& mesh, const MetricField<Dim>& field, int steps);

  [[nodiscard]] bool done() const { return steps_ == 0; }
  /// True if there were steps to take: sizes change fast.
  [[nodiscard]] bool steep() const { return steep_; }
  /// The next floor. \pre !done()
  void next();
  /// The field on its way.
  [[nodiscard]] MetricField<Dim> approach(const MetricField<Dim>& field) const;

 private:
  int steps_;
  bool steep_;
  double floor_ = 0.0;
};

/// 7 in 3D where along some edge of the mesh the least size changes by more than half of the edge, else 0. Measured
/// (docs/results.md): sizes that grow by 1.5 per length come out better, those that grow by 0.2 worse.
template <int Dim>
int steps_for(const Mesh<Dim>& mesh, const MetricField<Dim>& field);

/// The greatest change of the logarithm of the least size per unit of metric length, along the edges of the mesh. Where
/// sizes grow in the direction in which they are least, it is their growth per length, dh/ds; where they grow in
/// another, lengths tell less of it, and it is up to as many times that as the metric is stretched. Cost: some
/// evaluations for each edge, and one for each panel of it (metric/length.h).
template <int Dim>
double growth_per_length(const Mesh<Dim>& mesh, const MetricField<Dim>& field);

/// `threshold`, or sqrt 2 if that is less and the growth per length is above 3: then cells with longer edges have
/// corners of such different sizes that no flat simplex has their lengths (docs/algorithm.md).
template <int Dim>
double threshold_for(const Mesh<Dim>& mesh, const MetricField<Dim>& field, double threshold);

}  // namespace pillowmesh
