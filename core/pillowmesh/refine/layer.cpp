#include "pillowmesh/refine/layer.h"

#include "pillowmesh/mesh/frozen.h"

namespace pillowmesh {
namespace {

template <int Dim>
class Grower {
 public:
  Grower(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, LayerMarks& marks, Layer& layer)
      : mesh_(mesh), tags_(tags), marks_(marks), layer_(layer) {
    if (marks_.visited.size() < mesh.cells.size()) marks_.visited.resize(mesh.cells.size(), 0);
    if (marks_.refined.size() < mesh.cells.size()) marks_.refined.resize(mesh.cells.size(), 0);
  }

  /// All cells at an edge become part of the layer; `top` is the edge's upper vertex.
  void add_cells_at(CellEdge edge, VertexId top) {
    for_each_cell_at_edge(mesh_, edge, [&](CellId c, int e) {
      const int axis = C::edge_axis(e);
      add(c, axis, mesh_.cells[c][C::edge_to(e)] == top ? 1 : 0);
    });
  }

  void add(CellId c, int axis, int up) {
    if ((marks_.visited[c] >> axis) & 1 || is_frozen_cell(mesh_, mesh_.cells[c])) return;
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
        if (!is_frozen_edge(mesh_, {v.cell, e})) add_cells_at({v.cell, e}, top_of(v, e));
      }
    }
  }

  /// More rows of cells, all on one side, so that hull remains on the other side of the edges that formed the layer.
  void thicken(int thickness) {
    const std::size_t seed_row = layer_.visits.size();
    std::array<std::vector<LayerCell>, 2> rows;
    const std::array<std::size_t, 2> tagged{next_row(0, seed_row, false, rows[0]), next_row(0, seed_row, true, rows[1])};
    const bool above = tagged[1] >= tagged[0];
    std::vector<LayerCell>& row = rows[above];
    for (int k = 1; k < thickness && !row.empty(); ++k) {
      const std::size_t begin = layer_.visits.size();
      for (const LayerCell& n : row) add(n.cell, n.axis, n.up);
      next_row(begin, layer_.visits.size(), above, row);
    }
    for (std::size_t i = seed_row; i < layer_.visits.size(); ++i)
      for (int k = 0; k < C::edges_per_axis; ++k) {
        const LayerCell v = layer_.visits[i];
        const CellEdge edge{v.cell, C::edge(v.axis, k)};
        if (!tags_.has(edge) || !surrounded(edge)) continue;
        layer_.edges.push_back(edge);
        clear_tag(mesh_, tags_, edge);
      }
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

  /// Fills `row` with the cells beside the visits from `first` to `last`: all of them or, if one is refined already, lies
  /// at the boundary or touches the layer, or if few carry tags, none. A gap would cost two more ends.
  /// \return the number of their tags.
  std::size_t next_row(std::size_t first, std::size_t last, bool above, std::vector<LayerCell>& row) const {
    row.clear();
    std::size_t tagged = 0;
    for (std::size_t i = first; i < last; ++i) {
      const LayerCell v = layer_.visits[i], n = beyond(v, above);
      const bool seed_has_hull = first > 0 || is_outside(beyond(v, !above));
      if (!seed_has_hull || !is_outside(n) || !is_outside(beyond(n, above)) || marks_.refined[n.cell] >> n.axis & 1) {
        row.clear();
        return 0;
      }
      row.push_back(n);
      for (int k = 0; k < C::edges_per_axis; ++k) tagged += tags_.has(n.cell, C::edge(n.axis, k));
    }
    if (tagged < layer_.edges.size()) row.clear();  // inner edges are seen from two cells (four in 3D): half of them
    return row.empty() ? 0 : tagged;
  }

  /// True if hull would be between the layer and this cell.
  bool is_outside(const LayerCell& n) const { return n.cell != kNone && marks_.visited[n.cell] == 0; }

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
  if (options.thickness > 1) grower.thicken(options.thickness);
  grower.clear_marks();
}

template <int Dim>
void mark_refined(const Mesh<Dim>& mesh, const Layer& layer, const BufferLayer<Dim>& insertion,
                  std::span<const HullFacet<Dim>> facets, LayerMarks& marks) {
  marks.refined.resize(mesh.cells.size(), 0);
  for (const LayerCell& v : layer.visits) marks.refined[v.cell] |= static_cast<std::uint8_t>(1 << v.axis);
  for (Index i = 0; i < insertion.cell_count; ++i)  // a new cell has the axes of the cell inside
    marks.refined[insertion.first_cell + i] =
        marks.refined[facets[i].inside] | static_cast<std::uint8_t>(1 << Cell<Dim>::facet_axis(facets[i].facet));
}

template void find_layer(const Mesh<2>&, EdgeTags<2>&, CellEdge, const LayerOptions&, LayerMarks&, Layer&);
template void find_layer(const Mesh<3>&, EdgeTags<3>&, CellEdge, const LayerOptions&, LayerMarks&, Layer&);
template void mark_refined(const Mesh<2>&, const Layer&, const BufferLayer<2>&, std::span<const HullFacet<2>>,
                           LayerMarks&);
template void mark_refined(const Mesh<3>&, const Layer&, const BufferLayer<3>&, std::span<const HullFacet<3>>,
                           LayerMarks&);

}  // namespace pillowmesh
