#include "pillowmesh/mesh/boundary.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/classify.h"
#include "pillowmesh/mesh/frozen.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"

namespace pillowmesh {
namespace {

template <int Dim>
std::string name_of(const MeshInput<Dim>& input, Index c) {
  std::string text = "cell " + std::to_string(c);
  if (static_cast<std::size_t>(c) < input.cell_lines.size())
    text += " (line " + std::to_string(input.cell_lines[c]) + ")";
  return text;
}

/// Checks that must pass before adjacency can be built at all.
template <int Dim>
Status check_cells(const MeshInput<Dim>& input) {
  if (input.cells.empty()) return Status::bad_input("the mesh has no cells");
  for (Index c = 0; c < static_cast<Index>(input.cells.size()); ++c) {
    for (int k = 0; k < Cell<Dim>::corners; ++k) {
      const VertexId v = input.cells[c][k];
      if (v < 0 || v >= static_cast<Index>(input.points.size()))
        return Status::bad_input(name_of(input, c) + " names vertex " + std::to_string(v) + ", but there are " +
                                 std::to_string(input.points.size()));
      for (int d = 0; d < Dim; ++d)
        if (!std::isfinite(input.points[v][d]))
          return Status::bad_input("vertex " + std::to_string(v) + " of " + name_of(input, c) +
                                   " has a coordinate that is not a number");
    }
  }
  return {};
}

/// Drops vertices that no cell uses, keeping the order of the others.
template <int Dim>
void drop_unused_vertices(MeshInput<Dim>& input) {
  std::vector<Index> renumbered(input.points.size(), kNone);
  for (const auto& cell : input.cells)
    for (const VertexId v : cell) renumbered[v] = 0;
  Index used = 0;
  for (std::size_t v = 0; v < renumbered.size(); ++v)
    if (renumbered[v] == 0) {
      renumbered[v] = used;
      input.points[used++] = input.points[v];
    }
  if (used == static_cast<Index>(renumbered.size())) return;
  input.points.resize(used);
  const auto known = [&](VertexId v) {
    return v >= 0 && v < static_cast<Index>(renumbered.size()) && renumbered[v] != kNone;
  };
  for (auto& cell : input.cells)
    for (VertexId& v : cell) v = renumbered[v];
  std::erase_if(input.facets, [&](auto& f) { return !std::all_of(f.vertices.begin(), f.vertices.end(), known); });
  for (auto& facet : input.facets)
    for (VertexId& v : facet.vertices) v = renumbered[v];
  std::erase_if(input.corners, [&](VertexId v) { return !known(v); });
  for (VertexId& v : input.corners) v = renumbered[v];
  std::erase_if(input.ridges, [&](auto& r) { return !known(r[0]) || !known(r[1]); });
  for (auto& ridge : input.ridges) ridge = {renumbered[ridge[0]], renumbered[ridge[1]]};
  std::erase_if(input.required_vertices, [&](VertexId v) { return !known(v); });
  for (VertexId& v : input.required_vertices) v = renumbered[v];
  const auto renumber_all = [&](auto& list) {
    std::erase_if(list, [&](auto& vertices) { return !std::all_of(vertices.begin(), vertices.end(), known); });
    for (auto& vertices : list)
      for (VertexId& v : vertices) v = renumbered[v];
  };
  renumber_all(input.required_edges);
  renumber_all(input.required_facets);
  std::erase_if(input.marks, [&](auto& m) { return !known(m.ends[0]) || !known(m.ends[1]); });
  for (auto& mark : input.marks) mark.ends = {renumbered[mark.ends[0]], renumbered[mark.ends[1]]};
}

/// Where two cells share two facets with a common edge, one of them is inverted wherever the vertices are: says so.
template <int Dim>
void explain_shape(Mesh<Dim>& mesh, Defect& defect) {
  if (defect.kind != Defect::Kind::inverted_corner || !connect_cells(mesh).ok()) return;
  const CellId c = defect.cell;
  for (int f = 0; f < Cell<Dim>::facets; ++f)
    for (int g = 0; g < f; ++g) {
      const CellId n = mesh.neighbour(c, f);
      if (n == kNone || n != mesh.neighbour(c, g) || g == Cell<Dim>::opposite_facet(f)) continue;
      const std::string share = Dim == 2 ? "two edges with quad " : "two facets with hex ";
      defect.message += ", nor can it be: the cell shares " + share + std::to_string(n);
      return;
    }
}

}  // namespace

template <int Dim>
Expected<Mesh<Dim>> make_mesh(MeshInput<Dim> input, const BoundaryOptions& options) {
  if (Status s = check_cells(input); !s.ok()) return s;
  drop_unused_vertices(input);
  Mesh<Dim> mesh;
  mesh.points = std::move(input.points);
  mesh.cells = std::move(input.cells);
  mesh.region = std::move(input.cell_region);
  mesh.region.resize(mesh.cells.size(), 0);
  mesh.region_groups = input.region_groups;
  if (mesh.region_groups.empty()) mesh.region_groups.push_back({0, ""});
  for (Index& r : mesh.region)
    if (r < 0 || r >= static_cast<Index>(mesh.region_groups.size())) r = 0;

  constexpr int most = 1000;
  const auto refused = [&](const std::vector<Defect>& defects) {
    return Status::bad_input(describe<Dim>(defects, most, input.cell_lines));
  };
  auto shapes = find_cell_defects(mesh, most);
  if (!shapes.empty()) {
    explain_shape(mesh, shapes[0]);
    return refused(shapes);
  }
  if (Status s = connect_cells(mesh); !s.ok()) return s;
  const auto hanging = find_hanging_nodes(mesh, most);  // first: they are the cause of what else looks wrong
  if (!hanging.empty()) return refused(hanging);
  const auto adjacency = find_adjacency_defects(mesh, most);
  if (!adjacency.empty()) return refused(adjacency);
  classify_boundary(mesh, input, options);
  const auto overlaps = find_overlaps(mesh, most);
  if (!overlaps.empty()) return refused(overlaps);
  if (Status s = freeze(mesh, input, options.freeze); !s.ok()) return s;
  return mesh;
}

template <int Dim>
MeshInput<Dim> to_input(const Mesh<Dim>& mesh) {
  using C = Cell<Dim>;
  MeshInput<Dim> out;
  std::vector<Index> renumbered(mesh.points.size(), kNone);
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    if (mesh.alive(c))
      for (const VertexId v : mesh.cells[c]) renumbered[v] = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (renumbered[v] == kNone) continue;
    renumbered[v] = static_cast<Index>(out.points.size());
    out.points.push_back(mesh.points[v]);
    if (mesh.support[v].dim == 0 && !mesh.support[v].frozen()) out.corners.push_back(renumbered[v]);
  }
  out.region_groups = mesh.region_groups;
  // Patches of the same group are one group to a file.
  std::vector<Index> group_of(mesh.patch_groups.size());
  for (std::size_t p = 0; p < group_of.size(); ++p) {
    const Group& g = mesh.patch_groups[p];
    const auto same = std::find_if(out.facet_groups.begin(), out.facet_groups.end(),
                                   [&](const Group& o) { return o.tag == g.tag && o.name == g.name; });
    group_of[p] = static_cast<Index>(same - out.facet_groups.begin());
    if (same == out.facet_groups.end()) out.facet_groups.push_back(g);
  }
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    auto cell = mesh.cells[c];
    for (VertexId& v : cell) v = renumbered[v];
    out.cells.push_back(cell);
    out.cell_region.push_back(mesh.region[c]);
    for (int f = 0; f < C::facets; ++f) {
      if (!mesh.on_boundary(c, f)) continue;
      auto facet = mesh.facet_vertices(c, f);
      for (VertexId& v : facet) v = renumbered[v];
      out.facets.push_back({facet, group_of[mesh.patch_of(c, f)]});
    }
    if constexpr (Dim == 3)
      for (int e = 0; e < C::edges; ++e) {
        const VertexId a = mesh.cells[c][C::edge_from(e)], b = mesh.cells[c][C::edge_to(e)];
        if (mesh.support[a].dim <= 1 && mesh.support[b].dim <= 1 && is_feature_edge(mesh, {c, e}) &&
            represents_edge(mesh, {c, e}))
          out.ridges.push_back({renumbered[a], renumbered[b]});
      }
  }
  list_frozen(mesh, renumbered, out);
  return out;
}

template Expected<Mesh<2>> make_mesh(MeshInput<2>, const BoundaryOptions&);
template Expected<Mesh<3>> make_mesh(MeshInput<3>, const BoundaryOptions&);
template MeshInput<2> to_input(const Mesh<2>&);
template MeshInput<3> to_input(const Mesh<3>&);

}  // namespace pillowmesh
