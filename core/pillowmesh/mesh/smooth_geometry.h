// Curved boundaries from the polygon or the facets that the input has: --geometry smooth.
#pragma once

#include <memory>

#include "pillowmesh/mesh/boundary.h"

namespace pillowmesh {

/// The same boundary with curves for its chords: cubics through the vertices of the input with one tangent at each,
/// except at corners. The tangent is that of the circle through a vertex and its neighbours on the curve, so that arcs come
/// out to the sixth order and any smooth curve to the third. Where vertices are in line the line goes on to
/// the last of them. In 2D, runs that lie on a circle become arcs of it (mesh/circle_fit.h).
///
/// In 3D so the feature edges; the sides of the other facets have the tangent that lies in the plane of the vertex's mean
/// normal on its patch, and a facet is what Coons makes of its four sides: no gaps, one tangent plane at each vertex.
/// \return `geometry` itself if it is smooth already. Cost: linear.
template <int Dim>
std::shared_ptr<const Geometry<Dim>> smooth_geometry(std::shared_ptr<const Geometry<Dim>> geometry);

}  // namespace pillowmesh
