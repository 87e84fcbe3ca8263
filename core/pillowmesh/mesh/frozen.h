// Vertices, edges, facets and cells that must be in the output exactly as they are in the input.
#pragma once

#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {

/// Freezes what the input requires and the groups that `names` lists: patches, regions, points and curves, by their names or
/// numbers; with them all that they consist of, down to the vertices. \pre the boundary is classified.
/// \return usage when there is no such group, bad_input when something required is not in the mesh. Cost: linear in what
/// is frozen, but for sorting it.
template <int Dim>
Status freeze(Mesh<Dim>& mesh, const MeshInput<Dim>& input, const std::vector<std::string>& names);

/// The input's lists of what is frozen, and frozen facets inside the domain with their groups; `renumbered` per vertex.
template <int Dim>
void list_frozen(const Mesh<Dim>& mesh, const std::vector<Index>& renumbered, MeshInput<Dim>& out);

/// Cost: nothing where nothing is frozen, or one of the vertices is not; else a binary search.
template <int Dim>
bool is_frozen_edge(const Mesh<Dim>& mesh, VertexId a, VertexId b);
/// In 2D a facet is an edge.
template <int Dim>
bool is_frozen_facet(const Mesh<Dim>& mesh, FacetCorners<Dim> vertices);
template <int Dim>
bool is_frozen_cell(const Mesh<Dim>& mesh, Corners<Dim> vertices);

template <int Dim>
bool is_frozen_edge(const Mesh<Dim>& mesh, CellEdge e) {
  const auto& cell = mesh.cells[e.cell];
  return mesh.frozen && is_frozen_edge(mesh, cell[Cell<Dim>::edge_from(e.edge)], cell[Cell<Dim>::edge_to(e.edge)]);
}

/// True if boundary facet f of cell c is frozen or, in 3D, has a frozen edge that no frozen facet of the boundary has: a
/// layer that the cell is in must leave the boundary there.
template <int Dim>
bool must_stay(const Mesh<Dim>& mesh, CellId c, int f);

/// True if every frozen edge, facet and cell among the old cells' is in the mesh as it is now.
template <int Dim>
bool frozen_remain(const Mesh<Dim>& mesh, const std::vector<Corners<Dim>>& old_cells);

}  // namespace pillowmesh
