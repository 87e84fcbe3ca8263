// The arithmetic of each formula operation on one number; shared by constant folding and by programs.
#pragma once

#include <cmath>
#include <limits>

#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh::operations {

// Comparisons rather than fmin, fmax: one instruction each, vectorised. With a NaN the result is b.
inline double minimum(double a, double b) { return a < b ? a : b; }
inline double maximum(double a, double b) { return a > b ? a : b; }
inline double truth(bool b) { return b ? 1.0 : 0.0; }

// Quotients are taken whether needed or not: with a branch around them loops do not vectorise.

// atan2(0, 0) = 0, whose cosine is 1.
inline double cosine_of_arc(double x, double radius) {
  const double quotient = x / radius;
  return radius == 0.0 ? 1.0 : quotient;
}
inline double sine_of_arc(double y, double radius) {
  const double quotient = y / radius;
  return radius == 0.0 ? 0.0 : quotient;
}

inline double size_to_metric(double h) {
  const double size = h > 0.0 ? h : std::numeric_limits<double>::quiet_NaN();
  return 1.0 / (size * size);
}

}  // namespace pillowmesh::operations
