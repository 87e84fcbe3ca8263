#include "pillowmesh/mesh/boundary.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/classify.h"
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
  mesh.region_groups = std::move(input.region_groups);
  if (mesh.region_groups.empty()) mesh.region_groups.push_back({0, ""});
  for (Index& r : mesh.region)
    if (r < 0 || r >= static_cast<Index>(mesh.region_groups.size())) r = 0;

  const auto located = [&](const Defect& d, int more) {
    std::string text = d.message;
    if (d.cell != kNone && static_cast<std::size_t>(d.cell) < input.cell_lines.size())
      text += " (line " + std::to_string(input.cell_lines[d.cell]) + ")";
    if (more > 0) text += " (and " + std::to_string(more) + (more == 1 ? " more defect)" : " more defects)");
    return Status::bad_input(text);
  };
  const auto shapes = find_cell_defects(mesh, 1000);
  if (!shapes.empty()) return located(shapes[0], static_cast<int>(shapes.size()) - 1);
  if (Status s = connect_cells(mesh); !s.ok()) return s;
  const auto hanging = find_hanging_nodes(mesh, 1000);  // first: they are the cause of what else looks wrong
  if (!hanging.empty()) return located(hanging[0], static_cast<int>(hanging.size()) - 1);
  const auto adjacency = find_adjacency_defects(mesh, 1000);
  if (!adjacency.empty()) return located(adjacency[0], static_cast<int>(adjacency.size()) - 1);
  classify_boundary(mesh, input, options);
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
    if (mesh.support[v].dim == 0) out.corners.push_back(renumbered[v]);
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
  return out;
}

template Expected<Mesh<2>> make_mesh(MeshInput<2>, const BoundaryOptions&);
template Expected<Mesh<3>> make_mesh(MeshInput<3>, const BoundaryOptions&);
template MeshInput<2> to_input(const Mesh<2>&);
template MeshInput<3> to_input(const Mesh<3>&);

}  // namespace pillowmesh
