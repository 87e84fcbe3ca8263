// Splitting a vertex along two of its edges.
#pragma once

#include "pillowmesh/mesh/cavity.h"
#include "pillowmesh/mesh/ordered_star.h"

namespace pillowmesh {

/// Plans to open the interior vertex v along its spokes `first` and `last` (spoke k is the edge between the cells k - 1
/// and k of the star): the cells first ... last - 1 get a vertex of their own, and a quad fills the gap.
///
///           b                   b
///           |                 /   \                                                                        .
///        ---v---     ->    --v     w--
///           |                 \   /
///           a                   a
///
/// `star` is the star of v. \return false where it is not legal: on the boundary, where regions meet, or where a vertex
/// with fewer than three cells would result. Cost: linear in the valence.
bool plan_opening(const Mesh<2>& mesh, VertexId v, const OrderedStar& star, int first, int last, Cavity& cavity);

}  // namespace pillowmesh
