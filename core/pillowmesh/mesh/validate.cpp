#include "pillowmesh/mesh/validate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {
namespace {

template <int Dim>
std::string cell_word() {
  return Dim == 2 ? "quad " : "hex ";
}

template <int Dim>
std::string place(const Point<Dim>& p) {
  std::string text = "(";
  for (int d = 0; d < Dim; ++d) {
    char number[32];
    std::snprintf(number, sizeof number, "%.6g", p[d]);
    text += (d ? ", " : "") + std::string(number);
  }
  return text + ")";
}

template <int Dim>
Point<Dim> centroid(const Mesh<Dim>& mesh, CellId c) {
  Point<Dim> sum = Point<Dim>::Zero();
  for (const VertexId v : mesh.cells[c]) sum += mesh.points[v];
  return sum / Cell<Dim>::corners;
}

/// Boundary half-facets of a connected mesh.
template <int Dim>
std::vector<HalfFacetId> boundary_facets(const Mesh<Dim>& mesh) {
  std::vector<HalfFacetId> out;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    if (mesh.alive(c))
      for (int f = 0; f < Cell<Dim>::facets; ++f)
        if (mesh.on_boundary(c, f)) out.push_back(mesh.half_facet(c, f));
  return out;
}

/// True if p lies in the interior of facet v, or of one of its edges, within `slack` times its size.
bool inside_facet(const std::vector<Point<2>>& points, const FacetCorners<2>& v, const Point<2>& p) {
  constexpr double slack = 1e-6;
  const Point<2> e = points[v[1]] - points[v[0]], q = p - points[v[0]];
  const double length2 = e.squaredNorm(), t = e.dot(q) / length2;
  return t > slack && t < 1 - slack && std::abs(cross(e, q)) < slack * length2;
}
bool inside_facet(const std::vector<Point<3>>& points, const FacetCorners<3>& v, const Point<3>& p) {
  // Two triangles about the diagonal 0-3; a quad that is not flat is met nearly, which suffices for hanging nodes.
  constexpr double slack = 1e-6;
  for (const int middle : {1, 2}) {
    const Point<3> a = points[v[middle]] - points[v[0]], b = points[v[3]] - points[v[0]], q = p - points[v[0]];
    const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), qa = q.dot(a), qb = q.dot(b);
    const double det = aa * bb - ab * ab;
    if (!(det > 0)) continue;
    const double s = (bb * qa - ab * qb) / det, t = (aa * qb - ab * qa) / det;
    if (s < -slack || t < -slack || s + t > 1 + slack) continue;
    if ((q - s * a - t * b).squaredNorm() > slack * slack * (aa + bb)) continue;
    bool at_corner = false;
    for (const VertexId w : v) at_corner = at_corner || (points[w] - p).squaredNorm() < slack * slack * (aa + bb);
    if (!at_corner) return true;
  }
  return false;
}

}  // namespace

template <int Dim>
std::vector<Defect> find_cell_defects(const Mesh<Dim>& mesh, int most) {
  using C = Cell<Dim>;
  std::vector<Defect> out;
  const auto report = [&](Defect::Kind kind, CellId c, VertexId v, std::string text) {
    if (static_cast<int>(out.size()) < most) out.push_back({kind, c, v, std::move(text)});
  };
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    const std::string name = cell_word<Dim>() + std::to_string(c);
    bool in_range = true, twice = false;
    for (int i = 0; i < C::corners; ++i) {
      in_range = in_range && mesh.cells[c][i] >= 0 && mesh.cells[c][i] < mesh.vertex_count();
      for (int j = 0; j < i; ++j) twice = twice || mesh.cells[c][i] == mesh.cells[c][j];
    }
    if (!in_range) {
      report(Defect::Kind::index_out_of_range, c, kNone, name + " names a vertex that does not exist");
      continue;
    }
    if (twice) {
      report(Defect::Kind::degenerate_cell, c, kNone, name + " is degenerate: it names a vertex twice");
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
           inverted == C::corners
               ? name + " at " + place<Dim>(centroid(mesh, c)) + " is inside out: all its corner Jacobians are negative or zero"
               : name + " is inverted or degenerate: its corner Jacobian at vertex " + std::to_string(v) + " " +
                     place<Dim>(mesh.points[v]) + " is not positive");
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
    const std::string name = cell_word<Dim>() + std::to_string(c);
    for (const VertexId v : mesh.cells[c]) ++valence[v];
    for (int f = 0; f < C::facets; ++f) {
      const HalfFacetId twin = mesh.twins[c][f];
      if (twin < 0) continue;
      const CellId n = mesh.cell_of(twin);
      bool matches = n < mesh.cell_count() && mesh.alive(n) && mesh.twins[n][mesh.facet_of(twin)] == mesh.half_facet(c, f);
      if (matches) {
        auto a = mesh.facet_vertices(c, f), b = mesh.facet_vertices(n, mesh.facet_of(twin));
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        matches = a == b;
      }
      if (!matches) {
        report(Defect::Kind::broken_adjacency, c, kNone, "the neighbour of " + name + " across facet " + std::to_string(f) + " does not match");
        continue;
      }
      for (int g = 0; g < f; ++g)
        if (mesh.neighbour(c, g) == n)
          report(Defect::Kind::shared_facets, c, kNone,
                 name + " and " + cell_word<Dim>() + std::to_string(n) + " share two " + (Dim == 2 ? "edges" : "facets"));
    }
  }
  if (!out.empty()) return out;
  std::vector<CellCorner> star;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (valence[v] == 0) {
      if (mesh.vertex_cell[v] != kNone)
        report(Defect::Kind::broken_adjacency, kNone, v, "vertex " + std::to_string(v) + " belongs to no cell but names one");
      continue;
    }
    const CellId c = mesh.vertex_cell[v];
    if (c < 0 || c >= mesh.cell_count() || !mesh.alive(c) || corner_of(mesh, c, v) < 0) {
      report(Defect::Kind::broken_adjacency, c, v, "vertex " + std::to_string(v) + " names a cell that it is not a corner of");
      continue;
    }
    vertex_star(mesh, v, star);
    if (static_cast<Index>(star.size()) != valence[v])
      report(Defect::Kind::non_manifold_vertex, c, v,
             "the cells at vertex " + std::to_string(v) + " " + place<Dim>(mesh.points[v]) +
                 " are not all connected through facets: the mesh touches itself there, or its nodes are not merged");
  }
  if constexpr (Dim == 3) {
    std::vector<std::array<VertexId, 2>> edges;
    for (const HalfFacetId h : boundary_facets(mesh)) {
      const auto v = mesh.facet_vertices(mesh.cell_of(h), mesh.facet_of(h));
      constexpr int cycle[5] = {0, 1, 3, 2, 0};
      for (int i = 0; i < 4; ++i)
        edges.push_back({std::min(v[cycle[i]], v[cycle[i + 1]]), std::max(v[cycle[i]], v[cycle[i + 1]])});
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
      while (j < edges.size() && edges[j] == edges[i]) ++j;
      if (j - i != 2)
        report(Defect::Kind::non_manifold_edge, mesh.vertex_cell[edges[i][0]], edges[i][0],
               std::to_string(j - i) + " boundary facets meet at the edge of vertices " + std::to_string(edges[i][0]) +
                   " and " + std::to_string(edges[i][1]) + ", where a surface has two");
    }
  }
  return out;
}

template <int Dim>
std::vector<Defect> find_hanging_nodes(const Mesh<Dim>& mesh, int most) {
  std::vector<Defect> out;
  const auto facets = boundary_facets(mesh);
  if (facets.empty()) return out;
  std::vector<VertexId> vertices;
  Point<Dim> low = Point<Dim>::Constant(INFINITY), high = -low;
  for (const HalfFacetId h : facets)
    for (const VertexId v : mesh.facet_vertices(mesh.cell_of(h), mesh.facet_of(h))) {
      vertices.push_back(v);
      low = low.cwiseMin(mesh.points[v]);
      high = high.cwiseMax(mesh.points[v]);
    }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  // Boundary vertices in the boxes of a uniform grid with about as many boxes.
  const double per_axis = std::floor(std::pow(static_cast<double>(vertices.size()), 1.0 / Dim)) + 1.0;
  const auto box = [&](double x, int d) {
    const double extent = high[d] - low[d];
    const double i = extent > 0 ? std::floor((x - low[d]) / extent * per_axis) : 0.0;
    return static_cast<Index>(std::min(std::max(i, 0.0), per_axis - 1));
  };
  const Index n = static_cast<Index>(per_axis);
  const auto box_of = [&](const std::array<Index, Dim>& i) {
    Index at = 0;
    for (int d = 0; d < Dim; ++d) at = at * n + i[d];
    return at;
  };
  std::vector<std::array<Index, 2>> boxed;  // box, vertex
  for (const VertexId v : vertices) {
    std::array<Index, Dim> i;
    for (int d = 0; d < Dim; ++d) i[d] = box(mesh.points[v][d], d);
    boxed.push_back({box_of(i), v});
  }
  std::sort(boxed.begin(), boxed.end());

  for (const HalfFacetId h : facets) {
    const CellId c = mesh.cell_of(h);
    const auto facet = mesh.facet_vertices(c, mesh.facet_of(h));
    Point<Dim> a = mesh.points[facet[0]], b = a;
    for (const VertexId v : facet) {
      a = a.cwiseMin(mesh.points[v]);
      b = b.cwiseMax(mesh.points[v]);
    }
    std::array<Index, Dim> first, last, i;
    for (int d = 0; d < Dim; ++d) {
      const double margin = 1e-6 * (high[d] - low[d]);
      first[d] = box(a[d] - margin, d);
      last[d] = box(b[d] + margin, d);
    }
    i = first;
    while (true) {
      const Index at = box_of(i);
      for (auto it = std::lower_bound(boxed.begin(), boxed.end(), std::array<Index, 2>{at, 0});
           it != boxed.end() && (*it)[0] == at; ++it) {
        const VertexId v = (*it)[1];
        if (std::find(facet.begin(), facet.end(), v) != facet.end()) continue;
        if (!inside_facet(mesh.points, facet, mesh.points[v])) continue;
        if (static_cast<int>(out.size()) < most)
          out.push_back({Defect::Kind::hanging_node, c, v,
                         "vertex " + std::to_string(v) + " " + place<Dim>(mesh.points[v]) + " hangs on a facet of " +
                             cell_word<Dim>() + std::to_string(c) + ": the mesh is not conforming there"});
      }
      int d = Dim - 1;
      while (d >= 0 && ++i[d] > last[d]) i[d] = first[d], --d;
      if (d < 0) break;
    }
  }
  return out;
}

template <int Dim>
std::vector<Defect> find_support_defects(const Mesh<Dim>& mesh, int most) {
  std::vector<Defect> out;
  const auto report = [&](VertexId v, const char* what) {
    if (static_cast<int>(out.size()) < most)
      out.push_back({Defect::Kind::broken_support, mesh.vertex_cell[v], v,
                     "vertex " + std::to_string(v) + " " + place<Dim>(mesh.points[v]) + " " + what});
  };
  // The patches at each boundary vertex: none, one, or several.
  constexpr Index several = -2;
  std::vector<Index> patches(mesh.points.size(), kNone);
  for (const HalfFacetId h : boundary_facets(mesh)) {
    const CellId c = mesh.cell_of(h);
    const PatchId p = mesh.patch_of(c, mesh.facet_of(h));
    for (const VertexId v : mesh.facet_vertices(c, mesh.facet_of(h)))
      patches[v] = patches[v] == kNone || patches[v] == p ? p : several;
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.vertex_cell[v] == kNone) continue;
    const VertexSupport s = mesh.support[v];
    if (patches[v] == kNone && s.dim != Dim) report(v, "is inside but classified as a boundary vertex");
    if (patches[v] != kNone && s.dim == Dim) report(v, "is on the boundary but classified as inside");
    if (s.dim == Dim - 1 && patches[v] != s.entity) report(v, "is not on the one patch that it is classified on");
    if (Dim == 3 && s.dim == 1 && patches[v] != several) report(v, "is on a feature curve but not between patches");
  }
  return out;
}

template <int Dim>
std::vector<Defect> find_defects(const Mesh<Dim>& mesh, int most) {
  std::vector<Defect> out = find_cell_defects(mesh, most);
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
  return out;
}

template <int Dim>
Status validate(const Mesh<Dim>& mesh) {
  const auto defects = find_defects(mesh, 1000);
  if (defects.empty()) return {};
  std::string text = defects[0].message;
  if (defects.size() > 1)
    text += " (and " + std::to_string(defects.size() - 1) + (defects.size() == 2 ? " more defect)" : " more defects)");
  return Status::bad_input(text);
}

#define PILLOWMESH_INSTANTIATE(Dim)                                               \
  template std::vector<Defect> find_cell_defects(const Mesh<Dim>&, int);          \
  template std::vector<Defect> find_adjacency_defects(const Mesh<Dim>&, int);     \
  template std::vector<Defect> find_hanging_nodes(const Mesh<Dim>&, int);         \
  template std::vector<Defect> find_support_defects(const Mesh<Dim>&, int);       \
  template std::vector<Defect> find_defects(const Mesh<Dim>&, int);               \
  template Status validate(const Mesh<Dim>&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
