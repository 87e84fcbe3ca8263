// Doubling a whole row of quads.
#pragma once

#include "pillowmesh/mesh/cavity.h"
#include "pillowmesh/mesh/chord.h"

namespace pillowmesh {

/// Plans to split every quad of the chord in two along the chord: a vertex is put in the middle of each rung, on the
/// boundary curve where the rung lies on one. A quad where the chord crosses itself becomes four.
/// \return false where regions meet in it. Cost: its length.
bool plan_chord_split(const Mesh<2>& mesh, const Chord& chord, Cavity& cavity);

}  // namespace pillowmesh
