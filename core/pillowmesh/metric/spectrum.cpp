#include "pillowmesh/metric/spectrum.h"

#include <cmath>
#include <utility>

#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh {

template <int Dim>
Spectrum<Dim> spectrum(const SymTensor<Dim>& M) {
  SymTensor<Dim> A = M;
  Spectrum<Dim> s;
  for (int i = 0; i < Dim; ++i) s.vector[i] = Point<Dim>::Unit(i);
  // Cyclic Jacobi converges quadratically: one rotation is exact in 2D, five sweeps are more than enough in 3D.
  constexpr int kSweeps = Dim == 2 ? 2 : 8;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int p = 0; p < Dim; ++p) {
      for (int q = p + 1; q < Dim; ++q) {
        const double b = A(p, q);
        if (b == 0.0) continue;
        const double theta = 0.5 * (A(q, q) - A(p, p)) / b;
        const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), sn = t * c;
        A(p, p) -= t * b;
        A(q, q) += t * b;
        A(p, q) = 0.0;
        for (int r = 0; r < Dim; ++r) {
          if (r != p && r != q) {
            const double x = A(r, p), y = A(r, q);
            A(r, p) = c * x - sn * y;
            A(r, q) = sn * x + c * y;
          }
          const double u = s.vector[p][r], v = s.vector[q][r];
          s.vector[p][r] = c * u - sn * v;
          s.vector[q][r] = sn * u + c * v;
        }
      }
    }
  }
  for (int i = 0; i < Dim; ++i) s.value[i] = A(i, i);
  for (int i = 1; i < Dim; ++i) {
    for (int j = i; j > 0 && s.value[j] < s.value[j - 1]; --j) {
      std::swap(s.value[j], s.value[j - 1]);
      std::swap(s.vector[j], s.vector[j - 1]);
    }
  }
  return s;
}

template <int Dim>
SymTensor<Dim> compose(const Spectrum<Dim>& s) {
  SymTensor<Dim> M;
  for (int j = 0; j < Dim; ++j)
    for (int i = 0; i <= j; ++i)
      for (int k = 0; k < Dim; ++k) M(i, j) += s.value[k] * s.vector[k][i] * s.vector[k][j];
  return M;
}

template <int Dim>
SymTensor<Dim> log_tensor(const SymTensor<Dim>& M) {
  return map_eigenvalues(M, [](double v) { return portable::log(v); });
}

template <int Dim>
SymTensor<Dim> exp_tensor(const SymTensor<Dim>& L) {
  return map_eigenvalues(L, [](double v) { return portable::exp(v); });
}

template <int Dim>
bool positive_definite(const SymTensor<Dim>& M) {
  for (const double v : M.m) {
    if (!std::isfinite(v)) return false;
  }
  if (!(M.m[0] > 0.0) || !(M.m[0] * M.m[2] - M.m[1] * M.m[1] > 0.0)) return false;
  return Dim == 2 || determinant(M) > 0.0;
}

#define PILLOWMESH_INSTANTIATE(D)                             \
  template Spectrum<D> spectrum<D>(const SymTensor<D>&);      \
  template SymTensor<D> compose<D>(const Spectrum<D>&);       \
  template SymTensor<D> log_tensor<D>(const SymTensor<D>&);   \
  template SymTensor<D> exp_tensor<D>(const SymTensor<D>&);   \
  template bool positive_definite<D>(const SymTensor<D>&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
