// Problems with known solutions: an interior shock, a boundary layer, a singular corner.
#pragma once

#include <pillowmesh/mesh/mesh.h>

#include <string>
#include <vector>

#include "q1.h"

namespace solver {

struct Known {
  std::string name, title;
  Problem<2> problem;
  std::function<double(const Point<2>&)> exact;
  std::string (*mesh)(int n);  ///< a primitive of n cells on the longest side
};

/// shock: tanh(60 (x - .5 - .1 sin 2 pi y)) on the unit square, Poisson's equation.
/// layer: advection along (1, 1) with diffusion .01, layers at x = 1 and y = 1.
/// corner: r^(2/3) sin(2/3 angle) at the re-entrant corner of an L, Laplace's equation.
std::vector<Known> known_problems();

}  // namespace solver
