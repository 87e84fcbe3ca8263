// Metrics from second derivatives: of a formula, or recovered from values at vertices.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "pillowmesh/metric/nodal.h"
#include "pillowmesh/metric/program.h"

namespace pillowmesh {

struct HessianOptions {
  /// The norm L^p in which the interpolation error is made small for the number of cells, at least 1. Small p lets weak
  /// features have their share; with 1e100 or more, the maximum norm, only the strongest count.
  double norm = 2.0;
  /// The interpolation error in that norm, for elements of degree 1; 0: not given, the number of cells is.
  double error = 0.0;
  /// Curvatures below this share of the largest one count as that: sizes differ by at most its inverse square root.
  double floor = 1e-4;
};

/// The Hessian of a formula over x, y, z, by automatic differentiation.
template <int Dim>
class FormulaHessian {
 public:
  /// `text`: an expression, or statements that assign `f`. \return usage with the column of the mistake
  static Expected<FormulaHessian> from_formula(std::string_view text);
  /// Second derivatives at many points; not a number where there are none.
  void evaluate(std::span<const Point<Dim>> points, std::span<SymTensor<Dim>> out) const;

 private:
  explicit FormulaHessian(Program program) : program_(std::move(program)) {}
  Program program_;
};

/// The metric of the Hessian of a formula on a box, sampled (sample.h). \return bad_input when the function has no
/// finite curvature anywhere, or no curvature at all.
template <int Dim>
Expected<NodalMetric<Dim>> hessian_metric(const FormulaHessian<Dim>& hessian, const Point<Dim>& low,
                                          const Point<Dim>& high, const HessianOptions& options);

/// Hessians at the vertices of a background of a function that is known there: a quadratic polynomial is fitted to the
/// values at the vertices nearby, two rings or more, by least squares (Householder's QR) in coordinates in which the
/// patch is round. Exact for quadratic functions, at the boundary too; for smooth ones of first order in the size of
/// the patch, of second where it is symmetric. Zero where the vertices around determine no quadratic. Cost: linear.
template <int Dim>
std::vector<SymTensor<Dim>> recover_hessian(std::span<const Point<Dim>> points, std::span<const Simplex<Dim>> simplices,
                                            std::span<const double> values);

/// Replaces Hessians H by metrics: M = k det(|H|)^(-1/(2p+n)) |H|. With `error` = E given,
/// k = n / (8 E) (integral of det(|H|)^(p/(2p+n)))^(1/p), by which the error of multilinear interpolation on unit cells
/// along the eigenvectors is E in the norm L^p; else k = 1. Hessians that are not finite count as zero. [A. Loseille,
/// F. Alauzet, Continuous mesh framework II, SIAM J. Numer. Anal. 49 (2011), Eq. (4.12)] \return bad_input when all
/// Hessians are zero: the function is linear, every mesh is as good.
template <int Dim>
Status multiscale_metric(NodalMetric<Dim>& hessians, const HessianOptions& options);

}  // namespace pillowmesh
