// Replacing some cells of a quad mesh by others with the same outline, and taking it back.
//
// This is the one place where the topology of an existing mesh is edited: an operator of coarsen/ or reconnect/ plans a
// cavity, and that is applied or not.
#pragma once

#include <vector>

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// A change of topology, planned but not done. Cells and vertices that disappear become dead; new ones take the numbers
/// of dead ones where there are any (`Journal`).
struct Cavity {
  struct NewVertex {
    Point<2> point;
    VertexSupport support;
    Index anchor;
  };
  /// A boundary side of the old cells, from a to b counterclockwise, that is divided at m.
  struct SplitSide {
    VertexId a, m, b;
  };

  std::vector<CellId> old_cells;
  /// In the new cells a vertex number <= kNew names a new vertex: new_vertex(0), new_vertex(1), ...
  std::vector<Corners<2>> new_cells;
  std::vector<NewVertex> new_vertices;
  std::vector<SplitSide> split_sides;
  /// Vertices that disappear, and the one that takes the place of each in the outline (kNone: it is inside).
  std::vector<VertexId> removed, merged_into;
  /// Vertices that move as part of the change, and where to.
  std::vector<VertexId> moved;
  std::vector<Point<2>> moved_to;
  /// Vertices, in a fixed order, whose surroundings change: they are to be relocated afterwards. After `apply` new
  /// vertices are among them by their numbers.
  std::vector<VertexId> around;

  static constexpr VertexId kNew = -2;
  static VertexId new_vertex(int i) { return kNew - i; }

  void clear();
};

/// What is needed to take a change back, and the numbers that are free.
class Journal {
 public:
  explicit Journal(Mesh<2>& mesh);

  /// From here on everything can be taken back.
  void begin();
  /// Does what is planned. \pre the new cells have the outline of the old ones. `new_ids` receives the numbers of the
  /// new cells, in the order of cavity.new_cells; new vertices in cavity are replaced by their numbers.
  /// \return false, with the mesh in an undefined state until undo(), when the outlines do not match or something frozen
  /// would change.
  bool apply(Cavity& cavity, std::vector<CellId>& new_ids);
  /// To be called before a vertex is moved.
  void touch(VertexId v);
  /// The mesh as it was at begin(), bit for bit.
  void undo();

  /// Cells and vertices that the change touched so far.
  [[nodiscard]] const std::vector<CellId>& cells() const { return touched_cells_; }
  [[nodiscard]] const std::vector<VertexId>& vertices() const { return touched_vertices_; }
  /// As they were at begin(): for the trace.
  struct OldCell {
    Corners<2> corners;
    std::array<HalfFacetId, 4> twins;
    Index region;
  };
  struct OldVertex {
    Point<2> point;
    CellId cell;
    VertexSupport support;
    Index anchor;
  };
  [[nodiscard]] const std::vector<OldCell>& old_cells() const { return old_cells_; }
  [[nodiscard]] const std::vector<OldVertex>& old_vertices() const { return old_vertices_; }
  [[nodiscard]] Index cells_before() const { return cells_before_; }
  [[nodiscard]] Index vertices_before() const { return vertices_before_; }

 private:
  struct Side {
    VertexId a, b;
    HalfFacetId outside;  ///< twin across it, < 0: boundary
    HalfFacetId inside;   ///< of a new cell
  };
  void touch_cell(CellId c);
  CellId take_cell();
  VertexId take_vertex();
  [[nodiscard]] bool keeps_frozen(const Cavity& cavity) const;
  bool link(const std::vector<CellId>& ids);

  Mesh<2>& mesh_;
  std::vector<CellId> free_cells_;
  std::vector<VertexId> free_vertices_;
  std::vector<CellId> taken_cells_;
  std::vector<VertexId> taken_vertices_, given_vertices_;
  std::vector<CellId> given_cells_;
  std::vector<Index> cell_stamp_, vertex_stamp_;
  Index stamp_ = 0;
  std::vector<CellId> touched_cells_;
  std::vector<VertexId> touched_vertices_;
  std::vector<OldCell> old_cells_;
  std::vector<OldVertex> old_vertices_;
  Index cells_before_ = 0, vertices_before_ = 0;
  std::vector<Side> outline_, sides_;
};

}  // namespace pillowmesh
