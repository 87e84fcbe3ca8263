// Removing a quad by merging two opposite vertices.
#pragma once

#include "pillowmesh/mesh/cavity.h"

namespace pillowmesh {

/// Plans to merge the i-th vertex of cell c (counterclockwise) into the opposite one. Of an interior and a boundary
/// vertex the boundary one stays.
///
///          k                 k
///        /   \              / \                                                                           .
///       x     y     ->     x   y   with the cells of d at k
///        \   /
///          d
///
/// \return false where it is not legal: d on the boundary, regions meeting at d, a neighbour left with too few cells.
/// Cost: linear in the valence of d.
bool plan_diagonal_collapse(const Mesh<2>& mesh, CellId c, int i, Cavity& cavity);

/// Plans to take out the interior vertex v of two cells, which share two sides: one cell is left.
bool plan_doublet_removal(const Mesh<2>& mesh, VertexId v, Cavity& cavity);

}  // namespace pillowmesh
