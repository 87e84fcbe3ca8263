#include "pillowmesh/mesh/frozen.h"

#include <algorithm>

namespace pillowmesh {
namespace {

template <std::size_t N>
std::array<VertexId, N> sorted(std::array<VertexId, N> v) {
  std::sort(v.begin(), v.end());
  return v;
}

template <std::size_t N>
bool contains(const std::vector<std::array<VertexId, N>>& list, const std::array<VertexId, N>& v) {
  return std::binary_search(list.begin(), list.end(), sorted(v));
}

template <class T>
void sort_unique(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

template <int Dim, std::size_t N>
bool all_frozen(const Mesh<Dim>& mesh, const std::array<VertexId, N>& v) {
  return std::all_of(v.begin(), v.end(), [&](VertexId w) { return mesh.support[w].frozen(); });
}

template <int Dim>
FacetCorners<Dim> facet_of(const Corners<Dim>& cell, int f) {
  FacetCorners<Dim> v;
  for (int k = 0; k < Cell<Dim>::facet_corners; ++k) v[k] = cell[Cell<Dim>::facet_corner(f, k)];
  return v;
}

template <int Dim>
std::array<VertexId, 2> edge_of(const Corners<Dim>& cell, int e) {
  return {cell[Cell<Dim>::edge_from(e)], cell[Cell<Dim>::edge_to(e)]};
}

/// True if `has(cell)` for a cell at v.
template <int Dim, class Has>
bool any_cell_at(const Mesh<Dim>& mesh, VertexId v, Has&& has) {
  if (mesh.vertex_cell[v] == kNone) return false;
  std::vector<CellCorner> star;
  vertex_star(mesh, v, star);
  return std::any_of(star.begin(), star.end(), [&](const CellCorner& at) { return has(mesh.cells[at.cell]); });
}

template <int Dim>
bool edge_exists(const Mesh<Dim>& mesh, const std::array<VertexId, 2>& v) {
  return any_cell_at(mesh, v[0], [&](const Corners<Dim>& cell) {
    for (int e = 0; e < Cell<Dim>::edges; ++e)
      if (sorted(edge_of<Dim>(cell, e)) == sorted(v)) return true;
    return false;
  });
}

template <int Dim>
bool facet_exists(const Mesh<Dim>& mesh, const FacetCorners<Dim>& v) {
  return any_cell_at(mesh, v[0], [&](const Corners<Dim>& cell) {
    for (int f = 0; f < Cell<Dim>::facets; ++f)
      if (sorted(facet_of<Dim>(cell, f)) == sorted(v)) return true;
    return false;
  });
}

template <int Dim>
class Freezer {
 public:
  Freezer(Mesh<Dim>& mesh, const MeshInput<Dim>& input) : mesh_(mesh), input_(input) {}

  Status add_required() {
    for (const VertexId v : input_.required_vertices) vertices_.push_back(v);
    for (const auto& e : input_.required_edges)
      if (Status s = add_edge(e); !s.ok()) return s;
    for (const auto& f : input_.required_facets)
      if (Status s = add_facet(f); !s.ok()) return s;
    for (const Index c : input_.required_cells) add_cell(c);
    return {};
  }

  Status add_group(const std::string& name) {
    const auto named = [&](const Group& g) { return g.name == name || std::to_string(g.tag) == name; };
    bool found = false;
    for (std::size_t g = 0; g < input_.facet_groups.size(); ++g) {
      if (!named(input_.facet_groups[g])) continue;
      found = true;
      for (const auto& f : input_.facets) {
        if (f.group != static_cast<Index>(g)) continue;
        if (Status s = add_facet(f.vertices); !s.ok()) return s;
        inner_.push_back({f.vertices, input_.facet_groups[g]});
      }
    }
    for (std::size_t g = 0; g < mesh_.region_groups.size(); ++g) {
      if (!named(mesh_.region_groups[g]) || (mesh_.region_groups[g].tag == 0 && mesh_.region_groups[g].name.empty()))
        continue;
      found = true;
      for (CellId c = 0; c < mesh_.cell_count(); ++c)
        if (mesh_.region[c] == static_cast<Index>(g)) add_cell(c);
    }
    for (std::size_t g = 0; g < input_.mark_groups.size(); ++g) {
      if (!named(input_.mark_groups[g])) continue;
      found = true;
      for (const auto& mark : input_.marks) {
        if (mark.group != static_cast<Index>(g)) continue;
        if (mark.ends[0] == mark.ends[1])
          vertices_.push_back(mark.ends[0]);
        else if (Status s = add_edge(mark.ends); !s.ok())
          return s;
      }
    }
    return found ? Status{} : Status::usage("--freeze " + name + ": there is no such group; " + known_groups());
  }

  void finish() {
    if (vertices_.empty()) return;
    sort_unique(vertices_);
    for (const VertexId v : vertices_) mesh_.support[v] = {0, VertexSupport::kFrozen};
    auto frozen = std::make_shared<Frozen<Dim>>();
    sort_unique(edges_);
    sort_unique(facets_);
    sort_unique(cells_);
    frozen->edges = std::move(edges_);
    frozen->facets = std::move(facets_);
    frozen->cells = std::move(cells_);
    for (auto& f : inner_)
      if (is_inside(f.vertices)) frozen->inner_facets.push_back(std::move(f));
    mesh_.frozen = std::move(frozen);
  }

 private:
  Status add_edge(const std::array<VertexId, 2>& v) {
    if (!edge_exists(mesh_, v))
      return Status::bad_input("the edge between vertices " + std::to_string(v[0]) + " and " + std::to_string(v[1]) +
                               " is to be frozen, but no cell has it");
    edges_.push_back(sorted(v));
    vertices_.insert(vertices_.end(), v.begin(), v.end());
    return {};
  }
  Status add_facet(const FacetCorners<Dim>& v) {
    if constexpr (Dim == 2) {
      return add_edge(v);
    } else {
      if (!facet_exists(mesh_, v))
        return Status::bad_input("the quad at vertex " + std::to_string(v[0]) + " is to be frozen, but no hex has it");
      facets_.push_back(sorted(v));
      for (int k = 0; k < 4; ++k)
        for (const int bit : {1, 2})
          if ((k & bit) == 0) edges_.push_back(sorted(std::array<VertexId, 2>{v[k], v[k | bit]}));
      vertices_.insert(vertices_.end(), v.begin(), v.end());
      return {};
    }
  }
  void add_cell(CellId c) {
    const auto& cell = mesh_.cells[c];
    cells_.push_back(sorted(cell));
    for (int e = 0; e < Cell<Dim>::edges; ++e) edges_.push_back(sorted(edge_of<Dim>(cell, e)));
    if constexpr (Dim == 3)
      for (int f = 0; f < 6; ++f) facets_.push_back(sorted(facet_of<3>(cell, f)));
    vertices_.insert(vertices_.end(), cell.begin(), cell.end());
  }
  bool is_inside(const FacetCorners<Dim>& v) const {
    std::vector<CellCorner> star;
    vertex_star(mesh_, v[0], star);
    for (const CellCorner& at : star)
      for (int f = 0; f < Cell<Dim>::facets; ++f)
        if (sorted(mesh_.facet_vertices(at.cell, f)) == sorted(v)) return !mesh_.on_boundary(at.cell, f);
    return false;
  }
  std::string known_groups() const {
    std::string text;
    for (const std::vector<Group>* groups : {&input_.facet_groups, &input_.region_groups, &input_.mark_groups})
      for (const Group& g : *groups)
        if (g.tag != 0 || !g.name.empty())
          text += (text.empty() ? "" : ", ") + (g.name.empty() ? std::to_string(g.tag) : g.name);
    return text.empty() ? "the mesh has none" : "the mesh has " + text;
  }

  Mesh<Dim>& mesh_;
  const MeshInput<Dim>& input_;
  std::vector<VertexId> vertices_;
  std::vector<std::array<VertexId, 2>> edges_;
  std::vector<FacetCorners<Dim>> facets_;
  std::vector<Corners<Dim>> cells_;
  std::vector<typename Frozen<Dim>::InnerFacet> inner_;
};

}  // namespace

template <int Dim>
Status freeze(Mesh<Dim>& mesh, const MeshInput<Dim>& input, const std::vector<std::string>& names) {
  Freezer<Dim> freezer(mesh, input);
  if (Status s = freezer.add_required(); !s.ok()) return s;
  for (const std::string& name : names)
    if (Status s = freezer.add_group(name); !s.ok()) return s;
  freezer.finish();
  return {};
}

template <int Dim>
void list_frozen(const Mesh<Dim>& mesh, const std::vector<Index>& renumbered, MeshInput<Dim>& out) {
  if (!mesh.frozen) return;
  const auto number = [&](auto vertices) {
    for (VertexId& v : vertices) v = renumbered[v];
    return vertices;
  };
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.support[v].frozen()) out.required_vertices.push_back(renumbered[v]);
  if constexpr (Dim == 3)
    for (const auto& e : mesh.frozen->edges) out.required_edges.push_back(number(e));
  for (const auto& f : mesh.frozen->inner_facets) {
    const auto same = [&](const Group& g) { return g.tag == f.group.tag && g.name == f.group.name; };
    const auto at = std::find_if(out.facet_groups.begin(), out.facet_groups.end(), same);
    out.facets.push_back({number(f.vertices), static_cast<Index>(at - out.facet_groups.begin())});
    if (at == out.facet_groups.end()) out.facet_groups.push_back(f.group);
  }
  for (CellId c = 0, written = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    if (is_frozen_cell(mesh, mesh.cells[c])) out.required_cells.push_back(written);
    for (int f = 0; f < Cell<Dim>::facets; ++f) {
      const auto v = mesh.facet_vertices(c, f);
      const CellId other = mesh.neighbour(c, f);
      if ((other == kNone || c < other) && is_frozen_facet(mesh, v)) out.required_facets.push_back(number(v));
    }
    ++written;
  }
}

template <int Dim>
bool is_frozen_edge(const Mesh<Dim>& mesh, VertexId a, VertexId b) {
  if (!mesh.frozen || !mesh.support[a].frozen() || !mesh.support[b].frozen()) return false;
  return contains(mesh.frozen->edges, {a, b});
}

template <int Dim>
bool is_frozen_facet(const Mesh<Dim>& mesh, FacetCorners<Dim> v) {
  if constexpr (Dim == 2) return is_frozen_edge(mesh, v[0], v[1]);
  return mesh.frozen && all_frozen(mesh, v) && contains(mesh.frozen->facets, v);
}

template <int Dim>
bool is_frozen_cell(const Mesh<Dim>& mesh, Corners<Dim> v) {
  return mesh.frozen && all_frozen(mesh, v) && contains(mesh.frozen->cells, v);
}

template <int Dim>
bool must_stay(const Mesh<Dim>& mesh, CellId c, int f) {
  if (!mesh.frozen) return false;
  if (is_frozen_facet(mesh, mesh.facet_vertices(c, f))) return true;
  if constexpr (Dim == 3)
    for (int e = 0; e < 12; ++e) {
      const int from = Cell<3>::edge_from(e), to = Cell<3>::edge_to(e);
      if (!Cell<3>::corner_on_facet(from, f) || !Cell<3>::corner_on_facet(to, f) || !is_frozen_edge(mesh, {c, e}))
        continue;
      bool by_itself = true;  // no frozen facet on the boundary has it
      for_each_cell_at_edge(mesh, {c, e}, [&](CellId n, int at) {
        for (int g = 0; g < 6; ++g)
          if (Cell<3>::corner_on_facet(Cell<3>::edge_from(at), g) &&
              Cell<3>::corner_on_facet(Cell<3>::edge_to(at), g) && mesh.on_boundary(n, g) &&
              is_frozen_facet(mesh, mesh.facet_vertices(n, g)))
            by_itself = false;
      });
      if (by_itself) return true;
    }
  return false;
}

template <int Dim>
bool frozen_remain(const Mesh<Dim>& mesh, const std::vector<Corners<Dim>>& old_cells) {
  if (!mesh.frozen) return true;
  for (const auto& cell : old_cells) {
    for (int e = 0; e < Cell<Dim>::edges; ++e) {
      const auto v = edge_of<Dim>(cell, e);
      if (is_frozen_edge(mesh, v[0], v[1]) && !edge_exists(mesh, v)) return false;
    }
    if constexpr (Dim == 3)
      for (int f = 0; f < 6; ++f) {
        const auto v = facet_of<3>(cell, f);
        if (is_frozen_facet(mesh, v) && !facet_exists(mesh, v)) return false;
      }
    if (is_frozen_cell(mesh, cell) && !any_cell_at(mesh, cell[0], [&](const Corners<Dim>& now) { return now == cell; }))
      return false;
  }
  return true;
}

#define PILLOWMESH_INSTANTIATE(Dim)                                                           \
  template Status freeze(Mesh<Dim>&, const MeshInput<Dim>&, const std::vector<std::string>&); \
  template void list_frozen(const Mesh<Dim>&, const std::vector<Index>&, MeshInput<Dim>&);    \
  template bool is_frozen_edge(const Mesh<Dim>&, VertexId, VertexId);                         \
  template bool is_frozen_facet(const Mesh<Dim>&, FacetCorners<Dim>);                         \
  template bool is_frozen_cell(const Mesh<Dim>&, Corners<Dim>);                               \
  template bool must_stay(const Mesh<Dim>&, CellId, int);                                     \
  template bool frozen_remain(const Mesh<Dim>&, const std::vector<Corners<Dim>>&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
