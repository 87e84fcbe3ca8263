// Splitting a boundary vertex in three: two boundary edges more, and a row that ends at each.
#pragma once

#include "pillowmesh/mesh/cavity.h"

namespace pillowmesh {

/// Plans what coarsen/boundary_collapse takes back: boundary vertex v becomes a, v and b, and cell c, which has its i-th
/// vertex (counterclockwise) there, two cells.
///
///      q-----p-----r          q----p----r
///       \         /     ->    |    |    |
///    ----\       /----      --a----v----b--                                                               .
///         \     /
///            v
///
/// A corner stays in its place as a, or as b where `turned`.
/// \return false where it is not legal: v inside, regions meet, a or b would be left with too few cells. Cost: linear in
/// the valence of v.
bool plan_boundary_opening(const Mesh<2>& mesh, CellId c, int i, bool turned, Cavity& cavity);

}  // namespace pillowmesh
