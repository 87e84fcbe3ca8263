// The mesh: structure of arrays, 32-bit ids, adjacency through half-facets.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pillowmesh/mesh/cell.h"
#include "pillowmesh/mesh/ids.h"

namespace pillowmesh {

/// Where a vertex lives: `dim` = Dim inside, 2 on a surface patch (3D), 1 on a curve, 0 pinned to a corner.
/// `entity` is the patch or curve number; kNone inside and at corners.
struct VertexSupport {
  std::int8_t dim = 0;
  Index entity = kNone;
  /// The `entity` of vertices that nothing may move or remove, wherever they are: dim is 0 then.
  static constexpr Index kFrozen = -2;
  [[nodiscard]] bool frozen() const { return dim == 0 && entity == kFrozen; }
  friend bool operator==(const VertexSupport&, const VertexSupport&) = default;
};

/// A physical group or reference of the input: `tag` is its number there, `name` may be empty.
struct Group {
  Index tag = 0;
  std::string name;
};

/// Values of the points or the cells of a mesh, all components of one after the other's.
struct FieldArray {
  std::string name;
  bool of_cells = false;
  bool whole = false;  ///< whole numbers, such as materials: never interpolated
  int components = 1;
  std::vector<double> values;
};

template <int Dim>
struct Geometry;  // mesh/boundary.h

/// What must stay as it is besides frozen vertices (mesh/frozen.h): vertices of each in ascending order, the lists too.
/// Vertices keep their numbers, so that no operator has to maintain this.
template <int Dim>
struct Frozen {
  std::vector<std::array<VertexId, 2>> edges;
  std::vector<FacetCorners<Dim>> facets;  ///< 3D only: in 2D they are edges
  std::vector<Corners<Dim>> cells;
  /// Facets inside the domain, in the input's order of vertices, and their groups: for writers.
  struct InnerFacet {
    FacetCorners<Dim> vertices;
    Group group;
  };
  std::vector<InnerFacet> inner_facets;
};

/// A conforming all-quadrilateral or all-hexahedral mesh.
///
/// `twins[c][f]` >= 0 is the half-facet on the other side of facet f of cell c; < 0 means boundary, on the patch
/// ~twins[c][f]. A cell with corners[0] == kNone is dead: it keeps its number until `compact`.
template <int Dim>
struct Mesh {
  std::vector<Point<Dim>> points;
  std::vector<Corners<Dim>> cells;
  std::vector<std::array<HalfFacetId, Cell<Dim>::facets>> twins;
  /// One live cell at each vertex, kNone for a vertex that no cell uses. On the boundary any incident cell.
  std::vector<CellId> vertex_cell;
  std::vector<VertexSupport> support;
  /// The boundary facet (2D: segment) of `geometry` that a boundary vertex lies on; kNone inside. A hint that is kept
  /// near the truth, so that projection starts there.
  std::vector<Index> anchor;
  /// Region number of each cell: an index into `region_groups`.
  std::vector<Index> region;

  /// Group of each patch: `patch_groups[~twins[c][f]]`. Several patches may carry the same group.
  std::vector<Group> patch_groups;
  std::vector<Group> region_groups;
  /// The domain's boundary as it was given; shared by all meshes adapted from one input, never changed.
  std::shared_ptr<const Geometry<Dim>> geometry;
  /// Null when nothing is frozen.
  std::shared_ptr<const Frozen<Dim>> frozen;

  [[nodiscard]] Index vertex_count() const { return static_cast<Index>(points.size()); }
  [[nodiscard]] Index cell_count() const { return static_cast<Index>(cells.size()); }
  [[nodiscard]] bool alive(CellId c) const { return cells[c][0] != kNone; }

  [[nodiscard]] static HalfFacetId half_facet(CellId c, int f) { return c * Cell<Dim>::facets + f; }
  [[nodiscard]] static CellId cell_of(HalfFacetId h) { return h / Cell<Dim>::facets; }
  [[nodiscard]] static int facet_of(HalfFacetId h) { return h % Cell<Dim>::facets; }
  [[nodiscard]] bool on_boundary(CellId c, int f) const { return twins[c][f] < 0; }
  /// \pre on_boundary(c, f)
  [[nodiscard]] PatchId patch_of(CellId c, int f) const { return ~twins[c][f]; }
  /// The neighbour across facet f, or kNone.
  [[nodiscard]] CellId neighbour(CellId c, int f) const { return twins[c][f] < 0 ? kNone : cell_of(twins[c][f]); }
  [[nodiscard]] FacetCorners<Dim> facet_vertices(CellId c, int f) const {
    FacetCorners<Dim> v;
    for (int k = 0; k < Cell<Dim>::facet_corners; ++k) v[k] = cells[c][Cell<Dim>::facet_corner(f, k)];
    return v;
  }
};

/// What a reader hands over and a writer receives: cells in corner-bit order and what the file said of the boundary.
/// Everything but `points` and `cells` may be empty.
template <int Dim>
struct MeshInput {
  std::vector<Point<Dim>> points;
  std::vector<Corners<Dim>> cells;
  /// Index into `region_groups` per cell.
  std::vector<Index> cell_region;
  std::vector<Group> region_groups;

  /// Boundary facets that carry a reference; `group` indexes `facet_groups`. Facets that the file does not list are
  /// grouped by angle alone. Facets that lie inside the domain are ignored.
  struct Facet {
    FacetCorners<Dim> vertices;
    Index group;
  };
  std::vector<Facet> facets;
  std::vector<Group> facet_groups;
  /// Vertices that the file pins (Medit Corners; Gmsh physical points).
  std::vector<VertexId> corners;
  /// Feature edges that the file names (Medit Ridges); used in 3D only.
  std::vector<std::array<VertexId, 2>> ridges;

  /// What has to stay as it is (Medit Required*). Edges in 3D only: in 2D they are facets.
  std::vector<VertexId> required_vertices;
  std::vector<std::array<VertexId, 2>> required_edges;
  std::vector<FacetCorners<Dim>> required_facets;
  std::vector<Index> required_cells;
  /// Points (both ends the same) and, in 3D, edges that carry a group, for BoundaryOptions::freeze; `group` indexes
  /// `mark_groups`.
  struct Mark {
    std::array<VertexId, 2> ends;
    Index group;
  };
  std::vector<Mark> marks;
  std::vector<Group> mark_groups;

  /// Written to VTK files, where facets have the values of their cells.
  std::vector<FieldArray> fields;

  /// How to name cell c in a message, e.g. "quad 17 (line 240)"; empty: "cell c" counted from 0.
  std::vector<Index> cell_lines;
};

}  // namespace pillowmesh
