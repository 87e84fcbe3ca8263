// Dicing: every cell split in n^Dim. [Paper] section 4: the end of "coarse refinement".
#pragma once

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// Splits every cell of `mesh` in n^Dim by its multilinear map; new boundary vertices are brought onto the boundary.
/// The vertices of the mesh keep their numbers; cell c becomes cells c * n^Dim + i.
/// \return illegal, with the mesh unchanged, when a piece would turn inside out (a strongly bent boundary).
/// Cost: linear in the result; the adjacency is built anew.
template <int Dim>
Status dice(Mesh<Dim>& mesh, int n);

}  // namespace pillowmesh
