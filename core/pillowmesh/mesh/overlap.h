// Meshes that lie over themselves although no corner is inverted.
#pragma once

#include "pillowmesh/mesh/ordered_star.h"

namespace pillowmesh {

/// Whether the cells of a star overlap, although each has a positive corner at v: inside they go around it more than once, on the
/// boundary the last has turned past the first. \pre their corners at v are positive
bool overlaps(const Mesh<2>& mesh, VertexId v, const OrderedStar& star);

/// Whether a boundary edge at v goes back on the curve that v is on, a right angle or more from its direction there: a hole that has
/// shrunk to a slit is covered by cells, which overlap nowhere near it. No for other vertices, and at corners.
bool goes_back(const Mesh<2>& mesh, VertexId v, const OrderedStar& star);

/// Either of them at v, where fewer than OrderedStar::most cells meet. Cost: linear in the valence.
bool folded_at(const Mesh<2>& mesh, VertexId v);

}  // namespace pillowmesh
