#include "pillowmesh/mesh/compact.h"

namespace pillowmesh {

template <int Dim>
void resize(Mesh<Dim>& mesh, Index vertices, Index cells) {
  mesh.cells.resize(cells);
  mesh.twins.resize(cells);
  mesh.region.resize(cells);
  mesh.points.resize(vertices);
  mesh.vertex_cell.resize(vertices, kNone);
  mesh.support.resize(vertices);
  mesh.anchor.resize(vertices, kNone);
}

template <int Dim>
void compact(Mesh<Dim>& mesh) {
  std::vector<Index> cell(mesh.cells.size(), kNone), vertex(mesh.points.size(), kNone);
  Index cells = 0, vertices = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    if (mesh.alive(c)) cell[c] = cells++;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.vertex_cell[v] != kNone) vertex[v] = vertices++;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    const Index n = cell[c];
    if (n == kNone) continue;
    for (int k = 0; k < Cell<Dim>::corners; ++k) mesh.cells[n][k] = vertex[mesh.cells[c][k]];
    for (int f = 0; f < Cell<Dim>::facets; ++f) {
      const HalfFacetId t = mesh.twins[c][f];
      mesh.twins[n][f] = t < 0 ? t : mesh.half_facet(cell[mesh.cell_of(t)], mesh.facet_of(t));
    }
    mesh.region[n] = mesh.region[c];
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const Index n = vertex[v];
    if (n == kNone) continue;
    mesh.points[n] = mesh.points[v];
    mesh.vertex_cell[n] = cell[mesh.vertex_cell[v]];
    mesh.support[n] = mesh.support[v];
    mesh.anchor[n] = mesh.anchor[v];
  }
  resize(mesh, vertices, cells);
  if (!mesh.frozen) return;
  // Frozen vertices live, and those that live keep their order: the lists stay sorted.
  auto frozen = std::make_shared<Frozen<Dim>>(*mesh.frozen);
  const auto renumber = [&](auto& list) {
    for (auto& vertices : list)
      for (VertexId& v : vertices) v = vertex[v];
  };
  renumber(frozen->edges);
  renumber(frozen->facets);
  renumber(frozen->cells);
  for (auto& facet : frozen->inner_facets)
    for (VertexId& v : facet.vertices) v = vertex[v];
  mesh.frozen = std::move(frozen);
}

template void resize(Mesh<2>&, Index, Index);
template void resize(Mesh<3>&, Index, Index);
template void compact(Mesh<2>&);
template void compact(Mesh<3>&);

}  // namespace pillowmesh
