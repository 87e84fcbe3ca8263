#include "pillowmesh/mesh/slide.h"

#include "pillowmesh/mesh/foot.h"

namespace pillowmesh {
namespace {

/// Walks from piece to piece while the foot gets nearer. `foot_on(i)` and `next(i, axis, end)` describe the pieces.
template <int Dim, class FootOn, class Next>
Point<Dim> walk(Index& at, int axes, FootOn&& foot_on, Next&& next) {
  Foot<Dim> best = foot_on(at);
  for (bool moved = true; moved;) {
    moved = false;
    for (int axis = 0; axis < axes && !moved; ++axis) {
      if (best.cut[axis] == kNone) continue;
      const Index n = next(at, axis, best.cut[axis]);
      if (n == kNone) continue;
      const Foot<Dim> foot = foot_on(n);
      if (foot.distance2 < best.distance2) {
        best = foot;
        at = n;
        moved = true;
      }
    }
  }
  return best.point;
}

}  // namespace

template <int Dim>
Point<Dim> slide(const Geometry<Dim>& geometry, VertexSupport support, Index& anchor, const Point<Dim>& target) {
  if (support.dim == Dim) return target;
  if (support.dim == Dim - 1)
    return walk<Dim>(
        anchor, Dim - 1, [&](Index i) { return foot_on_facet(geometry, i, target); },
        [&](Index i, int axis, int end) {
          return geometry.neighbours[i][Dim == 2 ? end : Cell<2>::facet(axis, end)];
        });
  return walk<Dim>(
      anchor, 1,
      [&](Index i) { return foot_on_segment(geometry, i, target); },
      [&](Index i, int, int end) { return geometry.segment_neighbours[i][end]; });
}

template <int Dim>
Index anchor_on(const Mesh<Dim>& mesh, VertexSupport support, VertexId from, const Point<Dim>& near) {
  if (support.dim == Dim || support.dim == 0) return kNone;
  if (mesh.support[from] == support) return mesh.anchor[from];
  // `from` is a corner or on a curve of the entity: look among all its pieces. Layers end at corners rarely.
  const Geometry<Dim>& g = *mesh.geometry;
  Index best = kNone;
  double best_distance = 0.0;
  const auto consider = [&](Index i, double distance2) {
    if (best != kNone && !(distance2 < best_distance)) return;
    best = i;
    best_distance = distance2;
  };
  if (support.dim == Dim - 1) {
    for (Index i = 0; i < static_cast<Index>(g.facets.size()); ++i)
      if (g.patch[i] == support.entity) consider(i, foot_on_facet(g, i, near).distance2);
  } else {
    for (Index i = 0; i < static_cast<Index>(g.segments.size()); ++i)
      if (g.curve[i] == support.entity) consider(i, foot_on_segment(g, i, near).distance2);
  }
  return best;
}

template <int Dim>
std::array<Point<Dim>, Dim - 1> tangents(const Mesh<Dim>& mesh, VertexId v) {
  const Geometry<Dim>& g = *mesh.geometry;
  const Index at = mesh.anchor[v];
  std::array<Point<Dim>, Dim - 1> out;
  if (mesh.support[v].dim == Dim - 1) {
    const auto& f = g.facets[at];
    if (!g.bends.empty()) {
      const Foot<Dim> foot = foot_on_facet(g, at, mesh.points[v]);
      for (int k = 0; k < Dim - 1; ++k) out[k] = foot.tangent[k];
    } else if constexpr (Dim == 2) {
      out[0] = g.points[f[1]] - g.points[f[0]];
    } else {
      out = {g.points[f[3]] - g.points[f[0]], g.points[f[2]] - g.points[f[1]]};
    }
  } else {
    out.fill(foot_on_segment(g, at, mesh.points[v]).tangent[0]);
  }
  return out;
}

template Point<2> slide(const Geometry<2>&, VertexSupport, Index&, const Point<2>&);
template Point<3> slide(const Geometry<3>&, VertexSupport, Index&, const Point<3>&);
template std::array<Point<2>, 1> tangents(const Mesh<2>&, VertexId);
template std::array<Point<3>, 2> tangents(const Mesh<3>&, VertexId);
template Index anchor_on(const Mesh<2>&, VertexSupport, VertexId, const Point<2>&);
template Index anchor_on(const Mesh<3>&, VertexSupport, VertexId, const Point<3>&);

}  // namespace pillowmesh
