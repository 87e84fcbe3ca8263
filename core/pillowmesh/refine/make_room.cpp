#include "pillowmesh/refine/make_room.h"

#include <algorithm>
#include <numeric>

#include "pillowmesh/refine/untangle.h"

namespace pillowmesh {
namespace {

constexpr int most_rings = 2;

/// The box [low, high] in the local coordinates of a cell, as the multilinear map places its corners.
template <int Dim>
CellShape<Dim> part_of(const CellShape<Dim>& shape, const std::array<double, Dim>& low,
                       const std::array<double, Dim>& high) {
  CellShape<Dim> part;
  for (int k = 0; k < Cell<Dim>::corners; ++k) {
    part[k] = Point<Dim>::Zero();
    for (int j = 0; j < Cell<Dim>::corners; ++j) {
      double weight = 1.0;
      for (int d = 0; d < Dim; ++d) {
        const double t = (k >> d) & 1 ? high[d] : low[d];
        weight *= (j >> d) & 1 ? t : 1.0 - t;
      }
      part[k] += weight * shape[j];
    }
  }
  return part;
}

/// The forms wanted: old cells as they were; a cell of the shrink set as its middle third (or the half away from the
/// hull); a new cell as the old inside cell: thicker than there is room for, so that it takes what it can get. (With the
/// slice that it takes the place of, layers come out thinner and more edges need refining again.)
template <int Dim>
class WantedShapes {
 public:
  WantedShapes(const Mesh<Dim>& mesh, const Hull<Dim>& hull, const BufferLayer<Dim>& layer)
      : mesh_(mesh), hull_(hull), layer_(layer) {}

  void set(TangledPatch<Dim>& patch, std::size_t i) const {
    const CellId c = patch.cells[i];
    if (c >= layer_.first_cell)
      patch.shapes[i] = old_shape(hull_.facets[c - layer_.first_cell].inside);
    else if (hull_.in_set[c])
      patch.shapes[i] = shrunk(c);
    else
      patch.shapes[i] = old_shape(c);
  }

 private:
  using C = Cell<Dim>;

  CellShape<Dim> old_shape(CellId c) const {
    const auto at = std::lower_bound(layer_.changed.begin(), layer_.changed.end(), c);
    const bool changed = at != layer_.changed.end() && *at == c;
    const auto& corners = changed ? layer_.old_corners[at - layer_.changed.begin()] : mesh_.cells[c];
    CellShape<Dim> shape;
    for (int k = 0; k < C::corners; ++k) {
      // Where it was, if it has been moved since.
      const auto moved = std::lower_bound(layer_.moved.begin(), layer_.moved.end(), corners[k]);
      const bool known = moved != layer_.moved.end() && *moved == corners[k];
      shape[k] = known ? layer_.old_points[moved - layer_.moved.begin()] : mesh_.points[corners[k]];
    }
    return shape;
  }

  /// Share of the cell that the layer at its facet f takes.
  double step(CellId c, int f) const {
    if (!hull_.is_hull(c, f)) return 0.0;
    return hull_.is_hull(c, C::opposite_facet(f)) ? 1.0 / 3.0 : 0.5;
  }

  CellShape<Dim> shrunk(CellId c) const {
    std::array<double, Dim> low, high;
    for (int d = 0; d < Dim; ++d) {
      low[d] = step(c, C::facet(d, 0));
      high[d] = 1.0 - step(c, C::facet(d, 1));
    }
    return part_of<Dim>(old_shape(c), low, high);
  }

  const Mesh<Dim>& mesh_;
  const Hull<Dim>& hull_;
  const BufferLayer<Dim>& layer_;
};

template <int Dim>
void free_vertices(const Mesh<Dim>& mesh, const Hull<Dim>& hull, const std::vector<VertexId>& vertices,
                   BufferLayer<Dim>& layer, TangledPatch<Dim>& patch) {
  const std::size_t first = patch.cells.size();
  extend<Dim>(patch, mesh, vertices);
  const WantedShapes<Dim> wanted(mesh, hull, layer);
  for (std::size_t i = first; i < patch.cells.size(); ++i) wanted.set(patch, i);
  // All that are free and old have been where they are until now.
  std::vector<VertexId> moved;
  std::vector<Point<Dim>> points;
  std::vector<Index> anchors;
  std::size_t known = 0;
  for (const VertexId v : patch.free) {
    if (v >= layer.first_vertex) break;
    const bool already = known < layer.moved.size() && layer.moved[known] == v;
    moved.push_back(v);
    points.push_back(already ? layer.old_points[known] : mesh.points[v]);
    anchors.push_back(already ? layer.old_anchors[known] : mesh.anchor[v]);
    known += already;
  }
  layer.moved = std::move(moved);
  layer.old_points = std::move(points);
  layer.old_anchors = std::move(anchors);
}

}  // namespace

template <int Dim>
bool make_room(Mesh<Dim>& mesh, const Hull<Dim>& hull, double floor, std::int64_t most_work, BufferLayer<Dim>& layer) {
  TangledPatch<Dim> patch;
  std::vector<VertexId> vertices(layer.origins.size());
  std::iota(vertices.begin(), vertices.end(), layer.first_vertex);
  free_vertices(mesh, hull, vertices, layer, patch);
  if (untangle(mesh, patch, floor, most_work)) return true;
  const auto corners_of = [&](CellId c) { vertices.insert(vertices.end(), mesh.cells[c].begin(), mesh.cells[c].end()); };
  vertices.clear();
  for (const CellId c : layer.changed) corners_of(c);
  for (CellId c = layer.first_cell; c < mesh.cell_count(); ++c) corners_of(c);
  for (int ring = 0; ring <= most_rings && most_work > 0; ++ring) {
    const std::size_t before = patch.free.size();
    free_vertices(mesh, hull, vertices, layer, patch);
    if (patch.free.size() == before) return false;
    if (untangle(mesh, patch, floor, most_work)) return true;
    vertices.clear();
    for (const CellId c : patch.cells) corners_of(c);
  }
  return false;
}

template bool make_room(Mesh<2>&, const Hull<2>&, double, std::int64_t, BufferLayer<2>&);
template bool make_room(Mesh<3>&, const Hull<3>&, double, std::int64_t, BufferLayer<3>&);

}  // namespace pillowmesh
