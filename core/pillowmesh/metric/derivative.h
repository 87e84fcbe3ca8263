// Derivatives of formulas, as formulas: automatic differentiation of the graph.
#pragma once

#include "pillowmesh/metric/graph.h"

namespace pillowmesh {

/// The derivative of `value` with respect to coordinate `axis`, added to the graph; shared parts are computed once. Of
/// `if`, min, max and abs it is that of the side that counts; of floor and comparisons it is 0. Not a number where
/// there is none, as of sqrt at 0. Cost: linear in the graph.
NodeId differentiate(Graph& graph, NodeId value, int axis);

}  // namespace pillowmesh
