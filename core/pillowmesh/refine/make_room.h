// Where a buffer layer does not fit at once: its vertices, and if need be those around, are moved until it does.
#pragma once

#include "pillowmesh/refine/buffer_layer.h"

namespace pillowmesh {

/// Untangles a layer that is connected but has cells inside out, with more and more freedom: the new vertices alone; those
/// of all cells that changed; then ring by ring those around them, so that no more of the old mesh moves than must.
/// Old vertices that were free to move are noted in `layer.moved` with where they were.
/// \param most_work how often the energy of a cell may be evaluated before it is given up.
/// \return whether every cell concerned is valid, its scaled Jacobian above `floor`. Cost: linear in the layer.
template <int Dim>
bool make_room(Mesh<Dim>& mesh, const Hull<Dim>& hull, double floor, std::int64_t most_work, BufferLayer<Dim>& layer);

}  // namespace pillowmesh
