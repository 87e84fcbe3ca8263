#include "pillowmesh/refine/tag_inheritance.h"

namespace pillowmesh {

template <int Dim>
void inherit_tags(const Mesh<Dim>& mesh, const BufferLayer<Dim>& layer, std::span<const HullFacet<Dim>> facets,
                  EdgeTags<Dim>& tags) {
  using C = Cell<Dim>;
  using Mask = typename EdgeTags<Dim>::Mask;
  tags.mask.resize(mesh.cells.size(), 0);
  for (Index i = 0; i < layer.cell_count; ++i) {
    const auto& h = facets[i];
    const Mask on_hull = tags.mask[h.inside] & facet_edges<Dim>(h.facet);
    Mask mask = on_hull;  // the outer copies, numbered as in the inside cell
    for (int e = 0; e < C::edges; ++e)
      if ((on_hull >> e) & 1)  // the inner copies: the same edge on the other side
        mask |= static_cast<Mask>(1u << C::edge_at(C::edge_from(e) ^ (1 << C::facet_axis(h.facet)), C::edge_axis(e)));
    tags.mask[layer.first_cell + i] = mask;
  }
  // Corner edges: two hull facets of one cell that share an edge (2D: a vertex). The inside cell names the inner copies.
  for (Index i = 0; i < layer.cell_count; ++i) {
    const auto& h = facets[i];
    const CellId k = layer.first_cell + i;
    const int a = C::facet_axis(h.facet);
    for (int g = 0; g < C::facets; ++g) {
      const int b = C::facet_axis(g);
      if (b == a || mesh.twins[h.inside][g] < 0) continue;
      const CellId other = mesh.neighbour(h.inside, g);
      if (other < layer.first_cell || other == k) continue;  // not hull
      for (int e = 0; e < C::edges; ++e)
        if (C::edge_axis(e) == b && C::corner_on_facet(C::edge_from(e), h.facet) && tags.has(h.inside, e))
          clear_tag(mesh, tags, {h.inside, e});
    }
  }
}

template void inherit_tags(const Mesh<2>&, const BufferLayer<2>&, std::span<const HullFacet<2>>, EdgeTags<2>&);
template void inherit_tags(const Mesh<3>&, const BufferLayer<3>&, std::span<const HullFacet<3>>, EdgeTags<3>&);

}  // namespace pillowmesh
