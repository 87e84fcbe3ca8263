#include "pillowmesh/mesh/slide.h"

#include <algorithm>
#include <cmath>

namespace pillowmesh {
namespace {

/// Foot of p on segment ab, and at which end it was cut off: 0, 1 or kNone.
template <int Dim>
struct Foot {
  Point<Dim> point;
  double distance2;
  int cut[Dim - 1];
};

template <int Dim>
Foot<Dim> foot_on_segment(const Point<Dim>& a, const Point<Dim>& b, const Point<Dim>& p) {
  const Point<Dim> e = b - a;
  const double t = e.dot(p - a) / e.squaredNorm();
  Foot<Dim> foot;
  foot.cut[0] = t <= 0 ? 0 : (t >= 1 ? 1 : kNone);
  foot.point = t <= 0 ? a : (t >= 1 ? b : Point<Dim>(a + t * e));
  foot.distance2 = (p - foot.point).squaredNorm();
  return foot;
}

/// Foot of p on the bilinear patch of four corners: Gauss-Newton on (u, v), cut off at the unit square.
Foot<3> foot_on_quad(const std::array<Point<3>, 4>& q, const Point<3>& p) {
  double u = 0.5, v = 0.5;
  Point<3> at;
  for (int i = 0; i < 25; ++i) {
    at = (1 - v) * ((1 - u) * q[0] + u * q[1]) + v * ((1 - u) * q[2] + u * q[3]);
    const Point<3> du = (1 - v) * (q[1] - q[0]) + v * (q[3] - q[2]), dv = (1 - u) * (q[2] - q[0]) + u * (q[3] - q[1]);
    const Point<3> r = p - at;
    double a = du.dot(du), b = du.dot(dv), c = dv.dot(dv), f = du.dot(r), g = dv.dot(r);
    // On a side that the step leads out of, only the other parameter is free.
    const bool fix_u = (u <= 0 && f < 0) || (u >= 1 && f > 0), fix_v = (v <= 0 && g < 0) || (v >= 1 && g > 0);
    double su = 0, sv = 0;
    const double det = a * c - b * b;
    if (!fix_u && !fix_v && det > 1e-30 * a * c) {
      su = (c * f - b * g) / det;
      sv = (a * g - b * f) / det;
    } else if (!fix_u && a > 0) {
      su = f / a;
    } else if (!fix_v && c > 0) {
      sv = g / c;
    }
    const double u1 = std::min(std::max(u + su, 0.0), 1.0), v1 = std::min(std::max(v + sv, 0.0), 1.0);
    const double change = std::abs(u1 - u) + std::abs(v1 - v);
    u = u1;
    v = v1;
    if (change < 1e-15) break;
  }
  Foot<3> foot;
  foot.point = (1 - v) * ((1 - u) * q[0] + u * q[1]) + v * ((1 - u) * q[2] + u * q[3]);
  foot.distance2 = (p - foot.point).squaredNorm();
  foot.cut[0] = u <= 0 ? 0 : (u >= 1 ? 1 : kNone);
  foot.cut[1] = v <= 0 ? 0 : (v >= 1 ? 1 : kNone);
  return foot;
}

template <int Dim>
Foot<Dim> foot_on_facet(const Geometry<Dim>& g, Index i, const Point<Dim>& p) {
  const auto& f = g.facets[i];
  if constexpr (Dim == 2)
    return foot_on_segment<2>(g.points[f[0]], g.points[f[1]], p);
  else
    return foot_on_quad({g.points[f[0]], g.points[f[1]], g.points[f[2]], g.points[f[3]]}, p);
}

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
      [&](Index i) {
        const auto& s = geometry.segments[i];
        return foot_on_segment<Dim>(geometry.points[s[0]], geometry.points[s[1]], target);
      },
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
      if (g.curve[i] == support.entity)
        consider(i, foot_on_segment<Dim>(g.points[g.segments[i][0]], g.points[g.segments[i][1]], near).distance2);
  }
  return best;
}

template Point<2> slide(const Geometry<2>&, VertexSupport, Index&, const Point<2>&);
template Point<3> slide(const Geometry<3>&, VertexSupport, Index&, const Point<3>&);
template Index anchor_on(const Mesh<2>&, VertexSupport, VertexId, const Point<2>&);
template Index anchor_on(const Mesh<3>&, VertexSupport, VertexId, const Point<3>&);

}  // namespace pillowmesh
