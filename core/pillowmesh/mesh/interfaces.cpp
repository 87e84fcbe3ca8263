#include "pillowmesh/mesh/interfaces.h"

#include "pillowmesh/mesh/frozen.h"

namespace pillowmesh {

template <int Dim>
Index free_interface_facets(const Mesh<Dim>& mesh) {
  if (mesh.region_groups.size() < 2) return 0;
  Index count = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    for (int f = 0; f < Cell<Dim>::facets; ++f) {
      const CellId n = mesh.neighbour(c, f);
      if (n > c && mesh.region[n] != mesh.region[c] && !is_frozen_facet(mesh, mesh.facet_vertices(c, f))) ++count;
    }
  }
  return count;
}

template Index free_interface_facets(const Mesh<2>&);
template Index free_interface_facets(const Mesh<3>&);

}  // namespace pillowmesh
