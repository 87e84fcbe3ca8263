// Removing part of a row of quads inside the mesh.
#pragma once

#include "pillowmesh/mesh/cavity.h"
#include "pillowmesh/mesh/chord.h"

namespace pillowmesh {

/// Plans to merge two opposite vertices of each of these cells, which follow each other in a chord: the right one it is
/// entered by and the left one it is left by (way 0), or the other two (way 1). All quads of the rest stay quads, so that
/// the row need not go from boundary to boundary; the vertices before and behind lose a cell each. The chord goes from
/// left to right:
///
///      a----m----n----o            a
///      |    |    |    |              \                                                                    .
///      |    |    |    |     ->        mx---ny---oz
///      |    |    |    |                           \                                                       .
///      x----y----z----b                            b       (way 0: x and m, y and n, z and o)
///
/// One cell alone is a diagonal collapse.
/// \return false where it is not legal: two boundary vertices would merge, vertices of different cells would, a cell
/// outside would lose a side, regions meet. Cost: the cells at the vertices that merge.
bool plan_partial_chord_collapse(const Mesh<2>& mesh, const std::vector<ChordCell>& part, int way, Cavity& cavity);

}  // namespace pillowmesh
