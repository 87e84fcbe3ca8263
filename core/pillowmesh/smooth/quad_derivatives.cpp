#include "pillowmesh/smooth/quad_derivatives.h"

#include <algorithm>

namespace pillowmesh {
namespace {

/// |H^-1 e| with what its derivatives need: u = adj(H) e, l = |u| / det H.
struct Sample {
  double l, x, y, i_det, i_both;  ///< i_both = 1 / (|u| det H)
  Sample(const SizeTensor& H, const Point<2>& e) {
    x = H.c * e[0] - H.b * e[1];
    y = H.a * e[1] - H.b * e[0];
    const double n = std::sqrt(x * x + y * y);
    i_det = 1.0 / (H.a * H.c - H.b * H.b);
    l = n * i_det;
    i_both = i_det / n;
  }
  /// Gradient by e.
  [[nodiscard]] Point<2> by_edge(const SizeTensor& H) const {
    return {(H.c * x - H.b * y) * i_both, (H.a * y - H.b * x) * i_both};
  }
  /// Change where H changes by dH.
  [[nodiscard]] double by_sizes(const SizeTensor& H, const SizeTensor& d, const Point<2>& e) const {
    const double ddet = d.a * H.c + H.a * d.c - 2.0 * H.b * d.b;
    return (x * (d.c * e[0] - d.b * e[1]) + y * (d.a * e[1] - d.b * e[0])) * i_both - l * ddet * i_det;
  }
};
double scalar(const Shape2& G, const Point<2>& e) {
  return G.g11 * e[0] * e[0] + 2.0 * G.g12 * e[0] * e[1] + G.g22 * e[1] * e[1];
}

/// Gradient of the misalignment of edge e in sizes H: by e, and by the change of H.
Point<2> misalignment_by_edge(const Shape2& G, const Point<2>& e) {
  const double q = scalar(G, e), n = e.squaredNorm(), r = n / q, t = G.g11 + G.g22;
  const Point<2> Ge(G.g11 * e[0] + G.g12 * e[1], G.g12 * e[0] + G.g22 * e[1]);
  return (4.0 * (t - 2.0 * r) / (t * t)) * ((2.0 / q) * (e - r * Ge));
}
double misalignment_by_sizes(const SizeTensor& H, const Shape2& G, const SizeTensor& d, const Point<2>& e) {
  const double i = 1.0 / (H.a * H.c - H.b * H.b), ddet = d.a * H.c + H.a * d.c - 2.0 * H.b * d.b;
  const Shape2 dG{(2.0 * (H.c * d.c + H.b * d.b) - G.g11 * ddet) * i,
                  (-d.b * (H.a + H.c) - H.b * (d.a + d.c) - G.g12 * ddet) * i,
                  (2.0 * (H.a * d.a + H.b * d.b) - G.g22 * ddet) * i};
  const double q = scalar(G, e), r = e.squaredNorm() / q, t = G.g11 + G.g22, dt = dG.g11 + dG.g22;
  const double dr = -r * scalar(dG, e) / q;
  return 4.0 * ((t - 2.0 * r) * dr + r * dt) / (t * t) - 8.0 * (r * (t - r) - 1.0) * dt / (t * t * t);
}

}  // namespace

EdgeSlope edge_slope(const Point<2>& e, const EdgeTerm& term, const SizeJet& here, const SizeJet& middle,
                     const SizeTensor& there, const EnergyWeights& weights) {
  const Sample a(here.H, e), m(middle.H, e), b(there, e);
  const double factor = term.l / (a.l + 4.0 * m.l + b.l);  // 1/6, but where two more points were looked at
  const Point<2> by_e = a.by_edge(here.H) + 4.0 * m.by_edge(middle.H) + b.by_edge(there);
  const Shape2 G{term.g11, term.g12, term.g22};
  EdgeSlope d;
  d.sign = -1.0;
  d.dl = factor * (Point<2>(a.by_sizes(here.H, here.dx, e) + 2.0 * m.by_sizes(middle.H, middle.dx, e),
                            a.by_sizes(here.H, here.dy, e) + 2.0 * m.by_sizes(middle.H, middle.dy, e)) -
                   by_e);
  d.ds = Point<2>::Zero();
  if (weights.alignment > 0.0)
    d.ds = 0.5 * Point<2>(misalignment_by_sizes(middle.H, G, middle.dx, e),
                          misalignment_by_sizes(middle.H, G, middle.dy, e)) -
           misalignment_by_edge(G, e);
  d.dll = term.l * term.l / scalar(G, e);
  return d;
}

void add_corner(const Point<2>& e1, const EdgeTerm& a, const EdgeSlope* da, const Point<2>& e2, const EdgeTerm& b,
                const EdgeSlope* db, const Point<2>& dcross, const EnergyWeights& weights, QuadDerivatives& sum) {
  const double cross = e1[0] * e2[1] - e1[1] * e2[0];
  const double g11 = a.g11 + b.g11, g12 = a.g12 + b.g12, g22 = a.g22 + b.g22;
  const double q1 = g11 * e1[0] * e1[0] + 2.0 * g12 * e1[0] * e1[1] + g22 * e1[1] * e1[1];
  const double q2 = g11 * e2[0] * e2[0] + 2.0 * g12 * e2[0] * e2[1] + g22 * e2[1] * e2[1];
  const double L1 = a.l * a.l, L2 = b.l * b.l, T = L1 + L2;
  const double kappa = std::sqrt((g11 * g22 - g12 * g12) * (L1 * L2) / (q1 * q2));
  const double raw = cross * kappa;
  double d = raw, chain = 1.0;
  if (weights.delta > 0.0) {
    const double root = std::sqrt(d * d + 4.0 * weights.delta * weights.delta);
    d = 0.5 * (d + root);
    chain = d / root;
  }
  const double align = 0.5 * weights.alignment;
  const double u = 0.5 * T - 2.0 + align * (a.s + b.s), ud = u - 0.5 * T / (d * d), uT = 0.5 * (d + 1.0 / d);
  const double E = 0.25 * (d * u + 0.5 * T / d);
  sum.value += E;
  Point<2> gd = kappa * dcross, gT = Point<2>::Zero(), gs = Point<2>::Zero();  // frozen d for the Hessian
  Point<2> gdm = gd;
  double h11 = 0, h12 = 0, h22 = 0;
  const auto edge = [&](const EdgeSlope* s, const EdgeTerm& t, const Point<2>& e, double q) {
    if (s == nullptr) return;
    gT += 2.0 * t.l * s->dl;
    gs += s->ds;
    // l and q both change; with the metric frozen l^2 / q does not.
    const Point<2> dq = 2.0 * Point<2>(g11 * e[0] + g12 * e[1], g12 * e[0] + g22 * e[1]);
    gdm += raw * (s->dl / t.l + (0.5 / q) * dq);
    h11 += 2.0 * s->dll * t.g11, h12 += 2.0 * s->dll * t.g12, h22 += 2.0 * s->dll * t.g22;
    if (align > 0.0) {  // turning the edge: s is about 4 g times the square of the angle
      const double n2 = e.squaredNorm(), tr = t.g11 + t.g22, g = 1.0 - 4.0 / (tr * tr);
      const double k = align * d * 8.0 * std::max(0.0, g - 2.0 * t.s) / (n2 * n2) / uT;
      h11 += k * e[1] * e[1], h12 -= k * e[0] * e[1], h22 += k * e[0] * e[0];
    }
  };
  edge(da, a, da ? (da->sign > 0 ? Point<2>(-e1) : e1) : e1, q1);
  edge(db, b, db ? (db->sign > 0 ? Point<2>(-e2) : e2) : e2, q2);
  gd *= chain;
  gdm *= chain;
  sum.gradient += 0.25 * (ud * gdm + uT * gT + (align * d) * gs);
  const double c1 = 0.25 * 0.5 * (1.0 - 1.0 / (d * d)), c2 = 0.25 * T / (d * d * d), c3 = 0.25 * uT;
  sum.xx += 2.0 * c1 * gd[0] * gT[0] + c2 * gd[0] * gd[0] + c3 * h11;
  sum.xy += c1 * (gd[0] * gT[1] + gd[1] * gT[0]) + c2 * gd[0] * gd[1] + c3 * h12;
  sum.yy += 2.0 * c1 * gd[1] * gT[1] + c2 * gd[1] * gd[1] + c3 * h22;
}

void add_shape(const EdgeTerm& a, const EdgeSlope* da, const EdgeTerm& b, const EdgeSlope* db, double diagonal,
               const EdgeSlope* dd, const EnergyWeights& weights, QuadDerivatives& sum) {
  const double L1 = a.l * a.l, L2 = b.l * b.l, D = diagonal * diagonal;
  const double lack = weights.shape_floor * weights.shape_floor - squared_shape(L1, L2, D);
  if (!(lack > 0)) return;
  const double g = 0.5 * (L1 + L2 - D), i = 1.0 / (L1 + L2 + D), det = L1 * L2 - g * g;
  const double common = 16.0 * i * i, spread = -2.0 * det * i;
  Point<2> d = Point<2>::Zero();
  if (da != nullptr) d += (common * (L2 - g + spread) * 2.0 * a.l) * da->dl;
  if (db != nullptr) d += (common * (L1 - g + spread) * 2.0 * b.l) * db->dl;
  if (dd != nullptr) d += (common * (g + spread) * 2.0 * diagonal) * dd->dl;
  sum.value += weights.shape * lack * lack;
  sum.gradient -= (2.0 * weights.shape * lack) * d;
  sum.xx += 2.0 * weights.shape * d[0] * d[0];
  sum.xy += 2.0 * weights.shape * d[0] * d[1];
  sum.yy += 2.0 * weights.shape * d[1] * d[1];
}

Point<2> QuadDerivatives::step() const {
  const double mean = 0.5 * (xx + yy), diff = 0.5 * (xx - yy), root = std::sqrt(diff * diff + xy * xy);
  double l1 = std::abs(mean + root), l2 = std::abs(mean - root);
  const double floor = 1e-3 * std::max(l1, l2);
  if (!(floor > 0)) return Point<2>::Zero();
  l1 = std::max(l1, floor), l2 = std::max(l2, floor);
  // The part of the gradient along the first eigenvector u, by the projection u u'.
  double uxx = 1.0, uxy = 0.0;
  if (root > 0) uxx = 0.5 * (1.0 + diff / root), uxy = 0.5 * xy / root;
  const Point<2> along(uxx * gradient[0] + uxy * gradient[1], uxy * gradient[0] + (1.0 - uxx) * gradient[1]);
  return -(along / l1 + (gradient - along) / l2);
}

Point<2> QuadDerivatives::step_along(const Point<2>& t) const {
  const double h = std::abs(xx * t[0] * t[0] + 2 * xy * t[0] * t[1] + yy * t[1] * t[1]);
  return (h > 0 ? -t.dot(gradient) / h : 0.0) * t;
}

}  // namespace pillowmesh
