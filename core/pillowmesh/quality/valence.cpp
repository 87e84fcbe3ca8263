#include "pillowmesh/quality/valence.h"

#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {
namespace {

template <int Dim>
std::vector<unsigned char> boundary_vertices(const Mesh<Dim>& mesh) {
  std::vector<unsigned char> marks(mesh.points.size(), 0);
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    for (int f = 0; mesh.alive(c) && f < Cell<Dim>::facets; ++f) {
      if (!mesh.on_boundary(c, f)) continue;
      for (const VertexId v : mesh.facet_vertices(c, f)) marks[v] = 1;
    }
  }
  return marks;
}

}  // namespace

template <int Dim>
std::vector<unsigned char> irregular_vertices(const Mesh<Dim>& mesh) {
  const std::vector<unsigned char> boundary = boundary_vertices(mesh);
  std::vector<unsigned char> irregular(mesh.points.size(), 0);
  if constexpr (Dim == 2) {
    std::vector<Index> quads(mesh.points.size(), 0);
    for (CellId c = 0; c < mesh.cell_count(); ++c) {
      for (int k = 0; mesh.alive(c) && k < Cell<2>::corners; ++k) ++quads[mesh.cells[c][k]];
    }
    for (std::size_t v = 0; v < quads.size(); ++v) irregular[v] = boundary[v] == 0 && quads[v] != 0 && quads[v] != 4;
  } else {
    std::vector<std::uint16_t> seen(mesh.cells.size(), 0);  // per cell: edges that a lower cell has
    for (CellId c = 0; c < mesh.cell_count(); ++c) {
      for (int e = 0; mesh.alive(c) && e < Cell<3>::edges; ++e) {
        if ((seen[c] >> e) & 1) continue;
        const VertexId ends[2] = {mesh.cells[c][Cell<3>::edge_from(e)], mesh.cells[c][Cell<3>::edge_to(e)]};
        if (boundary[ends[0]] != 0 && boundary[ends[1]] != 0) continue;
        int hexes = 0;
        for_each_cell_at_edge(mesh, CellEdge{c, e}, [&](CellId n, int f) {
          seen[n] |= static_cast<std::uint16_t>(1u << f);
          ++hexes;
        });
        if (hexes == 4) continue;
        for (const VertexId v : ends) irregular[v] = boundary[v] == 0 ? 1 : irregular[v];
      }
    }
  }
  return irregular;
}

template std::vector<unsigned char> irregular_vertices<2>(const Mesh<2>&);
template std::vector<unsigned char> irregular_vertices<3>(const Mesh<3>&);

}  // namespace pillowmesh
