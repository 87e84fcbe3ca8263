// Giving up the numbers of dead cells and unused vertices.
#pragma once

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// Renumbers cells and vertices so that there is none that is dead or unused; their order stays. Cost: linear.
template <int Dim>
void compact(Mesh<Dim>& mesh);

}  // namespace pillowmesh
