// Derivatives of the energy of quad_energy.h by the position x of one vertex.
//
// Gradients include the change of the metric along the edges; that of the metric by which angles are measured is left
// out. Hessians are those of the metric held fixed.
#pragma once

#include "pillowmesh/smooth/quad_energy.h"

namespace pillowmesh {

/// Energy of some corners, and its derivatives.
template <class R>
struct QuadDerivativesOf {
  R value = same<R>(0), x = same<R>(0), y = same<R>(0), xx = same<R>(0), xy = same<R>(0), yy = same<R>(0);
};

struct QuadDerivatives {
  double value = 0.0;
  Point<2> gradient = Point<2>::Zero();
  double xx = 0.0, xy = 0.0, yy = 0.0;

  /// The first lanes of d.
  template <class R>
  PILLOWMESH_LANES void add(const QuadDerivativesOf<R>& d, int lanes) {
    for (int i = 0; i < lanes; ++i) {
      value += d.value[i];
      gradient[0] += d.x[i], gradient[1] += d.y[i];
      xx += d.xx[i], xy += d.xy[i], yy += d.yy[i];
    }
  }
  /// Newton's step with the eigenvalues of the Hessian made positive.
  [[nodiscard]] Point<2> step() const;
  /// The same along a unit vector.
  [[nodiscard]] Point<2> step_along(const Point<2>& t) const;
};

/// How what the energy asks of an edge depends on x, the position of one of its ends.
template <class R>
struct EdgeSlopeOf {
  R lx, ly;  ///< gradient of the logarithm of the length
  R sx, sy;  ///< of the misalignment
  R frozen;  ///< l^2 / (e' G e): with the metric fixed the Hessian of l^2 is twice that times G
  R turn;    ///< misalignment is about turn / 8 times the square of the edge's move sideways
};
using EdgeSlope = EdgeSlopeOf<double>;

/// Of the edge e = q - p with p = x, these terms, and sizes at its ends.
template <class R>
PILLOWMESH_LANES EdgeSlopeOf<R> edge_slope(const EdgeLookup& at, const EnergyWeights& weights, const R& px, const R& py, const R& ex, const R& ey,
                                 const EdgeTermOf<R>& term, const JetOf<R>& p, const JetOf<R>& q) {
  std::array<SizeJet, 2 * kWidth<R>> jets;
  const auto look_up = [&](int k, const Point<2>& x) { return (jets[k] = at.background.jet(x, at.hints[k])).H; };
  const EdgeSizes<R> s = edge_sizes(at.lanes, weights.rough, px, py, ex, ey, p, q, look_up);
  EdgeSlopeOf<R> d;
  d.lx = d.ly = same<R>(0);
  // A place t of the way from x to q moves by (1 - t) of what x does.
  const auto sample = [&](double t, int k, const R& a, const R& b, const R& c, const R& det) PILLOWMESH_LANES_LAMBDA {
    const R x = c * ex - b * ey, y = a * ey - b * ex, n = root(x * x + y * y);
    const R both = 1.0 / (n * det), i_det = n * both, l = n * i_det;
    const double w = 1.0 - t;
    R ax = w * p.ax + t * q.ax, bx = w * p.bx + t * q.bx, cx = w * p.cx + t * q.cx;
    R ay = w * p.ay + t * q.ay, by = w * p.by + t * q.by, cy = w * p.cy + t * q.cy;
    for (int i = 0; i < kWidth<R>; ++i) {
      if (!s.rough[i]) continue;
      const SizeJet& j = jets[2 * i + k];
      set_lane(ax, i, j.dx.a), set_lane(bx, i, j.dx.b), set_lane(cx, i, j.dx.c);
      set_lane(ay, i, j.dy.a), set_lane(by, i, j.dy.b), set_lane(cy, i, j.dy.c);
    }
    const auto by_sizes = [&](const R& da, const R& db, const R& dc) PILLOWMESH_LANES_LAMBDA {
      return (x * (dc * ex - db * ey) + y * (da * ey - db * ex)) * both - l * (da * c + a * dc - 2.0 * b * db) * i_det;
    };
    d.lx = d.lx + 0.5 * (w * by_sizes(ax, bx, cx) - (c * x - b * y) * both);
    d.ly = d.ly + 0.5 * (w * by_sizes(ay, by, cy) - (a * y - b * x) * both);
  };
  sample(kGauss, 0, s.a1, s.b1, s.c1, s.det1);
  sample(kGauss2, 1, s.a2, s.b2, s.c2, s.det2);

  const R i_l = 1.0 / term.l;
  d.lx = i_l * d.lx, d.ly = i_l * d.ly;

  const R Gx = term.g11 * ex + term.g12 * ey, Gy = term.g12 * ex + term.g22 * ey, q_G = ex * Gx + ey * Gy;
  const R i_q = 1.0 / q_G;
  d.frozen = term.l * term.l * i_q;
  d.sx = d.sy = d.turn = same<R>(0);
  if (!(weights.alignment > 0.0)) return d;
  // s = 4 (r (t - r) - 1) / t^2 with r = |e|^2 / (e' G e), t = tr G.
  const R n = ex * ex + ey * ey, r = n * i_q, t = term.g11 + term.g22, i_t = 1.0 / t, i_t2 = i_t * i_t;
  const R by_r = 4.0 * (t - 2.0 * r) * i_t2, by_t = 4.0 * r * i_t2 - 2.0 * term.s * i_t;
  const R a = 0.5 * (s.a1 + s.a2), b = 0.5 * (s.b1 + s.b2), c = 0.5 * (s.c1 + s.c2), i_det = 1.0 / (a * c - b * b);
  const auto by_sizes = [&](const R& da, const R& db, const R& dc) PILLOWMESH_LANES_LAMBDA {
    const R ddet = da * c + a * dc - 2.0 * b * db;
    const R d11 = (2.0 * (c * dc + b * db) - term.g11 * ddet) * i_det;
    const R d12 = (-(db * (a + c) + b * (da + dc)) - term.g12 * ddet) * i_det;
    const R d22 = (2.0 * (a * da + b * db) - term.g22 * ddet) * i_det;
    const R dr = -(r * i_q) * (d11 * ex * ex + 2.0 * d12 * ex * ey + d22 * ey * ey);
    return by_r * dr + by_t * (d11 + d22);
  };
  const R by_e = by_r * 2.0 * i_q;
  d.sx = 0.25 * by_sizes(p.ax + q.ax, p.bx + q.bx, p.cx + q.cx) - by_e * (ex - r * Gx);
  d.sy = 0.25 * by_sizes(p.ay + q.ay, p.by + q.by, p.cy + q.cy) - by_e * (ey - r * Gy);
  d.turn = 8.0 * larger(1.0 - 4.0 * i_t2 - 2.0 * term.s, same<R>(0)) / (n * n);
  return d;
}

template <class R>
PILLOWMESH_LANES EdgeSlopeOf<R> edge_slope(Background& background, Index leaf, const EnergyWeights& weights, const R& px, const R& py, const R& ex,
                                 const R& ey, const EdgeTermOf<R>& term, const JetOf<R>& p, const JetOf<R>& q) {
  EdgeHints<kWidth<R>> hints(leaf);
  return edge_slope(EdgeLookup{background, hints.data(), kWidth<R>}, weights, px, py, ex, ey, term, p, q);
}

/// Corner of two edges e1 = q1 - x and e2 = q2 - x in counterclockwise order (Moving = 2), or of a fixed edge e2 and an edge
/// e1 = q1 - x with the vertex at its far end (Moving = 1). `cross`: of the corner's edges, with its gradient.
template <int Moving, class R>
PILLOWMESH_LANES void add_corner(const R& cross, const R& cross_x, const R& cross_y, const R& e1x, const R& e1y,
                       const EdgeTermOf<R>& a, const EdgeSlopeOf<R>& da, const R& e2x, const R& e2y, const EdgeTermOf<R>& b,
                       const EdgeSlopeOf<R>& db, const EnergyWeights& weights, QuadDerivativesOf<R>& sum) {
  const R g11 = a.g11 + b.g11, g12 = a.g12 + b.g12, g22 = a.g22 + b.g22;
  const R G1x = g11 * e1x + g12 * e1y, G1y = g12 * e1x + g22 * e1y, q1 = e1x * G1x + e1y * G1y;
  const R G2x = g11 * e2x + g12 * e2y, G2y = g12 * e2x + g22 * e2y, q2 = e2x * G2x + e2y * G2y;
  const R L1 = a.l * a.l, L2 = b.l * b.l, T = 0.5 * (L1 + L2);
  const R i_qq = 1.0 / (q1 * q2);
  const R kappa = root((g11 * g22 - g12 * g12) * (L1 * L2) * i_qq);
  const R raw = cross * kappa;
  R d = raw, chain = same<R>(1);
  if (weights.delta > 0.0) {
    const R h = root(d * d + 4.0 * weights.delta * weights.delta);
    d = 0.5 * (d + h);
    chain = d / h;
  }
  const double align = 0.5 * weights.alignment;
  const R i_d = 1.0 / d, i_d2 = i_d * i_d;
  const R u = T - 2.0 + align * (a.s + b.s);
  const R ud = u - T * i_d2, uT = 0.5 * (d + i_d);
  const R off_a = a.l - 1.0, off_b = b.l - 1.0;
  sum.value = sum.value + (0.25 * (d * u + T * i_d) + weights.length * (off_a * off_a + off_b * off_b));

  // gd: gradient of d with the metric frozen, for the Hessian; md: that with l and q changing (l^2 / q does not when frozen).
  R gdx = kappa * cross_x, gdy = kappa * cross_y;
  const R s1 = 0.25 * ud * chain, s2 = 0.25 * uT, s3 = (0.25 * align) * d;
  const R w1 = raw * (q2 * i_qq);
  R mdx = gdx + raw * da.lx + w1 * G1x, mdy = gdy + raw * da.ly + w1 * G1y;
  R gTx = 2.0 * L1 * da.lx, gTy = 2.0 * L1 * da.ly, gsx = da.sx, gsy = da.sy;
  const double twice = 2.0 * weights.length;
  const R m1 = twice * L1;  // of the square of the gradient of l = l times that of log l
  const R n1 = twice * off_a * a.l;
  R glx = n1 * da.lx, gly = n1 * da.ly;
  const R f1 = 2.0 * s2 * da.frozen, k1 = s3 * da.turn;
  R h11 = f1 * a.g11 + k1 * e1y * e1y + m1 * da.lx * da.lx, h12 = f1 * a.g12 - k1 * e1x * e1y + m1 * da.lx * da.ly,
    h22 = f1 * a.g22 + k1 * e1x * e1x + m1 * da.ly * da.ly;
  if constexpr (Moving == 2) {
    const R w2 = raw * (q1 * i_qq);
    mdx = mdx + raw * db.lx + w2 * G2x, mdy = mdy + raw * db.ly + w2 * G2y;
    gTx = gTx + 2.0 * L2 * db.lx, gTy = gTy + 2.0 * L2 * db.ly, gsx = gsx + db.sx, gsy = gsy + db.sy;
    const R f2 = 2.0 * s2 * db.frozen, k2 = s3 * db.turn;
    const R m2 = twice * L2, n2 = twice * off_b * b.l;
    glx = glx + n2 * db.lx, gly = gly + n2 * db.ly;
    h11 = h11 + (f2 * b.g11 + k2 * e2y * e2y + m2 * db.lx * db.lx);
    h12 = h12 + (f2 * b.g12 - k2 * e2x * e2y + m2 * db.lx * db.ly);
    h22 = h22 + (f2 * b.g22 + k2 * e2x * e2x + m2 * db.ly * db.ly);
  }
  gdx = chain * gdx, gdy = chain * gdy;
  sum.x = sum.x + (s1 * mdx + s2 * gTx + s3 * gsx + glx);
  sum.y = sum.y + (s1 * mdy + s2 * gTy + s3 * gsy + gly);
  const R c1 = 0.125 * (1.0 - i_d2), c2 = 0.5 * T * i_d2 * i_d;
  sum.xx = sum.xx + (2.0 * c1 * gdx * gTx + c2 * gdx * gdx + h11);
  sum.xy = sum.xy + (c1 * (gdx * gTy + gdy * gTx) + c2 * gdx * gdy + h12);
  sum.yy = sum.yy + (2.0 * c1 * gdy * gTy + c2 * gdy * gdy + h22);
}

/// Adds what the shape of a corner costs (`shape_energy`). Lengths and their gradients; null for what does not move.
void add_shape(double a, const Point<2>* da, double b, const Point<2>* db, double diagonal, const Point<2>* dd,
               const EnergyWeights& weights, QuadDerivatives& sum);

}  // namespace pillowmesh
