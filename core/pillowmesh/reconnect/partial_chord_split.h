// Putting a row of quads along a path of edges inside the mesh.
#pragma once

#include <vector>

#include "pillowmesh/mesh/cavity.h"

namespace pillowmesh {

/// Plans to open the interior vertices of a path, whose ends stay whole, and to fill the slit with a row of as many quads:
/// what coarsen/partial_chord_collapse takes back. The row's rungs run from the i-th vertex left of the path to the next
/// one at its right (way 0), or the other way round (way 1); straight ones would leave a triangle at each end. Drawn with
/// three edges:
///
///                                     v1-----v2
///      a-----1-----2-----b    ->    /    \      \                                                          .
///                                  a      \      b
///                                    \     w2  /
///                                     w1-----/        (way 0)
///
/// Two edges alone are an opening.
/// \return false where it is not legal: fewer than two edges, a vertex twice, one but the ends on the boundary, regions
/// meet, or a vertex with fewer than three cells would result. Cost: the cells at the path.
bool plan_partial_chord_split(const Mesh<2>& mesh, const std::vector<VertexId>& path, int way, Cavity& cavity);

}  // namespace pillowmesh
