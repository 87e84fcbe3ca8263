#include "pillowmesh/reconnect/rotate.h"

#include "pillowmesh/mesh/ordered_star.h"

namespace pillowmesh {

bool plan_rotation(const Mesh<2>& mesh, CellId c, int side, int way, Cavity& cavity) {
  const HalfFacetId twin = twin_of_side(mesh, c, side);
  if (twin < 0) return false;
  const CellId n = mesh.cell_of(twin);
  if (n == c || mesh.region[n] != mesh.region[c]) return false;
  const int j = kFacetSide[mesh.facet_of(twin)];
  const VertexId a = around(mesh, c, side), b = around(mesh, c, side + 1), p = around(mesh, c, side + 2),
                 q = around(mesh, c, side + 3), r = around(mesh, n, j + 2), s = around(mesh, n, j + 3);
  if (p == r || q == s || p == s || q == r) return false;  // a doublet: the hexagon is none
  cavity.clear();
  cavity.old_cells = {c, n};
  if (way == 0)
    cavity.new_cells = {quad(p, q, a, r), quad(r, s, b, p)};
  else
    cavity.new_cells = {quad(q, a, r, s), quad(s, b, p, q)};
  cavity.around = {a, b, p, q, r, s};
  return true;
}

}  // namespace pillowmesh
