// Which copies of a hull vertex a buffer layer needs, and where they go. ../method: "copy per component".
#pragma once

#include <vector>

#include "pillowmesh/mesh/status.h"
#include "pillowmesh/refine/hull.h"

namespace pillowmesh {

/// "Corner `corner` of cell `cell` becomes vertex `vertex`."
struct CornerChange {
  CellId cell;
  std::int8_t corner;
  VertexId vertex;
};

/// A vertex that a buffer layer adds.
template <int Dim>
struct VertexCopy {
  VertexId origin;
  bool from_inside;  ///< the origin is not on the boundary
  Point<Dim> position;
  VertexSupport support;
  Index anchor;
  CellId cell;  ///< one cell that will use it
};

template <int Dim>
struct CopyPlan {
  std::vector<CornerChange> changes;
  std::vector<VertexCopy<Dim>> copies;  ///< numbered from mesh.vertex_count() on
  /// 3D, ascending: edges of the hull that the shrink set keeps, joined across them where they are pinched. The outside
  /// keeps all others.
  std::vector<std::array<VertexId, 2>> kept_inside;
  /// 3D, after a refusal for that reason: the cells outside that part the set from itself at an edge where neither side
  /// can be joined. With them in the set it no longer touches itself there. Else empty.
  std::vector<CellId> parting;
  // Buffers of one vertex at a time.
  std::vector<CellCorner> star;
  std::vector<int> component;
  std::vector<VertexId> on_hull;
  std::vector<Point<Dim>> normals;
  std::vector<int> runs;
  bool pinched_here = false;
};

/// Decides the copies of every hull vertex v. Around v the shrink set S and the outside O fall into components, the fans
/// of cells that are connected through facets at v; each component needs a vertex of its own, and the first O component
/// keeps v:
///
///      O | S            two fans of S at one vertex (touching or self-intersecting layers):
///     ---v---           O is joined across v and keeps it, each S fan gets a copy.
///      S | O
///
/// In 3D this is decided per edge (pinched: four or more hull facets): O is joined across it or, where the S runs are one
/// component at both its ends, S is. The runs of the other side then need different copies at both ends: were they one
/// component at v, two facets between new cells would share the edge vw and the edge from v to its copy, and the cells
/// between them would have no angle left. `shrink` scales how far the copies move: 1 = a third of the way across.
/// \return illegal when that cannot be had, or a copy would have to leave the boundary. Changes nothing but `plan`.
template <int Dim>
Status plan_copies(const Mesh<Dim>& mesh, const Hull<Dim>& hull, double shrink, CopyPlan<Dim>& plan);

}  // namespace pillowmesh
