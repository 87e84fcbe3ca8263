#include "pillowmesh/smooth/quad_derivatives.h"

#include <algorithm>

namespace pillowmesh {

void add_shape(double a, const Point<2>* da, double b, const Point<2>* db, double diagonal, const Point<2>* dd,
               const EnergyWeights& weights, QuadDerivatives& sum) {
  const double L1 = a * a, L2 = b * b, D = diagonal * diagonal;
  const double eta2 = squared_shape(L1, L2, D), obtuse = 1.0 - eta2, lack = weights.shape_floor * weights.shape_floor - eta2;
  if (!(obtuse > 0)) return;
  double weight = 0.0, value = weights.obtuse * obtuse, slope = -weights.obtuse;
  if (lack > 0) weight = weights.shape, value += weights.shape * lack * lack, slope -= 2.0 * weights.shape * lack;
  const double g = 0.5 * (L1 + L2 - D), i = 1.0 / (L1 + L2 + D), det = L1 * L2 - g * g;
  const double common = 16.0 * i * i, spread = -2.0 * det * i;
  Point<2> d = Point<2>::Zero();
  if (da != nullptr) d += (common * (L2 - g + spread) * 2.0 * a) * *da;
  if (db != nullptr) d += (common * (L1 - g + spread) * 2.0 * b) * *db;
  if (dd != nullptr) d += (common * (g + spread) * 2.0 * diagonal) * *dd;
  sum.value += value;
  sum.gradient += slope * d;
  sum.xx += 2.0 * weight * d[0] * d[0];
  sum.xy += 2.0 * weight * d[0] * d[1];
  sum.yy += 2.0 * weight * d[1] * d[1];
}

Point<2> QuadDerivatives::step() const {
  const double mean = 0.5 * (xx + yy), diff = 0.5 * (xx - yy), root = std::sqrt(diff * diff + xy * xy);
  double l1 = std::abs(mean + root), l2 = std::abs(mean - root);
  const double floor = 1e-3 * std::max(l1, l2);
  if (!(floor > 0)) return Point<2>::Zero();
  l1 = std::max(l1, floor), l2 = std::max(l2, floor);
  // The part of the gradient along the first eigenvector u, by the projection u u'.
  double uxx = 1.0, uxy = 0.0;
  if (root > 0) uxx = 0.5 * (1.0 + diff / root), uxy = 0.5 * xy / root;
  const Point<2> along(uxx * gradient[0] + uxy * gradient[1], uxy * gradient[0] + (1.0 - uxx) * gradient[1]);
  return -(along / l1 + (gradient - along) / l2);
}

Point<2> QuadDerivatives::step_along(const Point<2>& t) const {
  const double h = std::abs(xx * t[0] * t[0] + 2 * xy * t[0] * t[1] + yy * t[1] * t[1]);
  return (h > 0 ? -t.dot(gradient) / h : 0.0) * t;
}

}  // namespace pillowmesh
