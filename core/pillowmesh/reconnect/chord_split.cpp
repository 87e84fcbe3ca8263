#include "pillowmesh/reconnect/chord_split.h"

#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {
namespace {

/// The curve that the boundary edge between a and b lies on: theirs, or, between two corners, that of its patch.
VertexSupport support_of_side(const Mesh<2>& mesh, CellId c, int side) {
  return {1, mesh.patch_of(c, kSideFacet[side & 3])};
}

}  // namespace

bool plan_chord_split(const Mesh<2>& mesh, const Chord& chord, Cavity& cavity) {
  if (chord.crosses) return false;
  cavity.clear();
  const std::size_t rungs = chord.rungs(), count = chord.cells.size();
  const auto middle = [&](std::size_t k) { return Cavity::new_vertex(static_cast<int>(k % rungs)); };
  for (std::size_t k = 0; k < rungs; ++k) {
    const auto [l, r] = rung(mesh, chord, k);
    Cavity::NewVertex n{0.5 * (mesh.points[l] + mesh.points[r]), {2, kNone}, kNone};
    if (!chord.closed && (k == 0 || k == count)) {
      const ChordCell at = k == 0 ? chord.cells.front() : chord.cells.back();
      n.support = support_of_side(mesh, at.cell, k == 0 ? at.side : at.side + 2);
      n.anchor = anchor_on(mesh, n.support, mesh.support[l].dim == 1 ? l : r, n.point);
      if (n.anchor == kNone) return false;
      n.point = slide(*mesh.geometry, n.support, n.anchor, n.point);
      if (k == 0)
        cavity.split_sides.push_back({l, middle(k), r});
      else
        cavity.split_sides.push_back({r, middle(k), l});
    }
    cavity.new_vertices.push_back(n);
    cavity.around.push_back(l);
    cavity.around.push_back(r);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const auto [c, side] = chord.cells[k];
    if (mesh.region[c] != mesh.region[chord.cells[0].cell]) return false;
    cavity.old_cells.push_back(c);
    const VertexId l = around(mesh, c, side), r = around(mesh, c, side + 1), r2 = around(mesh, c, side + 2),
                   l2 = around(mesh, c, side + 3);
    cavity.new_cells.push_back(quad(l, middle(k), middle(k + 1), l2));
    cavity.new_cells.push_back(quad(middle(k), r, r2, middle(k + 1)));
  }
  return true;
}

}  // namespace pillowmesh
