// A portrait that is computed, for the case riemann: nothing to store, nothing to license.
#pragma once

#include "pillowmesh/metric/image.h"

namespace pillowmesh {

/// A bearded man in a dark coat, from a few dozen smooth shapes; brightness 0 to 1. \pre width, height >= 16
GrayImage portrait(int width, int height);

}  // namespace pillowmesh
