// Halving the sizes of an adapted quad mesh: every cell in four, divided where edges have the same metric length on both sides.
#pragma once

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/field.h"

namespace pillowmesh {

/// Dices every cell in four (refine/dice.h), and puts the new vertices into the metric middles of edges and cells, where that
/// leaves all cells valid. What could not be diced is returned as it came. Numbers as those of `dice`.
/// \pre no dead cells. Cost: linear; three evaluations of the metric an edge.
Status halve_sizes(Mesh<2>& mesh, const MetricField<2>& field);

}  // namespace pillowmesh
