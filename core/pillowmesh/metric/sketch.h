// Sizes drawn by hand.
#pragma once

#include <span>

#include "pillowmesh/metric/nodal.h"

namespace pillowmesh {

/// One dab of a brush: inside of the radius the size that it states, growing geometrically to that of the paper at
/// twice the radius.
struct Dab {
  double x = 0.0, y = 0.0;
  double radius = 0.0;
  double size = 0.0;
  double angle = 0.0;    ///< radians: direction of the long side
  double stretch = 1.0;  ///< long side / short side (= size), at least 1
};

/// The metric of a list of dabs on the box from `low` to `high`: their intersection with the paper's size. A pure
/// function of its arguments: to undo a stroke, leave its dabs out. The order counts only where stretched dabs overlap.
/// \return bad_input that names the dab, from 1, whose numbers cannot be; `paper` is the size where nothing is drawn.
Expected<NodalMetric<2>> sketch_metric(std::span<const Dab> dabs, double paper, const Point<2>& low,
                                       const Point<2>& high);

}  // namespace pillowmesh
