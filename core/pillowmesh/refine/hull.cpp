#include "pillowmesh/refine/hull.h"

#include "pillowmesh/mesh/frozen.h"

namespace pillowmesh {

template <int Dim>
void find_hull(const Mesh<Dim>& mesh, std::span<const CellId> shrink_set, std::span<const HalfFacetId> boundary_hull,
               Hull<Dim>& hull) {
  using C = Cell<Dim>;
  hull.facets.clear();
  hull.vertices.clear();
  if (hull.in_set.size() < mesh.cells.size()) {
    hull.in_set.resize(mesh.cells.size(), 0);
    hull.hull_sides.resize(mesh.cells.size(), 0);
  }
  if (hull.slot.size() < mesh.points.size()) hull.slot.resize(mesh.points.size(), kNone);
  for (const CellId c : shrink_set) hull.in_set[c] = 1;

  const auto add = [&](CellId c, int f) {
    HullFacet<Dim> h{c, static_cast<std::int8_t>(f), kNone, 0, kNone, mesh.facet_vertices(c, f), {}};
    const HalfFacetId twin = mesh.twins[c][f];
    if (twin >= 0) {
      h.outside = mesh.cell_of(twin);
      h.outside_facet = static_cast<std::int8_t>(mesh.facet_of(twin));
      for (int k = 0; k < C::facet_corners; ++k)
        h.outside_corner[k] = static_cast<std::int8_t>(corner_of(mesh, h.outside, h.vertices[k]));
    } else {
      h.patch = ~twin;
    }
    hull.hull_sides[c] |= static_cast<std::uint8_t>(1 << f);
    for (const VertexId v : h.vertices)
      if (hull.slot[v] == kNone) {
        hull.slot[v] = static_cast<Index>(hull.vertices.size());
        hull.vertices.push_back(v);
      }
    hull.facets.push_back(h);
  };
  for (const HalfFacetId h : boundary_hull) add(mesh.cell_of(h), mesh.facet_of(h));
  for (const CellId c : shrink_set)
    for (int f = 0; f < C::facets; ++f) {
      const CellId n = mesh.neighbour(c, f);
      if (n != kNone ? !hull.in_set[n] : !hull.is_hull(c, f) && must_stay(mesh, c, f)) add(c, f);
    }
}

template <int Dim>
void clear_hull(std::span<const CellId> shrink_set, Hull<Dim>& hull) {
  for (const CellId c : shrink_set) hull.in_set[c] = hull.hull_sides[c] = 0;
  for (const VertexId v : hull.vertices) hull.slot[v] = kNone;
}

template void find_hull(const Mesh<2>&, std::span<const CellId>, std::span<const HalfFacetId>, Hull<2>&);
template void find_hull(const Mesh<3>&, std::span<const CellId>, std::span<const HalfFacetId>, Hull<3>&);
template void clear_hull(std::span<const CellId>, Hull<2>&);
template void clear_hull(std::span<const CellId>, Hull<3>&);

}  // namespace pillowmesh
