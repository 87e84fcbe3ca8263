// Removing a whole row of quads: with chord_split the only change that alters the number of boundary edges.
#pragma once

#include "pillowmesh/mesh/cavity.h"
#include "pillowmesh/mesh/chord.h"

namespace pillowmesh {

/// Plans to merge the two vertices of every rung of the chord. Corners and boundary vertices stay where they are; two of
/// one curve merge in their middle.
/// \return false where it is not legal: the chord crosses or touches itself, a rung joins two corners, two curves, or two
/// boundary vertices across the inside, or regions meet in it. Cost: the cells at its rungs.
bool plan_chord_collapse(const Mesh<2>& mesh, const Chord& chord, Cavity& cavity);

}  // namespace pillowmesh
