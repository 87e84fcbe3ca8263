// Scaled Jacobian: the Euclidean shape that solvers care about.
#pragma once

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// The least, over the corners, of the Jacobian of the edge vectors out of the corner divided by their lengths: in 2D
/// the sine of the corner angle. 1 for a rectangle or box, <= 0 if some corner is not convex. 0 where an edge has no
/// length. As verdict's scaled Jacobian, except that it does not look at the centre of a hexahedron.
template <int Dim>
double scaled_jacobian(const Mesh<Dim>& mesh, CellId c);

}  // namespace pillowmesh
