#include "pillowmesh/mesh/primitives.h"

#include "pillowmesh/mesh/boundary.h"

namespace pillowmesh {
namespace {

constexpr const char* kSideNames[] = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};

}  // namespace

template <int Dim>
Mesh<Dim> make_grid(std::array<int, Dim> n, const Point<Dim>& low, const Point<Dim>& high) {
  using C = Cell<Dim>;
  MeshInput<Dim> input;
  std::array<Index, Dim> vertex_stride{}, cell_stride{};
  Index vertices = 1, cells = 1;
  for (int d = 0; d < Dim; ++d) {
    vertex_stride[d] = vertices;
    cell_stride[d] = cells;
    vertices *= n[d] + 1;
    cells *= n[d];
  }
  input.points.resize(vertices);
  for (Index v = 0; v < vertices; ++v)
    for (int d = 0; d < Dim; ++d) {
      const Index i = v / vertex_stride[d] % (n[d] + 1);
      input.points[v][d] = i == n[d] ? high[d] : low[d] + (high[d] - low[d]) * i / n[d];
    }
  input.cells.resize(cells);
  for (int s = 0; s < C::facets; ++s) input.facet_groups.push_back({s + 1, kSideNames[s]});
  for (CellId c = 0; c < cells; ++c) {
    Index base = 0;
    for (int d = 0; d < Dim; ++d) base += c / cell_stride[d] % n[d] * vertex_stride[d];
    for (int k = 0; k < C::corners; ++k) {
      input.cells[c][k] = base;
      for (int d = 0; d < Dim; ++d)
        if ((k >> d) & 1) input.cells[c][k] += vertex_stride[d];
    }
    for (int f = 0; f < C::facets; ++f) {
      const int axis = C::facet_axis(f);
      if (c / cell_stride[axis] % n[axis] != (C::facet_side(f) ? n[axis] - 1 : 0)) continue;
      FacetCorners<Dim> v;
      for (int k = 0; k < C::facet_corners; ++k) v[k] = input.cells[c][C::facet_corner(f, k)];
      input.facets.push_back({v, f});
    }
  }
  return *make_mesh(std::move(input));  // a box is always valid
}

template <int Dim>
Expected<Mesh<Dim>> make_section(MeshInput<Dim> section) {
  // Coarse circles turn by more than the usual angle from cell to cell, and are smooth nevertheless.
  return make_mesh(std::move(section), {.corner_cosine = -2.0});
}

template Mesh<2> make_grid<2>(std::array<int, 2>, const Point<2>&, const Point<2>&);
template Mesh<3> make_grid<3>(std::array<int, 3>, const Point<3>&, const Point<3>&);
template Expected<Mesh<2>> make_section<2>(MeshInput<2>);
template Expected<Mesh<3>> make_section<3>(MeshInput<3>);

}  // namespace pillowmesh
