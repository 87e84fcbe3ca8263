#include "pillowmesh/metric/intersection.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

/// S B S for symmetric S and B.
template <int Dim>
SymTensor<Dim> congruent(const SymTensor<Dim>& S, const SymTensor<Dim>& B) {
  double SB[Dim][Dim] = {};
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j)
      for (int k = 0; k < Dim; ++k) SB[i][j] += S(i, k) * B(k, j);
  SymTensor<Dim> out;
  for (int j = 0; j < Dim; ++j)
    for (int i = 0; i <= j; ++i)
      for (int k = 0; k < Dim; ++k) out(i, j) += SB[i][k] * S(k, j);
  return out;
}

}  // namespace

template <int Dim>
SymTensor<Dim> intersect(const SymTensor<Dim>& A, const SymTensor<Dim>& B) {
  // With R = A^(1/2): A = R I R and B = R N R, N = R^-1 B R^-1; in N's eigenvectors both are diagonal.
  Spectrum<Dim> a = spectrum(A);
  for (double& v : a.value) v = std::sqrt(v);
  const SymTensor<Dim> root = compose(a);
  for (double& v : a.value) v = 1.0 / v;
  Spectrum<Dim> n = spectrum(congruent(compose(a), B));
  if (n.value[Dim - 1] <= 1.0) return A;
  if (n.value[0] >= 1.0) return B;
  for (double& v : n.value) v = std::max(v, 1.0);
  return congruent(root, compose(n));
}

template <int Dim>
bool dominated(const SymTensor<Dim>& A, const SymTensor<Dim>& B) {
  const SymTensor<Dim> gap = B + (-1.0) * A;
  return gap.m[0] >= 0.0 && gap.m[2] >= 0.0 && gap.m[0] * gap.m[2] - gap.m[1] * gap.m[1] >= 0.0 &&
         (Dim == 2 || (gap(Dim - 1, Dim - 1) >= 0.0 && determinant(gap) >= 0.0));
}

template <int Dim>
SymTensor<Dim> bound_sizes(const SymTensor<Dim>& M, const SizeBounds& bounds) {
  const double most =
      bounds.smallest > 0.0 ? 1.0 / (bounds.smallest * bounds.smallest) : std::numeric_limits<double>::infinity();
  const double least = 1.0 / (bounds.largest * bounds.largest);
  Spectrum<Dim> s = spectrum(M);
  for (double& v : s.value) v = std::clamp(v, least, most);
  const double flattest = s.value[Dim - 1] / (bounds.anisotropy * bounds.anisotropy);
  for (double& v : s.value) v = std::max(v, flattest);
  return compose(s);
}

#define PILLOWMESH_INSTANTIATE(D)                                               \
  template SymTensor<D> intersect<D>(const SymTensor<D>&, const SymTensor<D>&); \
  template bool dominated<D>(const SymTensor<D>&, const SymTensor<D>&);         \
  template SymTensor<D> bound_sizes<D>(const SymTensor<D>&, const SizeBounds&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
