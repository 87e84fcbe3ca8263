// Formula expressions: parsed once, constants folded, evaluated over batches of points without allocation.
#pragma once

#include <memory>
#include <string_view>

#include "pillowmesh/mesh/status.h"

namespace pillowmesh {
/// A compiled formula.
class Program;
}  // namespace pillowmesh
