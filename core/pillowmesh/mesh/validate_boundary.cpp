#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/defect_text.h"
#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/validate.h"

namespace pillowmesh {

using detail::boundary_facets;
using detail::cell_name;
using detail::place;

namespace {

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
                             cell_name<Dim>(c) + ": the mesh is not conforming there"});
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
    if (s.frozen()) continue;
    if (patches[v] == kNone && s.dim != Dim) report(v, "is inside but classified as a boundary vertex");
    if (patches[v] != kNone && s.dim == Dim) report(v, "is on the boundary but classified as inside");
    if (s.dim == Dim - 1 && patches[v] != s.entity) report(v, "is not on the one patch that it is classified on");
    if (Dim == 3 && s.dim == 1 && patches[v] != several) report(v, "is on a feature curve but not between patches");
  }
  return out;
}

#define PILLOWMESH_INSTANTIATE(Dim)                                       \
  template std::vector<Defect> find_hanging_nodes(const Mesh<Dim>&, int); \
  template std::vector<Defect> find_support_defects(const Mesh<Dim>&, int);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
