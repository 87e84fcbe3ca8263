#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "pillowmesh/io/vtk.h"

namespace pillowmesh {
namespace {

struct VtkType {
  int code;
  int vertices;  ///< 0: any number
  std::string_view plural;
};
constexpr VtkType kVtkTypes[] = {
    {0, 0, "empty cells"}, {1, 1, "points"},          {2, 0, "points"},     {3, 2, "edges"},   {4, 0, "edges"},
    {5, 3, "triangles"},   {6, 0, "triangle strips"}, {7, 0, "polygons"},   {8, 4, "quads"},   {9, 4, "quads"},
    {10, 4, "tetrahedra"}, {11, 8, "hexahedra"},      {12, 8, "hexahedra"}, {13, 6, "prisms"}, {14, 5, "pyramids"},
};

template <int N>
void keep(Elements<N>& elements, const Index* v, Index group, Index line, std::size_t cell) {
  std::array<Index, N> vertices;
  for (int k = 0; k < N; ++k) vertices[k] = v[k];
  elements.vertices.push_back(vertices);
  elements.tag.push_back(group);
  elements.place.push_back(static_cast<Index>(cell));
  if (line > 0) elements.line.push_back(line);
}

}  // namespace

FileMesh to_file_mesh(VtkGrid grid, Source& source) {
  FileMesh mesh;
  mesh.first_vertex = 0;
  mesh.points = std::move(grid.points);
  mesh.fields = std::move(grid.fields);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (!mesh.points[i].allFinite())
      source.fail_whole("a coordinate of vertex " + std::to_string(i) + " is not a finite number");
  if (grid.types.size() != grid.ends.size()) {
    source.fail_whole("the file lists " + std::to_string(grid.ends.size()) + " cells but " +
                      std::to_string(grid.types.size()) + " cell types");
  }
  Index begin = 0;
  for (std::size_t c = 0; c < grid.ends.size() && !source.failed(); ++c) {
    const Index end = grid.ends[c];
    const auto fail = [&](const std::string& reason) {
      source.fail_whole("cell " + std::to_string(c) + " (counted from 0) " + reason);
    };
    if (end < begin || static_cast<std::size_t>(end) > grid.connectivity.size()) {
      fail("ends outside of the list of vertices; an offset is wrong");
      break;
    }
    const Index* v = grid.connectivity.data() + begin;
    const Index n = end - begin;
    begin = end;
    const Index group = c < grid.groups.size() ? grid.groups[c] : 0;
    const Index line = c < grid.lines.size() ? grid.lines[c] : 0;
    const VtkType* type = nullptr;
    for (const VtkType& t : kVtkTypes)
      if (t.code == grid.types[c]) type = &t;
    if (type == nullptr) {
      add_foreign(mesh, "higher-order or unknown cells (VTK type " + std::to_string(grid.types[c]) + ")", line);
      continue;
    }
    if (type->vertices != 0 && type->vertices != n) {
      fail("has " + std::to_string(n) + " vertices, but its VTK type " + std::to_string(type->code) + " has " +
           std::to_string(type->vertices));
      break;
    }
    switch (type->code) {
      case 0:
      case 1:
      case 2:
        break;
      case 3:
      case 4:
        for (Index k = 0; k + 1 < n; ++k) keep(mesh.lines, v + k, group, line, c);
        break;
      case 7:
        if (n == 4) {
          keep(mesh.quads, v, group, line, c);
        } else {
          add_foreign(mesh, n == 3 ? "triangles" : "polygons", line);
        }
        break;
      case 8: {
        const Index q[4] = {v[0], v[1], v[3], v[2]};
        keep(mesh.quads, q, group, line, c);
        break;
      }
      case 9:
        keep(mesh.quads, v, group, line, c);
        break;
      case 11: {
        const Index h[8] = {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]};
        keep(mesh.hexes, h, group, line, c);
        break;
      }
      case 12:
        keep(mesh.hexes, v, group, line, c);
        break;
      default:
        add_foreign(mesh, type->plural, line);
    }
  }
  return mesh;
}

int group_array_rank(std::string_view name) {
  constexpr std::string_view names[] = {"patch", "region", "CellEntityIds", "medit:ref", "gmsh:physical", "group"};
  int rank = 0;
  for (std::string_view n : names) {
    ++rank;
    if (n == name) return rank;
  }
  return 0;
}

Index group_number(double value) {
  if (!(value >= -2147483647.0 && value <= 2147483647.0) || value != std::floor(value)) return 0;
  return static_cast<Index>(value);
}

template <int Dim>
std::vector<Index> group_array(const MeshInput<Dim>& mesh) {
  const std::vector<Index> region_tags = distinct_tags(mesh.region_groups);
  const std::vector<Index> facet_tags = distinct_tags(mesh.facet_groups);
  std::vector<Index> groups(mesh.cells.size(), 0);
  if (!region_tags.empty() && !mesh.cell_region.empty())
    for (std::size_t c = 0; c < groups.size(); ++c) groups[c] = region_tags[mesh.cell_region[c]];
  for (const auto& facet : mesh.facets) groups.push_back(facet_tags[facet.group]);
  return groups;
}

template <int Dim>
void continue_fields(MeshInput<Dim>& mesh) {
  if (std::none_of(mesh.fields.begin(), mesh.fields.end(), [](const FieldArray& f) { return f.of_cells; })) return;
  struct Named {
    FacetCorners<Dim> key;
    std::size_t place;
  };
  const auto key_of = [](FacetCorners<Dim> v) {
    std::sort(v.begin(), v.end());
    return v;
  };
  std::vector<Named> facets;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) facets.push_back({key_of(mesh.facets[i].vertices), i});
  std::sort(facets.begin(), facets.end(), [](const Named& a, const Named& b) { return a.key < b.key; });
  std::vector<Index> cell_of(mesh.facets.size(), kNone);
  for (std::size_t c = mesh.cells.size(); c-- > 0;) {  // backwards, so that the first cell is what stays
    for (int f = 0; f < Cell<Dim>::facets; ++f) {
      FacetCorners<Dim> v;
      for (int k = 0; k < Cell<Dim>::facet_corners; ++k) v[k] = mesh.cells[c][Cell<Dim>::facet_corner(f, k)];
      v = key_of(v);
      auto at = std::lower_bound(facets.begin(), facets.end(), v, [](const Named& a, const auto& k) { return a.key < k; });
      for (; at != facets.end() && at->key == v; ++at) cell_of[at->place] = static_cast<Index>(c);
    }
  }
  for (FieldArray& f : mesh.fields) {
    const auto n = static_cast<std::size_t>(f.components);
    if (!f.of_cells || f.values.size() != n * mesh.cells.size()) continue;
    for (const Index c : cell_of)
      for (std::size_t k = 0; k < n; ++k)
        f.values.push_back(c == kNone ? 0.0 : f.values[static_cast<std::size_t>(c) * n + k]);
  }
}

template void continue_fields(MeshInput<2>&);
template void continue_fields(MeshInput<3>&);
template std::vector<Index> group_array(const MeshInput<2>&);
template std::vector<Index> group_array(const MeshInput<3>&);

}  // namespace pillowmesh
