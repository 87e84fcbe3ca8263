#include "pillowmesh/refine/layer.h"

namespace pillowmesh {
namespace {

template <int Dim>
class Grower {
 public:
  Grower(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, LayerMarks& marks, Layer& layer)
      : mesh_(mesh), tags_(tags), marks_(marks), layer_(layer) {
    if (marks_.visited.size() < mesh.cells.size()) marks_.visited.resize(mesh.cells.size(), 0);
  }

  /// All cells at an edge become part of the layer; `top` is the edge's upper vertex.
  void add_cells_at(CellEdge edge, VertexId top) {
    for_each_cell_at_edge(mesh_, edge, [&](CellId c, int e) {
      const int axis = C::edge_axis(e);
      add(c, axis, mesh_.cells[c][C::edge_to(e)] == top ? 1 : 0);
    });
  }

  void add(CellId c, int axis, int up) {
    if ((marks_.visited[c] >> axis) & 1) return;
    if (marks_.visited[c] == 0) layer_.cells.push_back(c);
    marks_.visited[c] |= static_cast<std::uint8_t>(1 << axis);
    layer_.visits.push_back({c, static_cast<std::int8_t>(axis), static_cast<std::int8_t>(up)});
  }

  /// Uses a tagged edge: its cells join, its tag goes.
  void use(CellEdge edge, VertexId top) {
    layer_.edges.push_back(edge);
    clear_tag(mesh_, tags_, edge);
    add_cells_at(edge, top);
  }

  VertexId top_of(const LayerCell& v, int e) const {
    return mesh_.cells[v.cell][v.up ? C::edge_to(e) : C::edge_from(e)];
  }

  /// Follows parallel tagged edges from visit `next` on, until none is left.
  void follow_tags(std::size_t next) {
    for (; next < layer_.visits.size(); ++next) {
      const LayerCell v = layer_.visits[next];
      for (int k = 0; k < C::edges_per_axis; ++k) {
        const int e = C::edge(v.axis, k);
        if (tags_.has(v.cell, e)) use({v.cell, e}, top_of(v, e));
      }
    }
  }

  /// One ring: through all parallel edges, tagged or not, of the cells that are there.
  void augment(CellId first_new) {
    const std::size_t before = layer_.visits.size();
    for (std::size_t i = 0; i < before; ++i) {
      const LayerCell v = layer_.visits[i];
      if (v.cell >= first_new) continue;
      for (int k = 0; k < C::edges_per_axis; ++k) {
        const int e = C::edge(v.axis, k);
        add_cells_at({v.cell, e}, top_of(v, e));
      }
    }
  }

  /// One more row of cells, on the side where more edges are tagged.
  void thicken(std::size_t& bottom_first, std::size_t& bottom_last, std::size_t& top_first, std::size_t& top_last) {
    const auto tagged_beyond = [&](std::size_t first, std::size_t last, bool above) {
      std::size_t count = 0;
      for (std::size_t i = first; i < last; ++i) {
        const LayerCell n = beyond(layer_.visits[i], above);
        if (n.cell == kNone || (marks_.visited[n.cell] >> n.axis) & 1) continue;
        for (int k = 0; k < C::edges_per_axis; ++k) count += tags_.has(n.cell, C::edge(n.axis, k));
      }
      return count;
    };
    const bool above =
        tagged_beyond(top_first, top_last, true) >= tagged_beyond(bottom_first, bottom_last, false);
    const std::size_t first = above ? top_first : bottom_first, last = above ? top_last : bottom_last;
    const std::size_t begin = layer_.visits.size();
    for (std::size_t i = first; i < last; ++i) {
      const LayerCell n = beyond(layer_.visits[i], above);
      if (n.cell != kNone) add(n.cell, n.axis, n.up);
    }
    const std::size_t end = layer_.visits.size();
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < C::edges_per_axis; ++k) {
        const LayerCell v = layer_.visits[i];
        const CellEdge edge{v.cell, C::edge(v.axis, k)};
        if (!tags_.has(edge) || !surrounded(edge)) continue;
        layer_.edges.push_back(edge);
        clear_tag(mesh_, tags_, edge);
      }
    (above ? top_first : bottom_first) = begin;
    (above ? top_last : bottom_last) = end;
  }

  void clear_marks() {
    for (const CellId c : layer_.cells) marks_.visited[c] = 0;
  }

 private:
  using C = Cell<Dim>;

  /// The cell above or below a visit, in the visit's terms.
  LayerCell beyond(const LayerCell& v, bool above) const {
    const int side = above ? v.up : 1 - v.up;
    const HalfFacetId twin = mesh_.twins[v.cell][C::facet(v.axis, side)];
    if (twin < 0) return {kNone, 0, 0};
    const int f = mesh_.facet_of(twin);
    const int entered = C::facet_side(f);  // this side of it looks back at us
    return {mesh_.cell_of(twin), static_cast<std::int8_t>(C::facet_axis(f)),
            static_cast<std::int8_t>(above ? 1 - entered : entered)};
  }

  bool surrounded(CellEdge edge) const {
    bool all = true;
    for_each_cell_at_edge(mesh_, edge,
                          [&](CellId c, int e) { all = all && ((marks_.visited[c] >> C::edge_axis(e)) & 1); });
    return all;
  }

  const Mesh<Dim>& mesh_;
  EdgeTags<Dim>& tags_;
  LayerMarks& marks_;
  Layer& layer_;
};

}  // namespace

template <int Dim>
void find_layer(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, CellEdge seed, const LayerOptions& options,
                LayerMarks& marks, Layer& layer) {
  layer.visits.clear();
  layer.cells.clear();
  layer.edges.clear();
  Grower<Dim> grower(mesh, tags, marks, layer);
  grower.use(seed, mesh.cells[seed.cell][Cell<Dim>::edge_to(seed.edge)]);
  grower.follow_tags(0);
  for (int i = 0; i < options.augment; ++i) grower.augment(options.first_new);
  std::size_t bottom_first = 0, bottom_last = layer.visits.size(), top_first = 0, top_last = bottom_last;
  for (int i = 1; i < options.thickness; ++i) grower.thicken(bottom_first, bottom_last, top_first, top_last);
  grower.clear_marks();
}

template void find_layer(const Mesh<2>&, EdgeTags<2>&, CellEdge, const LayerOptions&, LayerMarks&, Layer&);
template void find_layer(const Mesh<3>&, EdgeTags<3>&, CellEdge, const LayerOptions&, LayerMarks&, Layer&);

}  // namespace pillowmesh
