// Irregular vertices: where the mesh is not locally a grid.
#pragma once

#include <vector>

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// 1 for each vertex inside the domain that is irregular: other than four quads at it (2D), or an edge at it with other
/// than four hexes (3D). Vertices on the boundary and unused ones are 0. Cost: linear.
template <int Dim>
std::vector<unsigned char> irregular_vertices(const Mesh<Dim>& mesh);

}  // namespace pillowmesh
