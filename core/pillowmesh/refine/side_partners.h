// What lies across the sides of the cells that a buffer layer adds: another new cell, or the domain's boundary.
#pragma once

#include <vector>

#include "pillowmesh/refine/vertex_copies.h"

namespace pillowmesh {

/// Neighbour across a side of a new cell: the new cell of another hull facet, or the boundary.
struct NewCellSide {
  CellId hull_cell;  ///< inside cell of the other hull facet; kNone: boundary
  int hull_facet;
  PatchId patch;
  int facet = 0;  ///< side of the other new cell
};

/// For every hull facet in turn, and each facet g of its inside cell that meets it: the partner of the new cell on that
/// side. Around the edge the next hull facet is found through the shrink set, or through the outside where the shrink set
/// is joined across the edge (pinched: 1 and 2 are partners, or 1 and 4):
///
///        O  1  S
///        2--+--4
///        S  3  O
///
/// \pre the adjacency is that from before the insertion. Cost: linear in the hull.
template <int Dim>
void find_side_partners(const Mesh<Dim>& mesh, const Hull<Dim>& hull, const CopyPlan<Dim>& plan,
                        std::vector<NewCellSide>& sides);

}  // namespace pillowmesh
