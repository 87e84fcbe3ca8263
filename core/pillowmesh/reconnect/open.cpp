#include "pillowmesh/reconnect/open.h"

namespace pillowmesh {

bool plan_opening(const Mesh<2>& mesh, VertexId v, const OrderedStar& star, int first, int last, Cavity& cavity) {
  const int turned = last - first;
  if (!star.closed || mesh.support[v].dim != 2 || turned < 2 || star.count - turned < 2) return false;
  cavity.clear();
  const auto spoke = [&](int k) { return around(mesh, star.cell[k % star.count], star.place[k % star.count] + 1); };
  const VertexId a = spoke(first), b = spoke(last);
  const VertexId w = Cavity::new_vertex(0);
  const Point<2>& x = mesh.points[v];
  // Both copies leave v toward the spokes that are theirs.
  Point<2> side = Point<2>::Zero(), other = Point<2>::Zero();
  for (int k = first + 1; k < last; ++k) side += mesh.points[spoke(k)] - x;
  for (int k = last + 1; k < first + star.count; ++k) other += mesh.points[spoke(k)] - x;
  side *= 0.25 / (turned - 1);
  other *= 0.25 / (star.count - turned - 1);
  for (int k = 0; k < star.count; ++k) {
    const CellId c = star.cell[k];
    if (mesh.region[c] != mesh.region[star.cell[0]]) return false;
    Corners<2> corners = mesh.cells[c];
    if (k >= first && k < last) corners[kAround[star.place[k]]] = w;
    cavity.old_cells.push_back(c);
    cavity.new_cells.push_back(corners);
  }
  cavity.new_cells.push_back(quad(v, a, w, b));
  cavity.new_vertices.push_back({x + side, mesh.support[v], kNone});
  cavity.moved.push_back(v);
  cavity.moved_to.push_back(x + other);
  cavity.around = {v, a, b};
  return true;
}

}  // namespace pillowmesh
