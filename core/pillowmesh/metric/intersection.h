// Operations on tensors at one point: intersection of two metrics, bounds on sizes and anisotropy.
#pragma once

#include <limits>

#include "pillowmesh/metric/tensor.h"

namespace pillowmesh {

/// The metric that asks for what A and B ask for both: simultaneous reduction. In the basis in which both are diagonal
/// the larger entry counts, so that along each of its directions the size is the smaller one. Its unit ball lies in
/// both unit balls; where A and B commute it is the largest such. [P.-L. George, H. Borouchaki, Delaunay triangulation
/// and meshing, 1998; F. Alauzet, P. Frey, INRIA RR-4759, 2003] \pre both are positive definite
template <int Dim>
SymTensor<Dim> intersect(const SymTensor<Dim>& A, const SymTensor<Dim>& B);

/// True if A <= B: no direction is shorter in B. Decided by Sylvester's criterion on B - A, without eigenvalues.
template <int Dim>
bool dominated(const SymTensor<Dim>& A, const SymTensor<Dim>& B);

struct SizeBounds {
  double smallest = 0.0;  ///< size, in the unit of the coordinates
  double largest = std::numeric_limits<double>::infinity();
  double anisotropy = std::numeric_limits<double>::infinity();  ///< largest size / smallest size at a point, >= 1

  [[nodiscard]] bool any() const {
    return smallest > 0.0 || largest < std::numeric_limits<double>::infinity() ||
           anisotropy < std::numeric_limits<double>::infinity();
  }
};

/// Sizes cut to the bounds, directions kept; too much anisotropy is taken off the larger sizes.
template <int Dim>
SymTensor<Dim> bound_sizes(const SymTensor<Dim>& M, const SizeBounds& bounds);

}  // namespace pillowmesh
