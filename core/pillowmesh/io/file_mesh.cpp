#include "pillowmesh/io/file_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "pillowmesh/mesh/number.h"

namespace pillowmesh {
namespace {

std::string place(std::string_view name, std::int64_t line) {
  return std::string(name) + (line > 0 ? ", line " + std::to_string(line) : "") + ": ";
}

std::string counted(std::int64_t count, std::string_view plural) {
  std::string noun(plural);
  if (count == 1) {
    if (noun.ends_with("dra")) {
      noun.replace(noun.size() - 1, 1, "on");
    } else if (noun.ends_with("s")) {
      noun.pop_back();
    }
  }
  return std::to_string(count) + " " + noun;
}

/// Vertices that exist and differ.
template <int N>
Status check_vertices(const FileMesh& file, const Elements<N>& elements, const char* kind, std::string_view name) {
  const auto vertex_count = static_cast<Index>(file.points.size());
  for (std::size_t i = 0; i < elements.vertices.size(); ++i) {
    const auto& v = elements.vertices[i];
    for (int k = 0; k < N; ++k) {
      std::string reason;
      if (v[k] < 0 || v[k] >= vertex_count) {
        reason = "names vertex " + std::to_string(std::int64_t{v[k]} + file.first_vertex) + ", but the file has " +
                 std::to_string(vertex_count) + " vertices, counted from " + std::to_string(file.first_vertex);
      } else if (std::find(v.begin(), v.begin() + k, v[k]) != v.begin() + k) {
        reason = "is degenerate: it names vertex " + std::to_string(v[k] + file.first_vertex) + " twice";
      }
      if (reason.empty()) continue;
      return Status::bad_input(place(name, elements.line.empty() ? 0 : elements.line[i]) + kind + " " +
                               std::to_string(i) + " (counted from 0) " + reason);
    }
  }
  return {};
}

/// Coordinates whose products do not overflow.
Status check_coordinates(const FileMesh& file, std::string_view name) {
  for (std::size_t i = 0; i < file.points.size(); ++i)
    for (int d = 0; d < 3; ++d)
      if (!(std::fabs(file.points[i][d]) <= 1e100))
        return Status::bad_input(place(name, 0) + "vertex " +
                                 std::to_string(static_cast<std::int64_t>(i) + file.first_vertex) +
                                 " has a coordinate that is not a number of at most 1e100");
  return {};
}

/// Only quads, or only hexahedra with quads on the boundary.
Status check_kinds(const FileMesh& file, std::string_view name) {
  const bool has_hexes = !file.hexes.vertices.empty();
  const bool has_quads = !file.quads.vertices.empty();
  for (const Foreign& f : file.foreign) {
    const std::string where = place(name, f.line);
    if (has_hexes || has_quads) {
      const std::string own = has_hexes ? counted(static_cast<std::int64_t>(file.hexes.vertices.size()), "hexahedra")
                                        : counted(static_cast<std::int64_t>(file.quads.vertices.size()), "quads");
      return Status::bad_input(where + "the mesh mixes " + counted(f.count, f.what) + " with " + own +
                               "; pillowmesh takes all-quad or all-hex meshes only");
    }
    return Status::bad_input(where + "the mesh has " + counted(f.count, f.what) +
                             " and no quads or hexahedra; pillowmesh takes all-quad or all-hex meshes only");
  }
  if (has_hexes || has_quads) return {};
  return Status::bad_input(place(name, 0) + (file.points.empty()
                                                 ? "the mesh is empty: it has no vertices and no cells"
                                                 : "the mesh has vertices but no quads and no hexahedra"));
}

/// A 2D mesh given in 3D must lie in a plane z = constant.
Status check_planar(const FileMesh& file, std::string_view name) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Point<3> low(inf, inf, inf), high(-inf, -inf, -inf);
  for (const auto& quad : file.quads.vertices)
    for (Index v : quad) {
      low = low.cwiseMin(file.points[v]);
      high = high.cwiseMax(file.points[v]);
    }
  const double width = std::max(high[0] - low[0], high[1] - low[1]);
  // Coordinates that were rotated or printed with few digits stray from their plane by rounding.
  if (high[2] - low[2] <= 1e-9 * width) return {};
  return Status::bad_input(place(name, 0) + "the quads do not lie in a plane z = constant (z runs from " +
                           rounded_text(low[2], 6) + " to " + rounded_text(high[2], 6) +
                           "); curved surface meshes are not supported");
}

struct Groups {
  std::vector<Group> groups;
  std::vector<Index> sorted;  // tags

  Groups(const std::vector<Index>& tags, const std::vector<FileMesh::Name>& names, int dim, bool with_zero)
      : sorted(tags) {
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (!with_zero) sorted.erase(std::remove(sorted.begin(), sorted.end(), 0), sorted.end());
    for (Index tag : sorted) {
      Group group{tag, {}};
      for (const FileMesh::Name& n : names)
        if (n.dim == dim && n.tag == tag) group.name = n.name;
      groups.push_back(std::move(group));
    }
  }
  [[nodiscard]] Index index_of(Index tag) const {
    return static_cast<Index>(std::lower_bound(sorted.begin(), sorted.end(), tag) - sorted.begin());
  }
};

/// Sorts the groups. \return the new index of each.
std::vector<Index> sort_and_map(std::vector<Group>& groups) {
  std::vector<Index> order(groups.size()), renumbered(groups.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::tie(groups[a].tag, groups[a].name, a) < std::tie(groups[b].tag, groups[b].name, b);
  });
  std::vector<Group> sorted;
  for (std::size_t i = 0; i < order.size(); ++i) {
    renumbered[order[i]] = static_cast<Index>(i);
    sorted.push_back(groups[order[i]]);
  }
  groups = std::move(sorted);
  return renumbered;
}

template <class T>
void release(std::vector<T>& v) {
  std::vector<T>().swap(v);
}

/// Points, and in 3D lines, that carry a physical group.
template <int Dim>
void mark_groups(const FileMesh& file, MeshInput<Dim>& input) {
  const auto add = [&](const std::vector<Index>& tags, int dim, auto&& ends_of) {
    Groups groups(tags, file.names, dim, false);
    const Index first = static_cast<Index>(input.mark_groups.size());
    for (std::size_t i = 0; i < tags.size(); ++i)
      if (tags[i] != 0) input.marks.push_back({ends_of(i), first + groups.index_of(tags[i])});
    input.mark_groups.insert(input.mark_groups.end(), groups.groups.begin(), groups.groups.end());
  };
  add(file.corner_tags, 0, [&](std::size_t i) { return std::array<VertexId, 2>{file.corners[i], file.corners[i]}; });
  if (Dim == 3) add(file.lines.tag, 1, [&](std::size_t i) { return file.lines.vertices[i]; });
}

template <int Dim>
void require(const FileMesh& file, MeshInput<Dim>& input) {
  input.required_vertices = file.required_vertices;
  if constexpr (Dim == 2) {
    for (const Index i : file.required_lines) input.required_facets.push_back(file.lines.vertices[i]);
    input.required_cells = file.required_quads;
  } else {
    for (const Index i : file.required_lines) input.required_edges.push_back(file.lines.vertices[i]);
    for (const Index i : file.required_quads) input.required_facets.push_back(file_order(file.quads.vertices[i]));
  }
}

template <int Dim>
MeshInput<Dim> to_mesh_input(FileMesh& file, Elements<Cell<Dim>::corners>& cells,
                             Elements<Cell<Dim>::facet_corners>& facets) {
  MeshInput<Dim> input;
  mark_groups(file, input);
  require(file, input);
  if constexpr (Dim == 3) {
    input.points = std::move(file.points);
  } else {
    input.points.reserve(file.points.size());
    for (const Point<3>& p : file.points) input.points.emplace_back(p[0], p[1]);
    release(file.points);
  }
  input.cells.reserve(cells.vertices.size());
  for (const auto& v : cells.vertices) input.cells.push_back(file_order(v));
  release(cells.vertices);

  const bool any_region = std::any_of(cells.tag.begin(), cells.tag.end(), [](Index t) { return t != 0; });
  if (any_region) {
    Groups regions(cells.tag, file.names, Dim, true);
    for (Index& tag : cells.tag) tag = regions.index_of(tag);
    input.cell_region = std::move(cells.tag);
    input.region_groups = std::move(regions.groups);
  }
  Groups patches(facets.tag, file.names, Dim - 1, false);
  for (std::size_t i = 0; i < facets.vertices.size(); ++i)
    if (facets.tag[i] != 0) input.facets.push_back({file_order(facets.vertices[i]), patches.index_of(facets.tag[i])});
  input.facet_groups = std::move(patches.groups);
  input.corners = std::move(file.corners);
  if constexpr (Dim == 3)
    for (Index r : file.ridges) input.ridges.push_back(file.lines.vertices[r]);
  input.cell_lines = std::move(cells.line);
  return input;
}

}  // namespace

void add_foreign(FileMesh& mesh, std::string_view what, std::int64_t line) {
  for (Foreign& f : mesh.foreign)
    if (f.what == what) {
      ++f.count;
      return;
    }
  mesh.foreign.push_back({std::string(what), 1, line});
}

Expected<AnyInput> finish(FileMesh file, std::string_view name) {
  if (Status s = check_kinds(file, name); !s.ok()) return s;
  if (Status s = check_coordinates(file, name); !s.ok()) return s;
  if (Status s = check_vertices(file, file.quads, "quad", name); !s.ok()) return s;
  if (Status s = check_vertices(file, file.hexes, "hexahedron", name); !s.ok()) return s;
  if (Status s = check_vertices(file, file.lines, "edge", name); !s.ok()) return s;
  const auto vertex_count = static_cast<Index>(file.points.size());
  for (Index c : file.corners)
    if (c < 0 || c >= vertex_count)
      return Status::bad_input(place(name, 0) + "corner vertex " + std::to_string(std::int64_t{c} + file.first_vertex) +
                               " does not exist");
  const auto line_count = static_cast<Index>(file.lines.vertices.size());
  for (Index r : file.ridges)
    if (r < 0 || r >= line_count)
      return Status::bad_input(place(name, 0) + "ridge " + std::to_string(std::int64_t{r} + 1) +
                               " names an edge that does not exist");
  const auto check_list = [&](const std::vector<Index>& list, std::size_t count, const char* what) -> Status {
    for (const Index i : list)
      if (i < 0 || i >= static_cast<Index>(count))
        return Status::bad_input(place(name, 0) + "required " + what + " " + std::to_string(std::int64_t{i} + 1) +
                                 " does not exist");
    return {};
  };
  if (Status s = check_list(file.required_vertices, file.points.size(), "vertex"); !s.ok()) return s;
  if (Status s = check_list(file.required_lines, file.lines.vertices.size(), "edge"); !s.ok()) return s;
  if (Status s = check_list(file.required_quads, file.quads.vertices.size(), "quad"); !s.ok()) return s;
  if (!file.hexes.vertices.empty()) return AnyInput(to_mesh_input<3>(file, file.hexes, file.quads));
  if (Status s = check_planar(file, name); !s.ok()) return s;
  return AnyInput(to_mesh_input<2>(file, file.quads, file.lines));
}

std::vector<Index> distinct_tags(const std::vector<Group>& groups) {
  std::vector<Index> tags(groups.size(), 0);
  const auto taken = [&](Index tag, std::size_t before) {
    return std::find(tags.begin(), tags.begin() + static_cast<std::ptrdiff_t>(before), tag) !=
           tags.begin() + static_cast<std::ptrdiff_t>(before);
  };
  const auto used_by_any = [&](Index tag, std::size_t before) {
    return taken(tag, before) ||
           std::any_of(groups.begin(), groups.end(), [&](const Group& g) { return g.tag == tag; });
  };
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].tag == 0 && groups[i].name.empty()) continue;
    const auto same = [&](const Group& g) { return g.tag == groups[i].tag && g.name == groups[i].name; };
    const auto first = static_cast<std::size_t>(std::find_if(groups.begin(), groups.end(), same) - groups.begin());
    if (first < i) {  // another patch of the same group
      tags[i] = tags[first];
    } else if (groups[i].tag > 0 && !taken(groups[i].tag, i)) {
      tags[i] = groups[i].tag;
    } else {
      Index tag = 1;
      while (used_by_any(tag, i)) ++tag;
      tags[i] = tag;
    }
  }
  return tags;
}

template <int Dim>
void sort_groups(MeshInput<Dim>& mesh) {
  const std::vector<Index> facet_groups = sort_and_map(mesh.facet_groups);
  for (auto& facet : mesh.facets) facet.group = facet_groups[facet.group];
  const std::vector<Index> regions = sort_and_map(mesh.region_groups);
  if (!regions.empty())
    for (Index& region : mesh.cell_region) region = regions[region];
}

template void sort_groups(MeshInput<2>&);
template void sort_groups(MeshInput<3>&);

}  // namespace pillowmesh
