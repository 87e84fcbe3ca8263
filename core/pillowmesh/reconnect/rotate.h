// Turning an edge inside the hexagon of its two quads.
#pragma once

#include "pillowmesh/mesh/cavity.h"

namespace pillowmesh {

/// Plans to turn the edge at `side` of cell c one place counterclockwise (way 0) or clockwise (way 1):
///
///      p---b---s          p---b---s          p---b---s
///      |   |   |          |   |   |          |    \  |
///      |   |   |    ->    |  /    |    or    |     \ |
///      q---a---r          q /  a  r          q   a  \r        and so on: b-a becomes q-s or p-r
///
/// \return false, with the cavity unspecified, where that is not legal: at the boundary, at the interface of two
/// regions, or where a boundary vertex would be left with too few quads. Cost: constant.
bool plan_rotation(const Mesh<2>& mesh, CellId c, int side, int way, Cavity& cavity);

}  // namespace pillowmesh
