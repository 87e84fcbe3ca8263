#include "pillowmesh/coarsen/boundary_collapse.h"

#include "pillowmesh/mesh/ordered_star.h"

namespace pillowmesh {

bool plan_boundary_collapse(const Mesh<2>& mesh, VertexId v, Cavity& cavity) {
  OrderedStar star;
  if (mesh.support[v].dim != 1 || !find_star(mesh, v, star) || star.closed || star.count != 2) return false;
  // Counterclockwise around v: the cell at b, then the one at a.
  const CellId at_b = star.cell[0], at_a = star.cell[1];
  const VertexId b = around(mesh, at_b, star.place[0] + 1), r = around(mesh, at_b, star.place[0] + 2),
                 p = around(mesh, at_b, star.place[0] + 3), q = around(mesh, at_a, star.place[1] + 2),
                 a = around(mesh, at_a, star.place[1] + 3);
  if (a == b || q == r || (mesh.support[a].dim == 0 && mesh.support[b].dim == 0)) return false;
  const VertexId keep = mesh.support[a].dim == 0 ? a : (mesh.support[b].dim == 0 ? b : v);

  cavity.clear();
  cavity.old_cells = {at_b, at_a};
  cavity.new_cells.push_back(quad(keep, r, p, q));
  cavity.around = {keep, r, p, q};
  VertexId before = kNone, after = kNone;  // on the boundary beyond a and b
  for (const VertexId d : {a, b}) {
    if (mesh.support[d].dim > 1 || !find_star(mesh, d, star) || star.closed) return false;
    (d == a ? before : after) = d == a ? around(mesh, star.cell[star.count - 1], star.place[star.count - 1] + 3)
                                       : around(mesh, star.cell[0], star.place[0] + 1);
    if (d == keep) continue;
    for (int k = 0; k < star.count; ++k) {
      const CellId c = star.cell[k];
      if (c == at_a || c == at_b) continue;
      Corners<2> corners = mesh.cells[c];
      for (const VertexId w : corners)
        if (w == v || (w != d && (w == a || w == b))) return false;
      corners[kAround[star.place[k]]] = keep;
      cavity.old_cells.push_back(c);
      cavity.new_cells.push_back(corners);
      for (const int side : {1, 3}) {
        const VertexId end = around(mesh, c, star.place[k] + side);
        if (end != r && end != q) cavity.around.push_back(end);
      }
    }
  }
  if (before == after) return false;
  for (const CellId c : cavity.old_cells)
    if (mesh.region[c] != mesh.region[at_a]) return false;
  for (const VertexId d : {a, v, b}) {
    if (d == keep) continue;
    cavity.removed.push_back(d);
    cavity.merged_into.push_back(keep);
  }
  return true;
}

}  // namespace pillowmesh
