#include "pillowmesh/adapt/trace.h"

namespace pillowmesh {

std::string_view to_string(EventKind kind) {
  switch (kind) {
    case EventKind::tags: return "tags";
    case EventKind::layer: return "layer";
    case EventKind::shrink: return "shrink";
    case EventKind::connect: return "connect";
    case EventKind::dice: return "dice";
    case EventKind::relocation: return "relocation";
    case EventKind::iteration: return "iteration";
    case EventKind::rotate: return "rotate";
    case EventKind::collapse: return "collapse";
    case EventKind::open: return "open";
    case EventKind::chord_collapse: return "chord_collapse";
    case EventKind::chord_split: return "chord_split";
    case EventKind::boundary_collapse: return "boundary_collapse";
    case EventKind::boundary_open: return "boundary_open";
    case EventKind::partial_chord_collapse: return "partial_chord_collapse";
    case EventKind::partial_chord_split: return "partial_chord_split";
  }
  return "";
}

template <int Dim>
void apply(const MeshDelta<Dim>& delta, std::vector<Point<Dim>>& points, std::vector<Corners<Dim>>& cells) {
  points.resize(delta.vertices_after, Point<Dim>::Zero());
  Corners<Dim> dead;
  dead.fill(kNone);
  cells.resize(delta.cells_after, dead);
  for (std::size_t i = 0; i < delta.vertices.size(); ++i) points[delta.vertices[i]] = delta.new_points[i];
  for (std::size_t i = 0; i < delta.cells.size(); ++i) cells[delta.cells[i]] = delta.new_corners[i];
}

template <int Dim>
void revert(const MeshDelta<Dim>& delta, std::vector<Point<Dim>>& points, std::vector<Corners<Dim>>& cells) {
  for (std::size_t i = 0; i < delta.vertices.size(); ++i) points[delta.vertices[i]] = delta.old_points[i];
  for (std::size_t i = 0; i < delta.cells.size(); ++i) cells[delta.cells[i]] = delta.old_corners[i];
  points.resize(delta.vertices_before);
  cells.resize(delta.cells_before);
}

template void apply(const MeshDelta<2>&, std::vector<Point<2>>&, std::vector<Corners<2>>&);
template void apply(const MeshDelta<3>&, std::vector<Point<3>>&, std::vector<Corners<3>>&);
template void revert(const MeshDelta<2>&, std::vector<Point<2>>&, std::vector<Corners<2>>&);
template void revert(const MeshDelta<3>&, std::vector<Point<3>>&, std::vector<Corners<3>>&);

}  // namespace pillowmesh
