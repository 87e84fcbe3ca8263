// Dual chords: the quads that are met by leaving each through the side opposite to the one entered by.
#pragma once

#include <vector>

#include "pillowmesh/mesh/ordered_star.h"

namespace pillowmesh {

/// A quad of a chord, entered through `side` and left through the opposite one. Seen along the chord the entered side
/// runs from the left to the right vertex.
///
///      |  out  |
///      l-------r
///      |   ^   |
///      |   |   |
///      l-------r
///      |  in   |
///
struct ChordCell {
  CellId cell;
  int side;
};

struct Chord {
  std::vector<ChordCell> cells;
  bool closed = false;   ///< the last cell is followed by the first
  bool crosses = false;  ///< it passes through one of its cells twice

  [[nodiscard]] std::size_t rungs() const { return cells.size() + (closed ? 0 : 1); }
};

/// The whole chord that enters or leaves cell c through `side`, from a boundary side when it has ends.
/// `marks` is a workspace: one entry per cell, all zero before and after. Cost: its length.
void find_chord(const Mesh<2>& mesh, CellId c, int side, std::vector<std::uint8_t>& marks, Chord& chord);

/// Left and right vertex of the k-th rung.
inline std::array<VertexId, 2> rung(const Mesh<2>& mesh, const Chord& chord, std::size_t k) {
  if (k < chord.cells.size()) {
    const auto [c, side] = chord.cells[k];
    return {around(mesh, c, side), around(mesh, c, side + 1)};
  }
  const auto [c, side] = chord.cells.back();
  return {around(mesh, c, side + 3), around(mesh, c, side + 2)};
}

}  // namespace pillowmesh
