// Background meshes of metrics: any mesh file, triangles and tetrahedra too.
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/nodal.h"

namespace pillowmesh {

using AnyNodal = std::variant<NodalMetric<2>, NodalMetric<3>>;

/// Reads vertices and cells of a mesh file: the formats of io.h; triangles and tetrahedra from Medit's only. Quads and
/// hexahedra are divided into simplices. 3D if there is any tetrahedron or hexahedron. The vertices keep the numbers of
/// the file; there are no tensors yet.
/// \return bad_input: file and reason, e.g. that there are no cells.
Expected<AnyNodal> read_background(std::string_view name, std::span<const char> bytes);

}  // namespace pillowmesh
