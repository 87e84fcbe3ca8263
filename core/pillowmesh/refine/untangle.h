// Finds places for new vertices where simple ones fail: around bent or mixed convex and re-entrant hulls.
#pragma once

#include <span>
#include <vector>

#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {

/// Moves `vertices`, those on the boundary along it, until every corner Jacobian of the cells at them is positive; other
/// vertices and corners of the domain stay. Descends on sum T^(Dim/2) / chi(d), with T the sum of a corner's squared
/// edge lengths, d its Jacobian and chi(d) = (d + sqrt(d^2 + 4 delta^2)) / 2, which sees across inversion (Escobar et
/// al., "Simultaneous untangling and smoothing of tetrahedral meshes", 2003).
/// \return whether it succeeded; if not, the vertices are left where they ended. Cost: at most `sweeps` visits of each.
template <int Dim>
bool untangle(Mesh<Dim>& mesh, std::span<const VertexId> vertices, int sweeps = 60);

}  // namespace pillowmesh
