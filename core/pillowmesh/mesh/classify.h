// Splits the boundary into patches, curves and corners, and says where each vertex lives.
#pragma once

#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {

/// Fills patch numbers in `twins`, `patch_groups`, `support`, `anchor` and `geometry` of a connected, valid mesh.
template <int Dim>
void classify_boundary(Mesh<Dim>& mesh, const MeshInput<Dim>& input, const BoundaryOptions& options);

/// 3D: true if the edge lies on the boundary between two different patches. Cost: one walk around the edge.
inline bool is_feature_edge(const Mesh<3>& mesh, CellEdge edge) {
  PatchId found = kNone;
  bool feature = false;
  for_each_cell_at_edge(mesh, edge, [&](CellId c, int e) {
    const int axis = Cell<3>::edge_axis(e), from = Cell<3>::edge_from(e);
    for (int d = 0; d < 3; ++d) {
      const int f = Cell<3>::facet(d, (from >> d) & 1);
      if (d == axis || !mesh.on_boundary(c, f)) continue;
      feature = feature || (found != kNone && found != mesh.patch_of(c, f));
      found = mesh.patch_of(c, f);
    }
  });
  return feature;
}

}  // namespace pillowmesh
