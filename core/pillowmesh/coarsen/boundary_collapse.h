// Removing two boundary edges next to each other, and the rows that end there by joining them to one.
#pragma once

#include "pillowmesh/mesh/cavity.h"

namespace pillowmesh {

/// Plans to lay the boundary edges a-v and v-b on each other, which makes their two quads one. The two chords that ended
/// at these edges become one that turns around inside, so that a row need not be removed from boundary to boundary.
///
///      q----p----r           q-----p-----r
///      |    |    |     ->     \         /
///    --a----v----b--        ----\     /----                                                               .
///                                 \ /
///                                  v
///
/// Where a or b is a corner that one stays, else v.
/// \return false where it is not legal: v is no vertex of two cells on a curve, two corners or two regions would meet,
/// another cell would lose a side, a hole would close. Cost: linear in the valences of a and b.
bool plan_boundary_collapse(const Mesh<2>& mesh, VertexId v, Cavity& cavity);

}  // namespace pillowmesh
