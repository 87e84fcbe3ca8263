#include "pillowmesh/coarsen/diagonal_collapse.h"

#include "pillowmesh/mesh/ordered_star.h"

namespace pillowmesh {

bool plan_diagonal_collapse(const Mesh<2>& mesh, CellId c, int i, Cavity& cavity) {
  const VertexId d = around(mesh, c, i), x = around(mesh, c, i + 1), k = around(mesh, c, i + 2),
                 y = around(mesh, c, i + 3);
  if (mesh.support[d].dim != 2) return false;
  OrderedStar star;
  if (!find_star(mesh, d, star) || !star.closed) return false;
  cavity.clear();
  cavity.old_cells.push_back(c);
  cavity.around = {k, x, y};
  for (int n = 0; n < star.count; ++n) {
    const CellId s = star.cell[n];
    if (mesh.region[s] != mesh.region[c]) return false;
    if (s == c) continue;
    if (place_of(mesh, s, k) >= 0) return false;  // d and k are joined by another cell as well
    Corners<2> corners = mesh.cells[s];
    corners[kAround[star.place[n]]] = k;
    cavity.old_cells.push_back(s);
    cavity.new_cells.push_back(corners);
    const VertexId end = around(mesh, s, star.place[n] + 1);
    if (end != x && end != y) cavity.around.push_back(end);
  }
  cavity.removed.push_back(d);
  cavity.merged_into.push_back(k);
  if (mesh.support[k].dim == 2) {
    cavity.moved.push_back(k);
    cavity.moved_to.push_back(0.5 * (mesh.points[k] + mesh.points[d]));
  }
  return true;
}

bool plan_doublet_removal(const Mesh<2>& mesh, VertexId v, Cavity& cavity) {
  OrderedStar star;
  if (mesh.support[v].dim != 2 || !find_star(mesh, v, star) || !star.closed || star.count != 2) return false;
  const CellId c = star.cell[0], n = star.cell[1];
  if (mesh.region[c] != mesh.region[n]) return false;
  const int i = star.place[0], j = star.place[1];
  cavity.clear();
  cavity.old_cells = {c, n};
  const VertexId a = around(mesh, c, i + 1), o = around(mesh, c, i + 2), b = around(mesh, c, i + 3),
                 p = around(mesh, n, j + 2);
  if (o == p) return false;
  cavity.new_cells = {quad(a, o, b, p)};
  cavity.removed.push_back(v);
  cavity.merged_into.push_back(kNone);
  cavity.around = {a, o, b, p};
  return true;
}

}  // namespace pillowmesh
