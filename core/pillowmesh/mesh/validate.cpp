#include "pillowmesh/mesh/validate.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/defect_text.h"
#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/overlap.h"
#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {
using detail::boundary_facets;
using detail::cell_name;
using detail::centroid;
using detail::place;

template <int Dim>
std::vector<Defect> find_cell_defects(const Mesh<Dim>& mesh, int most) {
  using C = Cell<Dim>;
  std::vector<Defect> out;
  const auto report = [&](Defect::Kind kind, CellId c, VertexId v, std::string text) {
    if (static_cast<int>(out.size()) < most) out.push_back({kind, c, v, std::move(text)});
  };
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    const auto name = [&] { return cell_name<Dim>(c); };
    bool in_range = true, twice = false;
    for (int i = 0; i < C::corners; ++i) {
      in_range = in_range && mesh.cells[c][i] >= 0 && mesh.cells[c][i] < mesh.vertex_count();
      for (int j = 0; j < i; ++j) twice = twice || mesh.cells[c][i] == mesh.cells[c][j];
    }
    if (!in_range) {
      report(Defect::Kind::index_out_of_range, c, kNone, name() + " names a vertex that does not exist");
      continue;
    }
    if (twice) {
      report(Defect::Kind::degenerate_cell, c, kNone, name() + " is degenerate: it names a vertex twice");
      continue;
    }
    const auto position = [&](int i) -> const Point<Dim>& { return mesh.points[mesh.cells[c][i]]; };
    int inverted = 0, worst = 0;
    for (int k = 0; k < C::corners; ++k)
      if (!(corner_jacobian<Dim>(k, position) > 0)) {
        ++inverted;
        worst = k;
      }
    if (inverted == 0) continue;
    const VertexId v = mesh.cells[c][worst];
    report(Defect::Kind::inverted_corner, c, v,
           inverted == C::corners ? name() + " at " + place<Dim>(centroid(mesh, c)) +
                                        " is inside out: all its corner Jacobians are negative or zero"
                                  : name() + " is inverted or degenerate: its corner Jacobian at vertex " +
                                        std::to_string(v) + " " + place<Dim>(mesh.points[v]) + " is not positive");
  }
  return out;
}

template <int Dim>
std::vector<Defect> find_adjacency_defects(const Mesh<Dim>& mesh, int most) {
  using C = Cell<Dim>;
  std::vector<Defect> out;
  const auto report = [&](Defect::Kind kind, CellId c, VertexId v, std::string text) {
    if (static_cast<int>(out.size()) < most) out.push_back({kind, c, v, std::move(text)});
  };
  if (mesh.twins.size() != mesh.cells.size() || mesh.vertex_cell.size() != mesh.points.size()) {
    report(Defect::Kind::broken_adjacency, kNone, kNone, "the adjacency arrays do not have the size of the mesh");
    return out;
  }
  std::vector<Index> valence(mesh.points.size(), 0);
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    for (const VertexId v : mesh.cells[c]) ++valence[v];
    for (int f = 0; f < C::facets; ++f) {
      const HalfFacetId twin = mesh.twins[c][f];
      if (twin < 0) continue;
      const CellId n = mesh.cell_of(twin);
      bool matches =
          n < mesh.cell_count() && mesh.alive(n) && mesh.twins[n][mesh.facet_of(twin)] == mesh.half_facet(c, f);
      if (matches) {
        auto a = mesh.facet_vertices(c, f), b = mesh.facet_vertices(n, mesh.facet_of(twin));
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        matches = a == b;
      }
      if (!matches) {
        report(Defect::Kind::broken_adjacency, c, kNone,
               "the neighbour of " + cell_name<Dim>(c) + " across facet " + std::to_string(f) + " does not match");
        continue;
      }
      for (int g = 0; g < f; ++g)
        if (mesh.neighbour(c, g) == n && c < n)
          report(Defect::Kind::shared_facets, c, kNone,
                 cell_name<Dim>(c) + " and " + cell_name<Dim>(n) + " share two " + (Dim == 2 ? "edges" : "facets"));
    }
  }
  if (!out.empty()) return out;
  if constexpr (Dim == 3) {
    struct Side {
      std::array<VertexId, 2> ends;
      CellId cell;
    };
    std::vector<Side> sides;
    for (const HalfFacetId h : boundary_facets(mesh)) {
      const auto v = mesh.facet_vertices(mesh.cell_of(h), mesh.facet_of(h));
      constexpr int cycle[5] = {0, 1, 3, 2, 0};
      for (int i = 0; i < 4; ++i) {
        const auto [a, b] = std::minmax(v[cycle[i]], v[cycle[i + 1]]);
        sides.push_back({{a, b}, mesh.cell_of(h)});
      }
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.ends != b.ends ? a.ends < b.ends : a.cell < b.cell; });
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
      std::string cells;
      while (j < sides.size() && sides[j].ends == sides[i].ends) ++j;
      if (j - i == 2) continue;
      for (std::size_t k = i; k < j; ++k)
        if (k == i || sides[k].cell != sides[k - 1].cell) cells += (k == i ? "" : ", ") + cell_name<Dim>(sides[k].cell);
      const auto [a, b] = sides[i].ends;
      report(Defect::Kind::non_manifold_edge, sides[i].cell, a,
             std::to_string(j - i) + " boundary facets, of " + cells + ", meet at the edge of vertices " +
                 std::to_string(a) + " and " + std::to_string(b) + " at " + place<Dim>(mesh.points[a]) +
                 ", where a surface has two");
    }
  }
  std::vector<CellCorner> star;
  std::vector<VertexId> touching;  // ascending
  std::vector<CellId> touching_cell;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (valence[v] == 0) {
      if (mesh.vertex_cell[v] != kNone)
        report(Defect::Kind::broken_adjacency, kNone, v,
               "vertex " + std::to_string(v) + " belongs to no cell but names one");
      continue;
    }
    const CellId c = mesh.vertex_cell[v];
    if (c < 0 || c >= mesh.cell_count() || !mesh.alive(c) || corner_of(mesh, c, v) < 0) {
      report(Defect::Kind::broken_adjacency, c, v,
             "vertex " + std::to_string(v) + " names a cell that it is not a corner of");
      continue;
    }
    vertex_star(mesh, v, star);
    if (static_cast<Index>(star.size()) == valence[v]) continue;
    touching.push_back(v);
    touching_cell.push_back(c);
  }
  if (touching.empty()) return out;
  // A cell on the other side of each of them: the first that the walk from vertex_cell does not reach.
  std::vector<CellId> other(touching.size(), kNone);
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    for (const VertexId v : mesh.cells[c]) {
      const auto at = std::lower_bound(touching.begin(), touching.end(), v) - touching.begin();
      if (at == static_cast<std::ptrdiff_t>(touching.size()) || touching[at] != v || other[at] != kNone) continue;
      vertex_star(mesh, v, star);
      if (std::none_of(star.begin(), star.end(), [&](const CellCorner& s) { return s.cell == c; })) other[at] = c;
    }
  }
  for (std::size_t i = 0; i < touching.size(); ++i)
    report(Defect::Kind::non_manifold_vertex, touching_cell[i], touching[i],
           "the cells at vertex " + std::to_string(touching[i]) + " " + place<Dim>(mesh.points[touching[i]]) +
               " are not all connected through facets (" + cell_name<Dim>(touching_cell[i]) + " and " +
               cell_name<Dim>(other[i]) + " are not): the mesh touches itself there, or its nodes are not merged");
  return out;
}

template <int Dim>
std::vector<Defect> find_inside_defects(const Mesh<Dim>& mesh, int most) {
  std::vector<Defect> out;
  if constexpr (Dim == 3) {
    for (CellId c = 0; c < mesh.cell_count() && static_cast<int>(out.size()) < most; ++c) {
      if (!mesh.alive(c) || !(min_corner_jacobian(mesh, c) > 0)) continue;
      const auto position = [&](int i) -> const Point<3>& { return mesh.points[mesh.cells[c][i]]; };
      for (int i = 0; i < 27; ++i) {
        const std::array<double, 3> at{i % 3 * 0.5, i / 3 % 3 * 0.5, i / 9 * 0.5};
        if (jacobian_at(at, position) > 0) continue;
        out.push_back({Defect::Kind::inverted_inside, c, kNone,
                       cell_name<3>(c) +
                           " is inverted inside: its corner Jacobians are positive, but not the Jacobian "
                           "at local coordinates " +
                           place<3>(Point<3>(at[0], at[1], at[2]))});
        break;
      }
    }
  }
  return out;
}

template <int Dim>
std::vector<Defect> find_overlaps(const Mesh<Dim>& mesh, int most) {
  std::vector<Defect> out;
  if constexpr (Dim == 2) {
    OrderedStar star;
    for (VertexId v = 0; v < mesh.vertex_count() && static_cast<int>(out.size()) < most; ++v)
      if (find_star(mesh, v, star) && overlaps(mesh, v, star))
        out.push_back({Defect::Kind::overlapping_cells, mesh.vertex_cell[v], v,
                       "the cells at vertex " + std::to_string(v) + " " + place<2>(mesh.points[v]) + " overlap"});
  }
  return out;
}

template <int Dim>
std::vector<Defect> find_defects(const Mesh<Dim>& mesh, int most) {
  std::vector<Defect> out = find_cell_defects(mesh, most);
  const bool cells_hold = out.empty();
  const auto extend = [&](std::vector<Defect> more) {
    for (auto& d : more)
      if (static_cast<int>(out.size()) < most) out.push_back(std::move(d));
  };
  const bool indices_hold =
      std::none_of(out.begin(), out.end(), [](const Defect& d) { return d.kind == Defect::Kind::index_out_of_range; });
  if (!indices_hold) return out;
  auto adjacency = find_adjacency_defects(mesh, most);
  const bool connected = adjacency.empty();
  extend(std::move(adjacency));
  if (connected) extend(find_support_defects(mesh, most));
  if (connected) extend(find_hanging_nodes(mesh, most));
  if (connected && cells_hold) extend(find_overlaps(mesh, most));
  return out;
}

template <int Dim>
std::string describe(const std::vector<Defect>& defects, int most, std::span<const Index> cell_lines) {
  constexpr std::size_t named = 8;
  const CellId first = defects[0].cell;
  std::string text = defects[0].message;
  if (first != kNone && static_cast<std::size_t>(first) < cell_lines.size())
    text += " (line " + std::to_string(cell_lines[first]) + ")";
  if (defects.size() == 1) return text;
  std::vector<CellId> others;
  for (const Defect& d : defects)
    if (d.cell != kNone && d.cell != first) others.push_back(d.cell);
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  text += static_cast<int>(defects.size()) == most ? "; at least " : "; ";
  text += std::to_string(defects.size() - 1) + (defects.size() == 2 ? " more defect" : " more defects");
  const std::string cells = Dim == 2 ? "quad" : "hex";
  for (std::size_t i = 0; i < std::min(others.size(), named); ++i)
    text += (i > 0 ? ", " : ", in " + cells + (others.size() == 1 ? " " : Dim == 2 ? "s " : "es ")) +
            std::to_string(others[i]);
  if (others.size() > named) text += ", ...";
  return text;
}

template <int Dim>
Status validate(const Mesh<Dim>& mesh) {
  constexpr int most = 1000;
  const auto defects = find_defects(mesh, most);
  return defects.empty() ? Status{} : Status::bad_input(describe<Dim>(defects, most));
}

#define PILLOWMESH_INSTANTIATE(Dim)                                                            \
  template std::vector<Defect> find_cell_defects(const Mesh<Dim>&, int);                       \
  template std::vector<Defect> find_adjacency_defects(const Mesh<Dim>&, int);                  \
  template std::vector<Defect> find_overlaps(const Mesh<Dim>&, int);                           \
  template std::vector<Defect> find_defects(const Mesh<Dim>&, int);                            \
  template std::vector<Defect> find_inside_defects(const Mesh<Dim>&, int);                     \
  template std::string describe<Dim>(const std::vector<Defect>&, int, std::span<const Index>); \
  template Status validate(const Mesh<Dim>&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
