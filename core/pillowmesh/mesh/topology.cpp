#include "pillowmesh/mesh/topology.h"

#include <algorithm>

namespace pillowmesh {
namespace {

template <int Dim>
FacetCorners<Dim> sorted(FacetCorners<Dim> v) {
  std::sort(v.begin(), v.end());
  return v;
}

/// True if facets with the same vertices, seen from the two cells, go around in opposite directions.
template <int Dim>
bool opposite(const FacetCorners<Dim>& a, int sign_a, const FacetCorners<Dim>& b, int sign_b) {
  if constexpr (Dim == 2) {
    return (a[0] == b[0] ? 1 : -1) * sign_a * sign_b < 0;
  } else {
    constexpr int cycle[4] = {0, 1, 3, 2};
    int start = 0;
    while (b[cycle[start]] != a[0]) ++start;
    const bool forward = b[cycle[(start + 1) % 4]] == a[1];
    return (forward ? 1 : -1) * sign_a * sign_b < 0;
  }
}

/// True if the four vertices of two facets are cyclically the same, not merely the same set.
template <int Dim>
bool same_cycle(const FacetCorners<Dim>& a, const FacetCorners<Dim>& b) {
  if constexpr (Dim == 2) return true;
  // The diagonal partner of a vertex must be the same in both.
  for (int k = 0; k < Cell<Dim>::facet_corners; ++k) {
    int at = 0;
    while (b[at] != a[k]) ++at;
    if (b[at ^ 3] != a[k ^ 3]) return false;
  }
  return true;
}

}  // namespace

template <int Dim>
Status connect_cells(Mesh<Dim>& mesh) {
  using C = Cell<Dim>;
  const Index cells = mesh.cell_count(), vertices = mesh.vertex_count();
  mesh.twins.assign(cells, {});
  mesh.vertex_cell.assign(vertices, kNone);
  for (auto& t : mesh.twins) t.fill(~0);

  // Half-facets in buckets by their lowest vertex: a counting sort, then comparisons within a bucket.
  std::vector<Index> first(static_cast<std::size_t>(vertices) + 1, 0);
  const auto lowest = [&](CellId c, int f) {
    const auto v = mesh.facet_vertices(c, f);
    return *std::min_element(v.begin(), v.end());
  };
  for (CellId c = 0; c < cells; ++c) {
    if (!mesh.alive(c)) continue;
    for (const VertexId v : mesh.cells[c]) mesh.vertex_cell[v] = c;
    for (int f = 0; f < C::facets; ++f) ++first[lowest(c, f) + 1];
  }
  for (Index v = 0; v < vertices; ++v) first[v + 1] += first[v];
  std::vector<HalfFacetId> bucket(first[vertices]);
  std::vector<Index> fill(first.begin(), first.end() - 1);
  for (CellId c = 0; c < cells; ++c)
    if (mesh.alive(c))
      for (int f = 0; f < C::facets; ++f) bucket[fill[lowest(c, f)]++] = mesh.half_facet(c, f);

  for (Index v = 0; v < vertices; ++v) {
    for (Index i = first[v]; i < first[v + 1]; ++i) {
      const HalfFacetId a = bucket[i];
      const CellId ca = mesh.cell_of(a);
      const auto va = mesh.facet_vertices(ca, mesh.facet_of(a));
      const auto key = sorted<Dim>(va);
      for (Index j = i + 1; j < first[v + 1]; ++j) {
        const HalfFacetId b = bucket[j];
        const CellId cb = mesh.cell_of(b);
        const auto vb = mesh.facet_vertices(cb, mesh.facet_of(b));
        if (sorted<Dim>(vb) != key || ca == cb) continue;
        HalfFacetId& ta = mesh.twins[ca][mesh.facet_of(a)];
        HalfFacetId& tb = mesh.twins[cb][mesh.facet_of(b)];
        const std::string pair = "cells " + std::to_string(ca) + " and " + std::to_string(cb);
        if (ta >= 0 || tb >= 0)
          return Status::bad_input("more than two cells meet at one facet: " + pair + " and cell " +
                                   std::to_string(mesh.cell_of(ta >= 0 ? ta : tb)));
        if (!same_cycle<Dim>(va, vb))
          return Status::bad_input(pair + " share the four vertices of a facet in different order");
        if (!opposite<Dim>(va, facet_sign<Dim>(mesh.facet_of(a)), vb, facet_sign<Dim>(mesh.facet_of(b))))
          return Status::bad_input(pair + " lie on the same side of the facet they share: one is inside out or they overlap");
        ta = b;
        tb = a;
      }
    }
  }
  return {};
}

template <int Dim>
void vertex_star(const Mesh<Dim>& mesh, VertexId v, std::vector<CellCorner>& out) {
  using C = Cell<Dim>;
  out.clear();
  const CellId seed = mesh.vertex_cell[v];
  if (seed == kNone) return;
  out.push_back({seed, corner_of(mesh, seed, v)});
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto [c, corner] = out[i];
    for (int axis = 0; axis < Dim; ++axis) {
      const HalfFacetId twin = mesh.twins[c][C::facet(axis, (corner >> axis) & 1)];
      if (twin < 0) continue;
      const CellId n = mesh.cell_of(twin);
      bool known = false;
      for (std::size_t j = out.size(); j-- > 0 && !known;) known = out[j].cell == n;
      if (!known) out.push_back({n, corner_of(mesh, n, v)});
    }
  }
}

template <int Dim>
int edge_between(const Mesh<Dim>& mesh, CellId c, VertexId a, VertexId b) {
  const int ka = corner_of(mesh, c, a), kb = corner_of(mesh, c, b);
  if (ka < 0 || kb < 0) return -1;
  const int bit = ka ^ kb;
  for (int axis = 0; axis < Dim; ++axis)
    if (bit == 1 << axis) return Cell<Dim>::edge_at(ka, axis);
  return -1;
}

template <int Dim>
std::vector<std::array<VertexId, 2>> unique_edges(const Mesh<Dim>& mesh) {
  std::vector<std::array<VertexId, 2>> edges;
  edges.reserve(static_cast<std::size_t>(mesh.cell_count()) * Dim + Dim * 8);
  std::vector<std::uint16_t> seen(mesh.cells.size(), 0);  // per cell: edges that a lower cell has
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    for (int e = 0; e < Cell<Dim>::edges; ++e) {
      if ((seen[c] >> e) & 1) continue;
      for_each_cell_at_edge(mesh, {c, e}, [&](CellId n, int f) { seen[n] |= static_cast<std::uint16_t>(1u << f); });
      edges.push_back({mesh.cells[c][Cell<Dim>::edge_from(e)], mesh.cells[c][Cell<Dim>::edge_to(e)]});
    }
  }
  return edges;
}

template <int Dim>
std::vector<CellId> live_cells(const Mesh<Dim>& mesh) {
  std::vector<CellId> cells;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    if (mesh.alive(c)) cells.push_back(c);
  return cells;
}

template std::vector<CellId> live_cells(const Mesh<2>&);
template std::vector<CellId> live_cells(const Mesh<3>&);
template Status connect_cells(Mesh<2>&);
template Status connect_cells(Mesh<3>&);
template void vertex_star(const Mesh<2>&, VertexId, std::vector<CellCorner>&);
template void vertex_star(const Mesh<3>&, VertexId, std::vector<CellCorner>&);
template int edge_between(const Mesh<2>&, CellId, VertexId, VertexId);
template int edge_between(const Mesh<3>&, CellId, VertexId, VertexId);
template std::vector<std::array<VertexId, 2>> unique_edges(const Mesh<2>&);
template std::vector<std::array<VertexId, 2>> unique_edges(const Mesh<3>&);

}  // namespace pillowmesh
