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

}  // namespace pillowmesh
