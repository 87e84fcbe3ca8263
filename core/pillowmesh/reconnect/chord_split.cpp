#include "pillowmesh/reconnect/chord_split.h"

#include <algorithm>

#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {
namespace {

/// The curve that the boundary edge between a and b lies on: theirs, or, between two corners, that of its patch.
VertexSupport support_of_side(const Mesh<2>& mesh, CellId c, int side) {
  return {1, mesh.patch_of(c, kSideFacet[side & 3])};
}

}  // namespace

bool plan_chord_split(const Mesh<2>& mesh, const Chord& chord, Cavity& cavity) {
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
  // The middles of each cell's sides: two where the chord passes once, four where it crosses itself.
  struct Pass {
    CellId cell;
    int side;
    VertexId in, out;
  };
  std::vector<Pass> passes;
  for (std::size_t k = 0; k < count; ++k)
    passes.push_back({chord.cells[k].cell, chord.cells[k].side, middle(k), middle(k + 1)});
  std::sort(passes.begin(), passes.end(), [](const Pass& a, const Pass& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.side < b.side;
  });
  for (std::size_t k = 0; k < count; ++k) {
    const auto [c, side, in, out] = passes[k];
    if (mesh.region[c] != mesh.region[chord.cells[0].cell]) return false;
    cavity.old_cells.push_back(c);
    const VertexId l = around(mesh, c, side), r = around(mesh, c, side + 1), r2 = around(mesh, c, side + 2),
                   l2 = around(mesh, c, side + 3);
    if (k + 1 == count || passes[k + 1].cell != c) {
      cavity.new_cells.push_back(quad(l, in, out, l2));
      cavity.new_cells.push_back(quad(in, r, r2, out));
      continue;
    }
    // The other pass enters through the right or the left side.
    const Pass& other = passes[++k];
    const bool from_right = other.side == ((side + 1) & 3);
    const VertexId right = from_right ? other.in : other.out, left = from_right ? other.out : other.in;
    const VertexId centre = Cavity::new_vertex(static_cast<int>(cavity.new_vertices.size()));
    cavity.new_vertices.push_back({0.25 * (mesh.points[l] + mesh.points[r] + mesh.points[r2] + mesh.points[l2]), {2, kNone}, kNone});
    cavity.new_cells.push_back(quad(l, in, centre, left));
    cavity.new_cells.push_back(quad(in, r, right, centre));
    cavity.new_cells.push_back(quad(centre, right, r2, out));
    cavity.new_cells.push_back(quad(left, centre, out, l2));
  }
  return true;
}

}  // namespace pillowmesh
