#include "pillowmesh/coarsen/partial_chord_collapse.h"

#include <algorithm>

namespace pillowmesh {
namespace {

bool contains(const std::vector<Index>& some, Index one) { return std::find(some.begin(), some.end(), one) != some.end(); }

}  // namespace

bool plan_partial_chord_collapse(const Mesh<2>& mesh, const std::vector<ChordCell>& part, int way, Cavity& cavity) {
  cavity.clear();
  for (const auto& [c, side] : part) {
    if (contains(cavity.old_cells, c)) return false;
    cavity.old_cells.push_back(c);
    VertexId drop = around(mesh, c, way == 0 ? side + 1 : side), keep = around(mesh, c, way == 0 ? side + 3 : side + 2);
    if (mesh.support[drop].dim != 2) std::swap(drop, keep);
    if (mesh.support[drop].dim != 2) return false;
    for (const VertexId v : {drop, keep})
      if (contains(cavity.removed, v) || contains(cavity.merged_into, v)) return false;
    cavity.removed.push_back(drop);
    cavity.merged_into.push_back(keep);
    cavity.around.push_back(keep);
    if (mesh.support[keep].dim != 2) continue;
    cavity.moved.push_back(keep);
    cavity.moved_to.push_back(0.5 * (mesh.points[keep] + mesh.points[drop]));
  }
  const std::size_t inside = cavity.old_cells.size();
  OrderedStar star;
  for (std::size_t i = 0; i < cavity.removed.size(); ++i) {
    if (!find_star(mesh, cavity.removed[i], star) || !star.closed) return false;
    for (int n = 0; n < star.count; ++n)
      if (!contains(cavity.old_cells, star.cell[n])) cavity.old_cells.push_back(star.cell[n]);
  }
  for (std::size_t k = 0; k < cavity.old_cells.size(); ++k) {
    if (mesh.region[cavity.old_cells[k]] != mesh.region[cavity.old_cells[0]]) return false;
    Corners<2> corners = mesh.cells[cavity.old_cells[k]];
    for (VertexId& v : corners) {
      const auto at = std::find(cavity.removed.begin(), cavity.removed.end(), v);
      if (at != cavity.removed.end()) v = cavity.merged_into[at - cavity.removed.begin()];
      if (!contains(cavity.around, v)) cavity.around.push_back(v);
    }
    if (k < inside) continue;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j)
        if (corners[i] == corners[j]) return false;
    cavity.new_cells.push_back(corners);
  }
  return true;
}

}  // namespace pillowmesh
