// Removing a whole row of quads: with chord_split the only change that alters the number of boundary edges.
#pragma once

#include "pillowmesh/mesh/cavity.h"
#include "pillowmesh/mesh/chord.h"

namespace pillowmesh {

/// Plans to merge the vertices of every rung of the chord: all that are joined by rungs become one. Where the chord
/// crosses or touches itself these are more than two. A corner or boundary vertex stays where it is; two of one curve
/// merge in their middle.
/// \return false where it is not legal: rungs join two corners, two curves, or boundary vertices across the inside;
/// another cell would lose a side; regions meet. Cost: the cells at its rungs.
bool plan_chord_collapse(const Mesh<2>& mesh, const Chord& chord, Cavity& cavity);

}  // namespace pillowmesh
