#include "pillowmesh/reconnect/boundary_open.h"

#include "pillowmesh/mesh/ordered_star.h"
#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {

bool plan_boundary_opening(const Mesh<2>& mesh, CellId c, int i, bool turned, Cavity& cavity) {
  const VertexId v = around(mesh, c, i), r = around(mesh, c, i + 1), p = around(mesh, c, i + 2),
                 q = around(mesh, c, i + 3);
  OrderedStar star;
  if (mesh.support[v].dim > 1 || !find_star(mesh, v, star) || star.closed) return false;
  const bool corner = mesh.support[v].dim == 0;
  int at = 0;
  while (star.cell[at] != c) ++at;
  // A corner needs one cell, a vertex on a curve two.
  const int cells_of_b = at + 1, cells_of_a = star.count - at;
  if (cells_of_a < (corner && !turned ? 1 : 2) || cells_of_b < (corner && turned ? 1 : 2)) return false;

  // The boundary edges beside v: to `next` from the first cell, from `previous` to the last.
  const CellId first = star.cell[0], last = star.cell[star.count - 1];
  const int first_side = star.place[0], last_side = star.place[star.count - 1] + 3;
  const VertexId next = around(mesh, first, first_side + 1), previous = around(mesh, last, last_side);
  const Point<2>& x = mesh.points[v];
  const Point<2> forth = (mesh.points[next] - x) / 3, back = (mesh.points[previous] - x) / 3;

  cavity.clear();
  // The corner stays as v; else v stays in the middle.
  VertexId a = v, middle = v, b = v;
  bool good = true;
  const auto add = [&](const Point<2>& where, CellId cell, int side) {
    Cavity::NewVertex n{where, {1, mesh.patch_of(cell, kSideFacet[side & 3])}, kNone};
    n.anchor = anchor_on(mesh, n.support, v, where);
    good = good && n.anchor != kNone;
    if (good) n.point = slide(*mesh.geometry, n.support, n.anchor, where);
    cavity.new_vertices.push_back(n);
    return Cavity::new_vertex(static_cast<int>(cavity.new_vertices.size()) - 1);
  };
  if (corner && !turned) {
    middle = add(x + forth, first, first_side);
    b = add(x + 2 * forth, first, first_side);
  } else if (corner) {
    a = add(x + 2 * back, last, last_side);
    middle = add(x + back, last, last_side);
  } else {
    a = add(x + back, last, last_side);
    b = add(x + forth, first, first_side);
  }
  if (!good) return false;
  // Boundary from `previous` to `next`, as sides that are divided one after the other.
  if (a != v) cavity.split_sides.push_back({previous, a, v});
  if (a != v && middle != v) cavity.split_sides.push_back({a, middle, v});
  if (b != v && middle != v) cavity.split_sides.push_back({v, middle, next});
  if (b != v) cavity.split_sides.push_back({middle, b, next});

  for (int k = 0; k < star.count; ++k) {
    const CellId s = star.cell[k];
    if (mesh.region[s] != mesh.region[c]) return false;
    cavity.old_cells.push_back(s);
    if (k == at) {
      cavity.new_cells.push_back(quad(a, middle, p, q));
      cavity.new_cells.push_back(quad(middle, b, r, p));
      continue;
    }
    Corners<2> corners = mesh.cells[s];
    corners[kAround[star.place[k]]] = k < at ? b : a;
    cavity.new_cells.push_back(corners);
  }
  cavity.around = {v, q, p, r};
  for (int k = 0; k <= star.count; ++k) {
    const VertexId end = k < star.count ? around(mesh, star.cell[k], star.place[k] + 1) : previous;
    if (end != q && end != r) cavity.around.push_back(end);
  }
  return true;
}

}  // namespace pillowmesh
