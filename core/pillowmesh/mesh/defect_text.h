// Words and places that the sentences of validate share. Private to mesh/.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/number.h"

namespace pillowmesh::detail {

/// "quad 7" or "hex 7".
template <int Dim>
std::string cell_name(CellId c) {
  return (Dim == 2 ? "quad " : "hex ") + std::to_string(c);
}

/// "(x, y, z)" with six digits.
template <int Dim>
std::string place(const Point<Dim>& p) {
  std::string text = "(";
  for (int d = 0; d < Dim; ++d) text += (d ? ", " : "") + rounded_text(p[d], 6);
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

}  // namespace pillowmesh::detail
