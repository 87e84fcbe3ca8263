// Replayable events: everything a viewer needs to play a run forwards and backwards.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

enum class EventKind : std::uint8_t {
  tags,        ///< the edges longer than the threshold, after balancing
  layer,       ///< a layer was found: its shrink set, the tagged edges it uses, its hull
  shrink,      ///< hull vertices duplicated, the shrink set contracted: a void opens
  connect,     ///< the buffer layer fills the void
  dice,        ///< every cell split in n^Dim
  relocation,  ///< one sweep of the smoother
  iteration,   ///< end of an iteration of the paper's loop
  rotate,      ///< an edge turned, and its surroundings relocated
  collapse,    ///< a quad removed by merging two opposite vertices
  open,        ///< a vertex split along two edges
  chord_collapse,  ///< a whole row of quads removed
  chord_split,     ///< a whole row of quads doubled
  boundary_collapse,  ///< two boundary edges laid on each other, the rows that ended there joined
  boundary_open,      ///< the reverse: a boundary vertex split in three
  partial_chord_collapse,  ///< part of a row of quads removed, inside the mesh
  partial_chord_split,     ///< a path of edges opened into a row of quads
};

/// "tags", "layer", ...
std::string_view to_string(EventKind kind);

/// What changed between two meshes. The arrays only ever grow; a removed cell becomes dead (all corners kNone), and a new
/// one may take its number. Old values make the change undoable.
template <int Dim>
struct MeshDelta {
  Index vertices_before = 0, vertices_after = 0;
  Index cells_before = 0, cells_after = 0;
  /// Vertices that moved or are new; `old_points` holds a new vertex's origin (the vertex it is a copy of), so that
  /// drawing old -> new shows it leave its origin.
  std::vector<VertexId> vertices;
  std::vector<Point<Dim>> old_points, new_points;
  /// Cells whose corners changed or that are new; for a new cell `old_corners` is all kNone.
  std::vector<CellId> cells;
  std::vector<Corners<Dim>> old_corners, new_corners;
};

template <int Dim>
struct Event {
  EventKind kind = EventKind::iteration;
  int iteration = 0;
  /// tags: all tagged edges; layer: the ones it was formed from. Pairs of vertices as the mesh is before the event.
  std::vector<std::array<VertexId, 2>> edges;
  /// layer: its shrink set; connect: the cells of the buffer layer; rotate and what follows it: the cells whose corners
  /// change, as they are before.
  std::vector<CellId> cells;
  /// layer: the hull of the shrink set.
  std::vector<FacetCorners<Dim>> hull;
  MeshDelta<Dim> delta;
  /// tags, iteration: the longest edge (metric length); relocation: energy after the sweep. 0 where unused.
  double value = 0.0;
};

/// Applies a delta to points and cells alone (a viewer's copy of the mesh, without adjacency).
template <int Dim>
void apply(const MeshDelta<Dim>& delta, std::vector<Point<Dim>>& points, std::vector<Corners<Dim>>& cells);
template <int Dim>
void revert(const MeshDelta<Dim>& delta, std::vector<Point<Dim>>& points, std::vector<Corners<Dim>>& cells);

}  // namespace pillowmesh
