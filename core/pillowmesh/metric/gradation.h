// Limits how fast sizes grow from vertex to vertex of a background.
#pragma once

#include <cstdint>

#include "pillowmesh/metric/nodal.h"

namespace pillowmesh {

/// Makes sizes grow by at most the factor `growth` (> 1) across one cell: at the other end q of each edge pq the metric
/// is at least that of p grown along the edge,
///
///     sizes h_i(p) * (1 + |pq| ln(growth) / h_i(p))^(1/8) * (1 + l_p(pq) ln(growth))^(7/8),
///
/// the mixed-space law, which keeps the shape and direction of stretched cells where growth in physical space makes
/// them round. [F. Alauzet, Size gradation control of anisotropic meshes, Finite Elements in Analysis and Design 46
/// (2010)] Where it is not, the metric at q is intersected with the grown one, the finest vertices first.
///
/// It ends: a vertex is changed only when the grown metric exceeds its own by 1 %, so that each change multiplies det M
/// by more than 1, while no eigenvalue exceeds the largest of the input, which det M is thereby bounded by. Should
/// rounding spoil that, a vertex takes that eigenvalue in all directions after 200 changes. Nothing is left to change
/// then: applied again it does nothing. Sizes only shrink. \return the number of changes. Cost: n log n for fields that
/// are nearly graded.
template <int Dim>
std::int64_t limit_gradation(NodalMetric<Dim>& metric, double growth);

}  // namespace pillowmesh
