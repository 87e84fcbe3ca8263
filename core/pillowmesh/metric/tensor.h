// Symmetric positive-definite tensors: the metric at a point.
#pragma once

#include <array>

#include "pillowmesh/mesh/ids.h"

namespace pillowmesh {

/// Symmetric Dim x Dim matrix, packed m11 m12 m22 [m13 m23 m33]: the upper triangle by columns, Medit's order.
/// As a metric its unit is 1 / length^2.
template <int Dim>
struct SymTensor {
  static constexpr int size = Dim * (Dim + 1) / 2;
  std::array<double, size> m{};

  /// Position of entry (i, j) in the packing.
  static constexpr int at(int i, int j) { return i <= j ? j * (j + 1) / 2 + i : i * (i + 1) / 2 + j; }
  [[nodiscard]] double operator()(int i, int j) const { return m[at(i, j)]; }
  double& operator()(int i, int j) { return m[at(i, j)]; }

  static SymTensor isotropic(double size) {
    SymTensor t;
    for (int i = 0; i < Dim; ++i) t(i, i) = 1.0 / (size * size);
    return t;
  }
  friend SymTensor operator+(SymTensor a, const SymTensor& b) {
    for (int i = 0; i < size; ++i) a.m[i] += b.m[i];
    return a;
  }
  friend SymTensor operator*(double s, SymTensor a) {
    for (double& v : a.m) v *= s;
    return a;
  }
  friend bool operator==(const SymTensor&, const SymTensor&) = default;
};

/// u' M v
template <int Dim>
inline double dot(const SymTensor<Dim>& M, const Point<Dim>& u, const Point<Dim>& v) {
  double sum = 0.0;
  for (int i = 0; i < Dim; ++i) {
    double row = 0.0;
    for (int j = 0; j < Dim; ++j) row += M(i, j) * v[j];
    sum += u[i] * row;
  }
  return sum;
}

template <int Dim>
inline double determinant(const SymTensor<Dim>& M) {
  if constexpr (Dim == 2) {
    return M.m[0] * M.m[2] - M.m[1] * M.m[1];
  } else {
    const double a = M.m[0], b = M.m[1], c = M.m[2], d = M.m[3], e = M.m[4], f = M.m[5];
    return a * (c * f - e * e) - b * (b * f - e * d) + d * (b * e - c * d);
  }
}

/// det M M^-1
template <int Dim>
inline SymTensor<Dim> adjugate(const SymTensor<Dim>& M) {
  if constexpr (Dim == 2) {
    return {{M.m[2], -M.m[1], M.m[0]}};
  } else {
    const double a = M.m[0], b = M.m[1], c = M.m[2], d = M.m[3], e = M.m[4], f = M.m[5];
    return {{c * f - e * e, d * e - b * f, a * f - d * d, b * e - c * d, b * d - a * e, a * c - b * b}};
  }
}

}  // namespace pillowmesh
