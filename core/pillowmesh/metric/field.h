// A metric tensor per point of the domain.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/program.h"
#include "pillowmesh/metric/tensor.h"

namespace pillowmesh {

/// A batch of points and of tensors, one array per coordinate and per packed entry.
template <int Dim>
using PointLanes = std::array<Lanes, Dim>;
template <int Dim>
using TensorLanes = std::array<Lanes, SymTensor<Dim>::size>;

template <int Dim>
class DiscreteMetric;  // metric/discrete.h
class SizeOctree;      // metric/size_octree.h

/// The metric field. A value: cheap to copy, immutable, safe to read from several threads.
template <int Dim>
class MetricField {
 public:
  /// From a formula (see expression.h) that assigns one of these sets of names, D = diag(h1^-2, h2^-2, ...):
  ///  - `h`: the same size in every direction;
  ///  - 2D: `h1 h2 [theta]`: M = R_theta D R_theta^-1, theta being the angle of the h1 direction;
  ///  - 3D: `h1 h2 h3 [theta] [phi]`: M = R_theta R_phi D R_phi^-1 R_theta^-1 with the rotations of [Paper] Eqs. (10),
  ///  (11):
  ///    the h1 direction is (cos theta cos phi, sin theta cos phi, -sin phi);
  ///  - `m11 m12 m22` (2D), `m11 m12 m22 m13 m23 m33` (3D): the tensor itself.
  /// Angles are radians and 0 unless assigned. Where a size is not positive the tensor is not a number.
  /// \return usage with the column of the mistake, or with the names that are missing or do not go together.
  static Expected<MetricField> from_formula(std::string_view text);
  /// The same tensor everywhere.
  static MetricField uniform(const SymTensor<Dim>& tensor);
  /// From tensors at the vertices of a background mesh, see discrete.h and nodal.h.
  static MetricField discrete(std::shared_ptr<const DiscreteMetric<Dim>> metric);

  /// The same field with all prescribed sizes multiplied by `factor` (> 0): M / factor^2.
  [[nodiscard]] MetricField scaled(double factor) const;
  /// The same field with sizes that do not fall below `size` >= 0, in the unit of the coordinates: (M^-1 + size^2 I)^-1,
  /// of which each size is sqrt(h^2 + size^2) and the directions are those of M.
  [[nodiscard]] MetricField floored(double size) const;

  /// For loops that ask again and again and do not need the last digit: a field from a background in space, through an
  /// octree that is within 2e-3 of its sizes (size_octree.h); any other field as it is.
  [[nodiscard]] MetricField approximated() const;

  /// Tensors at many points at once: the fast way. \pre out.size() >= points.size(). Does not allocate.
  void evaluate(std::span<const Point<Dim>> points, std::span<SymTensor<Dim>> out) const;
  [[nodiscard]] SymTensor<Dim> evaluate(const Point<Dim>& point) const;
  /// The same on lanes 0 .. count - 1, for callers that integrate. \pre 1 <= count <= kLanes
  void evaluate(const PointLanes<Dim>& points, int count, TensorLanes<Dim>& out) const;

  /// Checks that the tensor is finite and positive definite at each point.
  /// \return bad_input naming the first point where it is not.
  [[nodiscard]] Status check(std::span<const Point<Dim>> points) const;

  /// Relative error below which integrals of the field mean nothing: 0 for formulas. A field from a background has a
  /// kink wherever two of its simplices meet; to close in on each would be dear and for nothing.
  [[nodiscard]] double accuracy() const { return approximate_ ? 1e-3 : (discrete_ ? 1e-5 : 0.0); }

 private:
  void look_up(const PointLanes<Dim>& points, int count, TensorLanes<Dim>& out) const;

  std::shared_ptr<const Program> program_;  ///< one of these two
  std::shared_ptr<const DiscreteMetric<Dim>> discrete_;
  std::shared_ptr<const SizeOctree> octree_;  ///< of discrete_, in space
  bool approximate_ = false;                  ///< read octree_ where it has a piece
  double scale_ = 1.0;  ///< of the tensor
  double floor_ = 0.0;  ///< least size, before that
};

}  // namespace pillowmesh
