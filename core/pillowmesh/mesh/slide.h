// Boundary vertices slide on their curve or patch and never leave it.
#pragma once

#include "pillowmesh/mesh/boundary.h"

namespace pillowmesh {

/// The point of the vertex's curve or patch near `target`, found by walking from `anchor`, which is updated. Stops at
/// the ends of the curve or patch. Interior vertices: `target` itself.
/// \pre support.dim > 0, and anchor on the entity (a segment for curves in 3D, else a facet). Cost: the steps walked.
template <int Dim>
Point<Dim> slide(const Geometry<Dim>& geometry, VertexSupport support, Index& anchor, const Point<Dim>& target);

/// Where boundary vertex v can go: along its curve (the first, in 3D twice), or on its patch. Not of unit length; in 2D
/// the way of the facet that it is on, from its first vertex to its second.
/// \pre support[v].dim is between 0 and Dim.
template <int Dim>
std::array<Point<Dim>, Dim - 1> tangents(const Mesh<Dim>& mesh, VertexId v);

/// Anchor of a vertex that moves from where vertex `from` was onto the entity of `support`: the facet or segment of the
/// entity that touches or is nearest to `start`'s anchor. \return kNone when the entity is not next to it.
template <int Dim>
Index anchor_on(const Mesh<Dim>& mesh, VertexSupport support, VertexId from, const Point<Dim>& near);

}  // namespace pillowmesh
