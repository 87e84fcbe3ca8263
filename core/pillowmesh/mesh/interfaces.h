// Where regions of cells meet inside the domain.
#pragma once

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// The number of facets between cells of different regions that are not frozen. Every cell keeps its region, but vertices
/// on such facets move like all others inside: the interface does not stay where it was. Cost: linear where there are
/// several regions.
template <int Dim>
Index free_interface_facets(const Mesh<Dim>& mesh);

}  // namespace pillowmesh
