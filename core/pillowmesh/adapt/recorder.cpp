#include "pillowmesh/adapt/recorder.h"

#include <utility>

namespace pillowmesh {
namespace {

template <int Dim>
Corners<Dim> dead_cell() {
  Corners<Dim> dead;
  dead.fill(kNone);
  return dead;
}

}  // namespace

template <int Dim>
Event<Dim>& Recorder<Dim>::add(EventKind kind, const Mesh<Dim>& mesh, int iteration) {
  Event<Dim> event;
  event.kind = kind;
  event.iteration = iteration;
  event.delta.vertices_before = event.delta.vertices_after = mesh.vertex_count();
  event.delta.cells_before = event.delta.cells_after = mesh.cell_count();
  events_.push_back(std::move(event));
  return events_.back();
}

template <int Dim>
void Recorder<Dim>::tags(const Mesh<Dim>& mesh, const EdgeTags<Dim>& tags, int iteration, double longest_edge) {
  if (!on_) return;
  Event<Dim>& event = add(EventKind::tags, mesh, iteration);
  event.value = longest_edge;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int e = 0; e < Cell<Dim>::edges; ++e)
      if (tags.has(c, e) && represents_edge(mesh, {c, e}))
        event.edges.push_back({mesh.cells[c][Cell<Dim>::edge_from(e)], mesh.cells[c][Cell<Dim>::edge_to(e)]});
}

template <int Dim>
void Recorder<Dim>::layer(const Mesh<Dim>& mesh, const Layer& layer, Hull<Dim>& hull, int iteration) {
  if (!on_) return;
  Event<Dim>& event = add(EventKind::layer, mesh, iteration);
  for (const CellEdge& e : layer.edges)
    event.edges.push_back({mesh.cells[e.cell][Cell<Dim>::edge_from(e.edge)], mesh.cells[e.cell][Cell<Dim>::edge_to(e.edge)]});
  event.cells = layer.cells;
  find_hull<Dim>(mesh, layer.cells, {}, hull);
  for (const auto& facet : hull.facets) event.hull.push_back(facet.vertices);
  clear_hull<Dim>(layer.cells, hull);
}

template <int Dim>
void Recorder<Dim>::drop_last() {
  if (on_) events_.pop_back();
}

template <int Dim>
void Recorder<Dim>::buffer_layer(const Mesh<Dim>& mesh, const BufferLayer<Dim>& layer, int iteration) {
  if (!on_) return;
  const Index vertices_before = layer.first_vertex, cells_before = layer.first_cell;
  MeshDelta<Dim>& shrink = add(EventKind::shrink, mesh, iteration).delta;
  shrink.vertices_before = vertices_before;
  shrink.cells_before = shrink.cells_after = cells_before;
  for (std::size_t i = 0; i < layer.origins.size(); ++i) {
    const VertexId v = layer.first_vertex + static_cast<VertexId>(i);
    shrink.vertices.push_back(v);
    shrink.old_points.push_back(mesh.points[layer.origins[i]]);
    shrink.new_points.push_back(mesh.points[v]);
  }
  for (std::size_t i = 0; i < layer.moved.size(); ++i) {
    shrink.vertices.push_back(layer.moved[i]);
    shrink.old_points.push_back(layer.old_points[i]);
    shrink.new_points.push_back(mesh.points[layer.moved[i]]);
  }
  for (std::size_t i = 0; i < layer.changed.size(); ++i) {
    const CellId c = layer.changed[i];
    if (mesh.cells[c] == layer.old_corners[i]) continue;
    shrink.cells.push_back(c);
    shrink.old_corners.push_back(layer.old_corners[i]);
    shrink.new_corners.push_back(mesh.cells[c]);
  }
  Event<Dim>& connect = add(EventKind::connect, mesh, iteration);
  connect.delta.cells_before = cells_before;
  for (CellId k = layer.first_cell; k < mesh.cell_count(); ++k) {
    connect.cells.push_back(k);
    connect.delta.cells.push_back(k);
    connect.delta.old_corners.push_back(dead_cell<Dim>());
    connect.delta.new_corners.push_back(mesh.cells[k]);
  }
}

template <int Dim>
void Recorder<Dim>::iteration(const Mesh<Dim>& mesh, int iteration, double longest_edge) {
  if (on_) add(EventKind::iteration, mesh, iteration).value = longest_edge;
}

template <int Dim>
void Recorder<Dim>::before_relocation(const Mesh<Dim>& mesh) {
  if (on_) old_points_ = mesh.points;
}

template <int Dim>
void Recorder<Dim>::relocation(const Mesh<Dim>& mesh, int iteration, double energy) {
  if (!on_) return;
  Event<Dim>& event = add(EventKind::relocation, mesh, iteration);
  event.value = energy;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.points[v] == old_points_[v]) continue;
    event.delta.vertices.push_back(v);
    event.delta.old_points.push_back(old_points_[v]);
    event.delta.new_points.push_back(mesh.points[v]);
  }
}

template <int Dim>
void Recorder<Dim>::before_dice(const Mesh<Dim>& mesh) {
  if (on_) old_cells_ = mesh.cells;
  if (on_) old_points_ = mesh.points;
}

template <int Dim>
void Recorder<Dim>::dice(const Mesh<Dim>& mesh, int iteration) {
  if (!on_) return;
  Event<Dim>& event = add(EventKind::dice, mesh, iteration);
  event.delta.vertices_before = static_cast<Index>(old_points_.size());
  event.delta.cells_before = static_cast<Index>(old_cells_.size());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const Point<Dim>& old = v < event.delta.vertices_before ? old_points_[v] : mesh.points[v];
    if (v < event.delta.vertices_before && old == mesh.points[v]) continue;
    event.delta.vertices.push_back(v);
    event.delta.old_points.push_back(old);
    event.delta.new_points.push_back(mesh.points[v]);
  }
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    event.delta.cells.push_back(c);
    event.delta.old_corners.push_back(c < event.delta.cells_before ? old_cells_[c] : dead_cell<Dim>());
    event.delta.new_corners.push_back(mesh.cells[c]);
  }
}

template <int Dim>
void Recorder<Dim>::change([[maybe_unused]] Operator op, [[maybe_unused]] const Mesh<Dim>& mesh,
                           [[maybe_unused]] const Journal& journal, [[maybe_unused]] const Cavity& cavity,
                           [[maybe_unused]] int iteration) {
  if constexpr (Dim == 2) {
    if (!on_) return;
    static_assert(static_cast<int>(EventKind::partial_chord_split) - static_cast<int>(EventKind::rotate) == kOperators - 1);
    const auto kind = static_cast<EventKind>(static_cast<int>(EventKind::rotate) + static_cast<int>(op));
    Event<2>& event = add(kind, mesh, iteration);
    MeshDelta<2>& delta = event.delta;
    delta.vertices_before = journal.vertices_before();
    delta.cells_before = journal.cells_before();
    // A vertex that a vertex was opened into leaves from there; others appear where they are.
    const bool opened = op == Operator::open || op == Operator::boundary_open;
    Point<2> origin = mesh.points[cavity.around[0]];
    for (std::size_t i = 0; i < journal.vertices().size(); ++i)
      if (journal.vertices()[i] == cavity.around[0]) origin = journal.old_vertices()[i].point;
    const auto add_vertex = [&](VertexId v, const Point<2>& old_point) {
      delta.vertices.push_back(v);
      delta.old_points.push_back(old_point);
      delta.new_points.push_back(mesh.points[v]);
    };
    for (std::size_t i = 0; i < journal.vertices().size(); ++i) {
      const VertexId v = journal.vertices()[i];
      const auto& old = journal.old_vertices()[i];
      if (mesh.vertex_cell[v] == kNone) {
        // Its number may be taken later: going back must find it where it was.
        if (old.cell != kNone) add_vertex(v, old.point);
      } else if (old.cell == kNone)
        add_vertex(v, opened ? origin : mesh.points[v]);
      else if (old.point != mesh.points[v])
        add_vertex(v, old.point);
    }
    for (VertexId v = delta.vertices_before; v < mesh.vertex_count(); ++v)
      add_vertex(v, opened ? origin : mesh.points[v]);
    const auto add_cell = [&](CellId c, const Corners<2>& old_corners) {
      delta.cells.push_back(c);
      delta.old_corners.push_back(old_corners);
      delta.new_corners.push_back(mesh.cells[c]);
      if (old_corners[0] != kNone) event.cells.push_back(c);
    };
    for (std::size_t i = 0; i < journal.cells().size(); ++i)
      if (journal.old_cells()[i].corners != mesh.cells[journal.cells()[i]])
        add_cell(journal.cells()[i], journal.old_cells()[i].corners);
    for (CellId c = delta.cells_before; c < mesh.cell_count(); ++c) add_cell(c, dead_cell<2>());
  }
}

template <int Dim>
std::vector<Event<Dim>> Recorder<Dim>::take() {
  return std::exchange(events_, {});
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace pillowmesh
