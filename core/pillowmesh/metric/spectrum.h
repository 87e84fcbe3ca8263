// Eigenvalues and eigenvectors of symmetric tensors, and functions of tensors through them.
#pragma once

#include <array>

#include "pillowmesh/metric/tensor.h"

namespace pillowmesh {

/// value[0] <= value[1] ...; vector[i], of length 1, belongs to value[i].
template <int Dim>
struct Spectrum {
  std::array<double, Dim> value;
  std::array<Point<Dim>, Dim> vector;
};

/// By Jacobi's rotations, without transcendental functions: the same bits everywhere. Orthonormal to rounding however
/// close the eigenvalues are. Not a number where M is not.
template <int Dim>
Spectrum<Dim> spectrum(const SymTensor<Dim>& M);

/// The tensor with that spectrum: the sum of value[i] vector[i] vector[i]'.
template <int Dim>
SymTensor<Dim> compose(const Spectrum<Dim>& s);

/// The tensor with the same eigenvectors and the eigenvalues f(value).
template <int Dim, class F>
SymTensor<Dim> map_eigenvalues(const SymTensor<Dim>& M, F f) {
  Spectrum<Dim> s = spectrum(M);
  for (double& v : s.value) v = f(v);
  return compose(s);
}

/// The matrix logarithm. \pre M is positive definite
template <int Dim>
SymTensor<Dim> log_tensor(const SymTensor<Dim>& M);

/// The matrix exponential: positive definite, the inverse of log_tensor. Relative error, of the largest entry: a few
/// times 1e-15 (1 + |L|).
template <int Dim>
SymTensor<Dim> exp_tensor(const SymTensor<Dim>& L);

/// True where M is finite and positive definite (Sylvester's criterion).
template <int Dim>
bool positive_definite(const SymTensor<Dim>& M);

}  // namespace pillowmesh
