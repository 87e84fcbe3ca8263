#include "pillowmesh/refine/side_partners.h"

#include <algorithm>

namespace pillowmesh {
namespace {

/// Where cells meet around a codimension-2 entity: a vertex in 2D (then a = b), an edge in 3D.
struct Hinge {
  VertexId a, b;
};

/// The entity in which facets f and g of cell c meet.
template <int Dim>
Hinge hinge_of(const Mesh<Dim>& mesh, CellId c, int f, int g) {
  using C = Cell<Dim>;
  const int corner = (C::facet_side(f) << C::facet_axis(f)) | (C::facet_side(g) << C::facet_axis(g));
  const VertexId a = mesh.cells[c][corner];
  if constexpr (Dim == 2) return {a, a};
  return {a, mesh.cells[c][corner | (1 << (3 - C::facet_axis(f) - C::facet_axis(g)))]};
}

/// The facet of cell c at the hinge that is not f.
template <int Dim>
int other_facet(const Mesh<Dim>& mesh, CellId c, int f, Hinge hinge) {
  using C = Cell<Dim>;
  const int ka = corner_of(mesh, c, hinge.a), kb = corner_of(mesh, c, hinge.b);
  int axis = 0;
  while (axis == C::facet_axis(f) || (((ka ^ kb) >> axis) & 1) != 0) ++axis;
  return C::facet(axis, (ka >> axis) & 1);
}

/// The last cell of a run around a hinge, its facet that ends the run, and its other facet at the hinge.
struct RunEnd {
  CellId cell;
  int facet;
  int entered;
};

/// Walks from cell c, away from its facet `from`, as long as cells are on the same side of the hull.
template <int Dim>
RunEnd end_of_run(const Mesh<Dim>& mesh, const Hull<Dim>& hull, CellId c, int from, Hinge hinge) {
  const bool inside = hull.in_set[c] != 0;
  while (true) {
    const int leave = other_facet(mesh, c, from, hinge);
    const HalfFacetId twin = mesh.twins[c][leave];
    if (twin < 0 || (hull.in_set[mesh.cell_of(twin)] != 0) != inside) return {c, leave, from};
    c = mesh.cell_of(twin);
    from = mesh.facet_of(twin);
  }
}

/// The next hull facet around the hinge, or the boundary, through the shrink set.
template <int Dim>
NewCellSide across_inside(const Mesh<Dim>& mesh, const Hull<Dim>& hull, const HullFacet<Dim>& h, Hinge hinge) {
  const RunEnd end = end_of_run(mesh, hull, h.inside, h.facet, hinge);
  if (hull.is_hull(end.cell, end.facet)) return {end.cell, end.facet, kNone, end.entered};
  return {kNone, 0, mesh.patch_of(end.cell, end.facet)};
}

/// The same through the outside.
template <int Dim>
NewCellSide across_outside(const Mesh<Dim>& mesh, const Hull<Dim>& hull, const HullFacet<Dim>& h, Hinge hinge) {
  const RunEnd end = end_of_run(mesh, hull, h.outside, h.outside_facet, hinge);
  const HalfFacetId twin = mesh.twins[end.cell][end.facet];
  if (twin < 0) return {kNone, 0, ~twin};
  const CellId c = mesh.cell_of(twin);
  const int f = mesh.facet_of(twin);
  return {c, f, kNone, other_facet(mesh, c, f, hinge)};
}

}  // namespace

template <int Dim>
void find_side_partners(const Mesh<Dim>& mesh, const Hull<Dim>& hull, const CopyPlan<Dim>& plan,
                        std::vector<NewCellSide>& sides) {
  using C = Cell<Dim>;
  sides.clear();
  const auto kept_inside = [&](Hinge hinge) {
    const std::array<VertexId, 2> key{std::min(hinge.a, hinge.b), std::max(hinge.a, hinge.b)};
    return std::binary_search(plan.kept_inside.begin(), plan.kept_inside.end(), key);
  };
  for (const auto& h : hull.facets)
    for (int g = 0; g < C::facets; ++g) {
      if (C::facet_axis(g) == C::facet_axis(h.facet)) continue;
      const Hinge hinge = hinge_of(mesh, h.inside, h.facet, g);
      const bool outside = !plan.kept_inside.empty() && h.outside != kNone && kept_inside(hinge);
      sides.push_back(outside ? across_outside(mesh, hull, h, hinge) : across_inside(mesh, hull, h, hinge));
    }
}

template void find_side_partners(const Mesh<2>&, const Hull<2>&, const CopyPlan<2>&, std::vector<NewCellSide>&);
template void find_side_partners(const Mesh<3>&, const Hull<3>&, const CopyPlan<3>&, std::vector<NewCellSide>&);

}  // namespace pillowmesh
