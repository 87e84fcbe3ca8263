// The numbers of vertices and cells: giving up those of dead ones.
#pragma once

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// Gives the mesh room for so many vertices and cells; what lies beyond is dropped.
template <int Dim>
void resize(Mesh<Dim>& mesh, Index vertices, Index cells);

/// Renumbers cells and vertices so that there is none that is dead or unused; their order stays. Cost: linear.
template <int Dim>
void compact(Mesh<Dim>& mesh);

}  // namespace pillowmesh
