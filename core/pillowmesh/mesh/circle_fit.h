// Circles through runs of vertices.
#pragma once

#include <vector>

#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/chains.h"

namespace pillowmesh {

/// Vertices first to first + count - 1 of a chain, all on one circle. `count` - 1 pieces are arcs of it, in a closed chain
/// that is a circle altogether `count` of them.
struct CircleRun {
  Index first, count;
  Circle circle;
};

/// The circles in a chain, each as long as can be: runs of at least five vertices that lie on their least-squares circle
/// within 1e-6 of their shortest edge. Cost: linear but for a logarithm.
/// Source of the fit: Kasa, "A circle fitting procedure and its error analysis" (1976).
std::vector<CircleRun> find_circles(const std::vector<Point<2>>& points, const Chain& chain);

}  // namespace pillowmesh
