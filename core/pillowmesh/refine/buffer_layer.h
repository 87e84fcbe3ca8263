// The refinement primitive: shrink a set of cells and fill the void with a buffer layer. [Paper] section 2, Figure 1.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "pillowmesh/refine/side_partners.h"

namespace pillowmesh {

/// What an insertion did: enough to inherit tags, to show it, and to undo it.
template <int Dim>
struct BufferLayer {
  VertexId first_vertex = 0;
  std::vector<VertexId> origins;  ///< per new vertex: the hull vertex that it is a copy of
  /// Cells that were added to the shrink set, where it touched itself in a way that no layer can be wrapped around.
  std::vector<CellId> added;
  CellId first_cell = 0;          ///< cell first_cell + i was extruded from hull facet i
  Index cell_count = 0;
  /// Cells whose corners were renamed, and what they were.
  std::vector<CellId> changed;
  std::vector<Corners<Dim>> old_corners;
  std::vector<std::array<HalfFacetId, Cell<Dim>::facets>> old_twins;  ///< of `changed`
  /// Vertices that had to make room, and where they were. Empty for most layers.
  std::vector<VertexId> moved;
  std::vector<Point<Dim>> old_points;
  std::vector<Index> old_anchors;
  /// Vertices that a copy has taken the place of on a curve or patch, and how they were classified.
  std::vector<VertexId> released;
  std::vector<VertexSupport> old_supports;
  std::vector<Index> released_anchors;
};

/// Buffers of the operator, reused from call to call.
template <int Dim>
struct PillowWorkspace {
  /// A layer is refused if it would leave a cell whose smallest scaled Jacobian is not above this. 0: only valid.
  double quality_floor = 0.0;
  /// How often the energy of a cell may be evaluated while vertices are moved to make room. Where there is any, a few
  /// hundred times for each cell of the layer mostly suffice.
  std::int64_t most_untangling = std::numeric_limits<std::int64_t>::max();
  Hull<Dim> hull;
  CopyPlan<Dim> plan;
  std::vector<CellId> touched;
  std::vector<std::uint8_t> marks;  ///< per cell, and more; all 0 between calls
  std::vector<CellId> set;
  std::vector<NewCellSide> sides;
  std::vector<CellId> old_vertex_cell;
};

/// Inserts a buffer layer around `shrink_set` (live cells, each once). The new layer has thickness from the start.
///
///      +-----+-----+          +-----+-----+        the row is shrunk to its middle third,
///      |     |     |          |\____|____/|        its hull is duplicated,
///      |  S  |  S  |    ->    | | S | S | |        each hull facet is extruded to one cell
///      |     |     |          |/----|----\|
///      +-----+-----+          +-----+-----+
///
/// Where the shrink set meets the domain's boundary the boundary is not hull, unless named in `boundary_hull`. In 3D the
/// layer may go around more than asked for: see BufferLayer::added.
/// \return illegal, with the mesh bit-for-bit unchanged, when there is no hull, a copy would leave the boundary, or no
/// position keeps all corner Jacobians positive (above work.quality_floor). Cost: linear in the shrink set (no global work).
/// Source: [Paper] section 2; Mitchell and Tautges, "Pillowing doublets" (1995); Schneiders (1996).
template <int Dim>
Status insert_buffer_layer(Mesh<Dim>& mesh, std::span<const CellId> shrink_set,
                           std::span<const HalfFacetId> boundary_hull, PillowWorkspace<Dim>& work,
                           BufferLayer<Dim>& layer);

}  // namespace pillowmesh
