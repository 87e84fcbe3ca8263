// The energy of a quad mesh by which vertices move and by which every change of topology is judged.
//
// A corner with edges e1 and e2 has the integrated metric lengths l1 and l2, and G, the mean of M / sqrt(det M) in the
// middle of both edges. With the angle phi between them in G and d = l1 l2 sin(phi), its metric area,
//
//     E = d w / 4,   w = (l1^2 + l2^2) (1 + 1 / d^2) / 2 - 2 + alignment (s1 + s2) / 2,
//
// the symmetric Dirichlet energy of the map from the unit corner, 0 only for the unit square corner. The weight d makes
// the sums over meshes of different connectivity comparable: E is in units of one ideal cell. s = g sin^2(2 psi), where
// psi is the angle in space between an edge and the nearest eigenvector of M, and g = ((m1 - m2) / (m1 + m2))^2.
//
// The metric along an edge is told from its ends, where sizes and their derivatives are known: in between sizes are cubic.
// Only where that cannot be true, at kinks of the metric, it is looked up along the edge.
//
// Everything is written for R, which is one number, two or four (lanes.h).
#pragma once

#include <array>
#include <limits>

#include "pillowmesh/metric/background.h"
#include "pillowmesh/smooth/lanes.h"

namespace pillowmesh {

/// What the energy asks of an edge.
template <class R>
struct EdgeTermOf {
  R l;              ///< metric length
  R g11, g12, g22;  ///< M / sqrt(det M) in its middle
  R s;              ///< misalignment: g sin^2(2 psi)
};
using EdgeTerm = EdgeTermOf<double>;

/// Sizes, their derivatives by x and y.
template <class R>
struct JetOf {
  R a, b, c, ax, bx, cx, ay, by, cy;
};
inline JetOf<double> jet_of(const SizeJet& j) {
  return {j.H.a, j.H.b, j.H.c, j.dx.a, j.dx.b, j.dx.c, j.dy.a, j.dy.b, j.dy.c};
}

/// Metric length of a short step e.
inline double length_in(const JetOf<double>& H, const Point<2>& e) {
  const double x = H.c * e[0] - H.b * e[1], y = H.a * e[1] - H.b * e[0];
  return std::sqrt(x * x + y * y) / (H.a * H.c - H.b * H.b);
}

/// What the energy is made of besides sizes and angles.
struct EnergyWeights {
  double alignment = 0.0;  ///< of edges with the eigenvectors of M
  /// > 0: d is replaced by (d + sqrt(d^2 + 4 delta^2)) / 2, so that inverted corners have an energy too.
  double delta = 0.0;
  /// Weight of sum max(0, shape_floor^2 - eta^2)^2 over corners.
  double shape = 0.0;
  double shape_floor = 0.65;
  /// Weight of sum max(0, 1 - eta^2): what shapes cost besides, where `shape` is not 0.
  double obtuse = 0.0;
  /// Weight of (l1 - 1)^2 + (l2 - 1)^2 of each corner: what lengths cost besides.
  double length = 0.0;
  /// Where sizes between the ends of an edge cannot be told from there: how much the derivatives may differ from the
  /// change, relative to the least size. 1: lengths are then off by about 1 % at the most.
  double rough = 8.0;
};

/// Where the two points of Gauss's rule are on an edge; their t (1 - t) is 1/6.
inline constexpr double kGauss = 0.21132486540518713, kGauss2 = 0.7886751345948129;
/// Sizes at the points of Gauss's rule on an edge from p to q.
template <class R>
struct EdgeSizes {
  R a1, b1, c1, a2, b2, c2, det1, det2;
  std::array<bool, kWidth<R>> rough;  ///< looked up, since they cannot be told from the ends
};

inline double lane(double a, int) { return a; }
template <class R>
PILLOWMESH_LANES double lane(const R& a, int i) {
  return a[i];
}
inline void set_lane(double& a, int, double value) { a = value; }
template <class R>
PILLOWMESH_LANES void set_lane(R& a, int i, double value) {
  a[i] = value;
}

/// Where edges, one in each lane, are looked up.
struct EdgeLookup {
  Background& background;
  Index* hints;  ///< two for each lane: leaves where its points may be; then those where they are
  int lanes;     ///< that count
};
/// For a few edges at once: first looked for where p may be.
template <int N>
struct EdgeHints : std::array<Index, 2 * N> {
  explicit EdgeHints(Index leaf) { this->fill(leaf); }
};

/// px, py: the position of p. look_up(2 * lane + k, place) gives sizes there, at point k of the rule.
template <class R, class LookUp>
PILLOWMESH_LANES EdgeSizes<R> edge_sizes(int lanes, double rough, const R& px, const R& py, const R& ex, const R& ey, const JetOf<R>& p,
                               const JetOf<R>& q, LookUp look_up) {
  constexpr double u1 = kGauss2 / 6, w1 = kGauss / 6;
  EdgeSizes<R> s;
  R off = same<R>(0);
  const auto cubic = [&](const R& hp, const R& hq, const R& hpx, const R& hpy, const R& hqx, const R& hqy, R& h1, R& h2) PILLOWMESH_LANES_LAMBDA {
    const R D = hq - hp, u = hpx * ex + hpy * ey - D, w = hqx * ex + hqy * ey - D;
    h1 = hp + kGauss * D + (u1 * u - w1 * w);
    h2 = hp + kGauss2 * D + (w1 * u - u1 * w);
    off = off + larger(u, -u) + larger(w, -w);
  };
  cubic(p.a, q.a, p.ax, p.ay, q.ax, q.ay, s.a1, s.a2);
  cubic(p.b, q.b, p.bx, p.by, q.bx, q.by, s.b1, s.b2);
  cubic(p.c, q.c, p.cx, p.cy, q.cx, q.cy, s.c1, s.c2);
  const R least = rough * ((p.a * p.c - p.b * p.b) + (q.a * q.c - q.b * q.b));
  off = off * (p.a + p.c + q.a + q.c);
  for (int i = 0; i < kWidth<R>; ++i) {
    s.rough[i] = i < lanes && !(lane(off, i) < lane(least, i));
    if (!s.rough[i]) continue;
    const double x = lane(px, i), y = lane(py, i), dx = lane(ex, i), dy = lane(ey, i);
    const SizeTensor H1 = look_up(2 * i, Point<2>(x + kGauss * dx, y + kGauss * dy));
    const SizeTensor H2 = look_up(2 * i + 1, Point<2>(x + kGauss2 * dx, y + kGauss2 * dy));
    set_lane(s.a1, i, H1.a), set_lane(s.b1, i, H1.b), set_lane(s.c1, i, H1.c);
    set_lane(s.a2, i, H2.a), set_lane(s.b2, i, H2.b), set_lane(s.c2, i, H2.c);
  }
  s.det1 = s.a1 * s.c1 - s.b1 * s.b1;
  s.det2 = s.a2 * s.c2 - s.b2 * s.b2;
  return s;
}

/// Edge e = q - p. Its length is that of Gauss's rule; the misalignment is that in the middle: with r = |e|^2 / (e' G e)
/// and t = tr G it is 4 (r (t - r) - 1) / t^2.
template <class R>
PILLOWMESH_LANES EdgeTermOf<R> edge_term(const EdgeLookup& at, double rough, const R& px, const R& py, const R& ex, const R& ey, const JetOf<R>& p,
                               const JetOf<R>& q) {
  const auto look_up = [&](int k, const Point<2>& x) { return at.background.at(x, at.hints[k]); };
  const EdgeSizes<R> s = edge_sizes(at.lanes, rough, px, py, ex, ey, p, q, look_up);
  const R x1 = s.c1 * ex - s.b1 * ey, y1 = s.a1 * ey - s.b1 * ex, x2 = s.c2 * ex - s.b2 * ey, y2 = s.a2 * ey - s.b2 * ex;
  EdgeTermOf<R> term;
  term.l = 0.5 * (root(x1 * x1 + y1 * y1) * s.det2 + root(x2 * x2 + y2 * y2) * s.det1) / (s.det1 * s.det2);
  // H in the middle; A = adj(H)^2, G = A / det H.
  const R a = 0.5 * (s.a1 + s.a2), b = 0.5 * (s.b1 + s.b2), c = 0.5 * (s.c1 + s.c2), det = a * c - b * b;
  const R A11 = c * c + b * b, A12 = b * (a + c), A22 = a * a + b * b, t = A11 + A22, n = ex * ex + ey * ey;
  const R q_A = A11 * ex * ex - 2.0 * A12 * ex * ey + A22 * ey * ey;
  const R tq = t * q_A, i = 1.0 / (det * tq * tq), i_det = i * tq * tq, nd = n * det;
  term.g11 = A11 * i_det;
  term.g12 = -A12 * i_det;
  term.g22 = A22 * i_det;
  // r t = n t / q_A, 1 / t_G^2 = det^2 / t^2.
  term.s = 4.0 * (n * t * q_A - nd * nd - q_A * q_A) * (det * det * det) * i;
  return term;
}

template <class R>
PILLOWMESH_LANES EdgeTermOf<R> edge_term(Background& background, Index leaf, double rough, const R& px, const R& py, const R& ex, const R& ey, const JetOf<R>& p,
                               const JetOf<R>& q) {
  EdgeHints<kWidth<R>> hints(leaf);
  return edge_term(EdgeLookup{background, hints.data(), kWidth<R>}, rough, px, py, ex, ey, p, q);
}

/// Energy of a corner whose edges e1, e2 are in counterclockwise order; not meant for one that is degenerate or inside out
/// (cross <= 0) when delta is 0.
template <class R>
PILLOWMESH_LANES R corner_energy(const R& cross, const R& e1x, const R& e1y, const EdgeTermOf<R>& a, const R& e2x, const R& e2y,
                       const EdgeTermOf<R>& b, const EnergyWeights& weights) {
  const R g11 = a.g11 + b.g11, g12 = a.g12 + b.g12, g22 = a.g22 + b.g22;  // twice G: the factor cancels
  const R q1 = g11 * e1x * e1x + 2.0 * g12 * e1x * e1y + g22 * e1y * e1y;
  const R q2 = g11 * e2x * e2x + 2.0 * g12 * e2x * e2y + g22 * e2y * e2y;
  const R L1 = a.l * a.l, L2 = b.l * b.l, T = 0.5 * (L1 + L2);
  R d = cross * root((g11 * g22 - g12 * g12) * (L1 * L2) / (q1 * q2));
  if (weights.delta > 0.0) d = 0.5 * (d + root(d * d + 4.0 * weights.delta * weights.delta));
  const R off_a = a.l - 1.0, off_b = b.l - 1.0;
  return 0.25 * (d * (T - 2.0 + (0.5 * weights.alignment) * (a.s + b.s)) + T / d) + weights.length * (off_a * off_a + off_b * off_b);
}
/// The same, infinite for a corner that is degenerate or inside out when delta is 0.
inline double corner_energy(const Point<2>& e1, const EdgeTerm& a, const Point<2>& e2, const EdgeTerm& b,
                            const EnergyWeights& weights) {
  const double cross = e1[0] * e2[1] - e1[1] * e2[0];
  if (weights.delta == 0.0 && !(cross > 0)) return std::numeric_limits<double>::infinity();
  return corner_energy(cross, e1[0], e1[1], a, e2[0], e2[1], b, weights);
}

/// eta^2 of the flat triangle of a corner, from the squares of its metric edge lengths: L1, L2, and D opposite to the
/// corner. Negative, and smooth, where there is no such triangle.
inline double squared_shape(double L1, double L2, double D) {
  const double g = 0.5 * (L1 + L2 - D), S = L1 + L2 + D;
  return 16.0 * (L1 * L2 - g * g) / (S * S);
}
/// What a corner with these edges and this length opposite to it costs for its shape. The angle in the mean metric of
/// both edges would miss what the metric does between them.
inline double shape_energy(double a, double b, double diagonal, const EnergyWeights& weights) {
  const double eta2 = squared_shape(a * a, b * b, diagonal * diagonal);
  const double obtuse = 1.0 - eta2, lack = weights.shape_floor * weights.shape_floor - eta2;
  if (!(obtuse > 0)) return 0.0;
  return weights.obtuse * obtuse + (lack > 0 ? weights.shape * lack * lack : 0.0);
}

}  // namespace pillowmesh
