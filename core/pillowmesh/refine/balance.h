// Balancing: tags spread so that layers end on fewer cells. [Paper] section 4, "similar to quadtree balancing".
#pragma once

#include <span>

#include "pillowmesh/refine/edge_tags.h"

namespace pillowmesh {

/// If more than two of the four edges of a quadrilateral are tagged then all of them are: of the cell in 2D, of each
/// facet of the cell in 3D. Repeats until nothing changes. `touched`: the cells to begin with (those whose tags
/// changed). Cost: linear in the cells that change.
/// \return the number of edges tagged.
template <int Dim>
Index balance_tags(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, std::span<const CellId> touched);

}  // namespace pillowmesh
