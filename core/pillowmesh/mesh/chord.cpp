#include "pillowmesh/mesh/chord.h"

namespace pillowmesh {

void find_chord(const Mesh<2>& mesh, CellId c, int side, std::vector<std::uint8_t>& marks, Chord& chord) {
  chord.cells.clear();
  chord.closed = chord.crosses = false;
  // Back to the beginning, or once around.
  CellId at = c;
  int in = side & 3;
  while (true) {
    const HalfFacetId twin = twin_of_side(mesh, at, in);
    if (twin < 0) break;
    at = mesh.cell_of(twin);
    in = (kFacetSide[mesh.facet_of(twin)] + 2) & 3;
    if (at == c && in == (side & 3)) {
      chord.closed = true;
      break;
    }
  }
  const CellId first = at;
  const int entered = in;
  while (true) {
    chord.cells.push_back({at, in});
    if (marks[at]++ != 0) chord.crosses = true;
    const HalfFacetId twin = twin_of_side(mesh, at, in + 2);
    if (twin < 0) break;
    at = mesh.cell_of(twin);
    in = kFacetSide[mesh.facet_of(twin)];
    if (at == first && in == entered) break;
  }
  for (const ChordCell& cell : chord.cells) marks[cell.cell] = 0;
}

}  // namespace pillowmesh
