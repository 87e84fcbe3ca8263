// Events as two flat arrays, the form in which they cross to JavaScript.
#pragma once

#include <cstdint>
#include <vector>

#include "pillowmesh/adapt/trace.h"

namespace pillowmesh {

/// Appends one event in the layout that c_api.h describes at pm_take_events.
template <int Dim>
void append_event(const Event<Dim>& event, std::vector<std::int32_t>& ints, std::vector<double>& doubles);

}  // namespace pillowmesh
