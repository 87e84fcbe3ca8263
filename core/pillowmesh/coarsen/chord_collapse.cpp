#include "pillowmesh/coarsen/chord_collapse.h"

#include <algorithm>

#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {

bool plan_chord_collapse(const Mesh<2>& mesh, const Chord& chord, Cavity& cavity) {
  if (chord.crosses) return false;
  cavity.clear();
  const Index region = mesh.region[chord.cells[0].cell];
  for (const ChordCell& k : chord.cells) cavity.old_cells.push_back(k.cell);
  for (std::size_t k = 0; k < chord.rungs(); ++k) {
    auto [keep, drop] = rung(mesh, chord, k);
    if (mesh.support[drop].dim < mesh.support[keep].dim) std::swap(keep, drop);
    const VertexSupport &a = mesh.support[keep], &b = mesh.support[drop];
    if (b.dim < 2) {  // both on the boundary
      const bool end = !chord.closed && (k == 0 || k + 1 == chord.rungs());
      if (!end || b.dim == 0 || (a.dim == 1 && a.entity != b.entity)) return false;
    }
    if (a.dim == b.dim) {
      Point<2> middle = 0.5 * (mesh.points[keep] + mesh.points[drop]);
      if (a.dim == 1) {
        Index anchor = mesh.anchor[keep];
        middle = slide(*mesh.geometry, a, anchor, middle);
      }
      cavity.moved.push_back(keep);
      cavity.moved_to.push_back(middle);
    }
    cavity.removed.push_back(drop);
    cavity.merged_into.push_back(keep);
    cavity.around.push_back(keep);
  }
  // A vertex at two rungs: the chord touches itself.
  std::vector<VertexId> all(cavity.removed);
  all.insert(all.end(), cavity.around.begin(), cavity.around.end());
  std::sort(all.begin(), all.end());
  if (std::adjacent_find(all.begin(), all.end()) != all.end()) return false;

  QuadStar star;
  for (const VertexId d : cavity.removed) {
    if (!find_star(mesh, d, star)) return false;
    for (int n = 0; n < star.count; ++n) cavity.old_cells.push_back(star.cell[n]);
  }
  std::sort(cavity.old_cells.begin(), cavity.old_cells.end());
  cavity.old_cells.erase(std::unique(cavity.old_cells.begin(), cavity.old_cells.end()), cavity.old_cells.end());
  std::vector<CellId> inside;
  for (const ChordCell& k : chord.cells) inside.push_back(k.cell);
  std::sort(inside.begin(), inside.end());
  for (const CellId c : cavity.old_cells) {
    if (mesh.region[c] != region) return false;
    if (std::binary_search(inside.begin(), inside.end(), c)) continue;
    Corners<2> corners = mesh.cells[c];
    for (VertexId& v : corners) {
      const auto at = std::find(cavity.removed.begin(), cavity.removed.end(), v);
      if (at != cavity.removed.end()) v = cavity.merged_into[at - cavity.removed.begin()];
    }
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j)
        if (corners[i] == corners[j]) return false;
    cavity.new_cells.push_back(corners);
  }
  return !cavity.new_cells.empty();
}

}  // namespace pillowmesh
