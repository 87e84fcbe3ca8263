// A metric tensor per point of the domain.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/expression.h"
#include "pillowmesh/metric/tensor.h"

namespace pillowmesh {

/// The metric field. A value: cheap to copy, immutable, safe to read from several threads.
template <int Dim>
class MetricField {
 public:
  /// From a formula (see expression.h): `h`, `h1 h2 theta`, `h1 h2 h3 [theta phi]`, or `m11 m12 m22 [m13 m23 m33]`.
  /// \return usage with the column of the mistake.
  static Expected<MetricField> from_formula(std::string_view text);
  /// The same tensor everywhere.
  static MetricField uniform(const SymTensor<Dim>& tensor);

  /// The same field with all prescribed sizes multiplied by `factor` (> 0): M / factor^2.
  [[nodiscard]] MetricField scaled(double factor) const;

  /// Tensors at many points at once: the fast way. \pre out.size() >= points.size(). Does not allocate.
  void evaluate(std::span<const Point<Dim>> points, std::span<SymTensor<Dim>> out) const;
  [[nodiscard]] SymTensor<Dim> evaluate(const Point<Dim>& point) const;

  /// Checks that the tensor is finite and positive definite at each point; names the first that is not.
  [[nodiscard]] Status check(std::span<const Point<Dim>> points) const;

 private:
  std::shared_ptr<const Program> program_;
  int form_ = 0;
  double scale_ = 1.0;
};

}  // namespace pillowmesh
