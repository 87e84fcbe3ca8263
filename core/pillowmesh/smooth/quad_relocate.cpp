#include "pillowmesh/smooth/quad_relocate.h"

#include <algorithm>

#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {
namespace {

/// Edge from p (sizes P) to q (sizes Q) by Simpson's rule, by Boole's points where its three values disagree.
EdgeTerm edge_term(Background& background, const Point<2>& p, const SizeTensor& P, const Point<2>& q,
                   const SizeTensor& Q, bool aligned) {
  const Point<2> e = q - p;
  const SizeTensor H = background.at(0.5 * (p + q));
  const double a = length_in(P, e), m = length_in(H, e), b = length_in(Q, e);
  const Shape2 G = shape_of(H);
  EdgeTerm term{(a + b + 4.0 * m) / 6.0, G.g11, G.g12, G.g22, aligned ? misalignment(G, e) : 0.0};
  if (std::abs(a + b - 2.0 * m) > 0.3 * term.l) {
    const double s = length_in(background.at(0.25 * q + 0.75 * p), e), t = length_in(background.at(0.25 * p + 0.75 * q), e);
    term.l = (a + b + 4.0 * (s + t) + 2.0 * m) / 12.0;
  }
  return term;
}

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

/// Gradient of an edge's terms by the position of its moving end.
struct EdgeSlope {
  Point<2> e;      ///< the edge, out of the corner
  double sign;     ///< d e / d x
  Point<2> dl, ds;
  double dll;      ///< l^2 / (e' G e) with the edge's own G: frozen Hessian of l^2 is twice that times G
  bool moves;
};

}  // namespace

QuadRelocator::QuadRelocator(Mesh<2>& mesh, Background& background, const Weights& weights)
    : mesh_(mesh), background_(background) {
  measure_all(weights);
}

void QuadRelocator::measure_all(const Weights& weights) {
  weights_ = weights;
  size_.resize(mesh_.points.size());
  edges_.resize(mesh_.cells.size());
  energy_.assign(mesh_.cells.size(), 0.0);
  begin();
  for (VertexId v = 0; v < mesh_.vertex_count(); ++v)
    if (mesh_.vertex_cell[v] != kNone) size_[v] = background_.at(mesh_.points[v]);
  for (CellId c = 0; c < mesh_.cell_count(); ++c)
    if (mesh_.alive(c)) measure_cell(c);
  begin();
}

double QuadRelocator::total_energy() const {
  double sum = 0.0;
  for (CellId c = 0; c < mesh_.cell_count(); ++c)
    if (mesh_.alive(c)) sum += energy_[c];
  return sum;
}

void QuadRelocator::begin() {
  cell_stamp_.resize(mesh_.cells.size(), 0);
  vertex_stamp_.resize(mesh_.points.size(), 0);
  ++stamp_;
  old_cells_.clear();
  old_edges_.clear();
  old_energy_.clear();
  old_vertices_.clear();
  old_sizes_.clear();
}

void QuadRelocator::undo() {
  for (std::size_t i = 0; i < old_cells_.size(); ++i) {
    edges_[old_cells_[i]] = old_edges_[i];
    energy_[old_cells_[i]] = old_energy_[i];
  }
  for (std::size_t i = 0; i < old_vertices_.size(); ++i) size_[old_vertices_[i]] = old_sizes_[i];
}

void QuadRelocator::touch_cell(CellId c) {
  if (c >= static_cast<CellId>(cell_stamp_.size()) || cell_stamp_[c] == stamp_) return;
  cell_stamp_[c] = stamp_;
  old_cells_.push_back(c);
  old_edges_.push_back(edges_[c]);
  old_energy_.push_back(energy_[c]);
}

void QuadRelocator::touch_vertex(VertexId v) {
  if (v >= static_cast<VertexId>(vertex_stamp_.size()) || vertex_stamp_[v] == stamp_) return;
  vertex_stamp_[v] = stamp_;
  old_vertices_.push_back(v);
  old_sizes_.push_back(size_[v]);
}

void QuadRelocator::measure_vertex(VertexId v) {
  if (v >= static_cast<VertexId>(size_.size())) size_.resize(mesh_.points.size());
  touch_vertex(v);
  size_[v] = background_.at(mesh_.points[v]);
}

double QuadRelocator::corner(const Point<2>& e1, const EdgeTerm& a, const Point<2>& e2, const EdgeTerm& b) const {
  const double cross = e1[0] * e2[1] - e1[1] * e2[0];
  if (weights_.delta == 0.0 && !(cross > 0)) return std::numeric_limits<double>::infinity();
  const double g11 = a.g11 + b.g11, g12 = a.g12 + b.g12, g22 = a.g22 + b.g22;  // twice G: the factor cancels
  const double q1 = g11 * e1[0] * e1[0] + 2.0 * g12 * e1[0] * e1[1] + g22 * e1[1] * e1[1];
  const double q2 = g11 * e2[0] * e2[0] + 2.0 * g12 * e2[0] * e2[1] + g22 * e2[1] * e2[1];
  const double L1 = a.l * a.l, L2 = b.l * b.l;
  double d = cross * std::sqrt((g11 * g22 - g12 * g12) * (L1 * L2) / (q1 * q2));
  const double area = d, T = L1 + L2;
  if (weights_.delta > 0.0) d = 0.5 * (d + std::sqrt(d * d + 4.0 * weights_.delta * weights_.delta));
  double E = 0.25 * (d * (0.5 * T - 2.0 + 0.5 * weights_.alignment * (a.s + b.s)) + 0.5 * T / d);
  if (weights_.shape > 0.0) {
    const double dot = g11 * e1[0] * e2[0] + g12 * (e1[0] * e2[1] + e1[1] * e2[0]) + g22 * e1[1] * e2[1];
    const double eta = 2.0 * area / (T - dot * std::sqrt(L1 * L2 / (q1 * q2)));
    const double lack = weights_.shape_floor - eta;
    if (lack > 0) E += weights_.shape * lack * lack;
  }
  return E;
}

double QuadRelocator::measure_cell(CellId c) {
  if (c >= static_cast<CellId>(energy_.size())) {
    energy_.resize(mesh_.cells.size(), 0.0);
    edges_.resize(mesh_.cells.size());
  }
  touch_cell(c);
  std::array<VertexId, 4> v;
  for (int i = 0; i < 4; ++i) v[i] = around(mesh_, c, i);
  for (int i = 0; i < 4; ++i) {
    const VertexId p = v[i], q = v[(i + 1) & 3];
    edges_[c][i] = edge_term(background_, mesh_.points[p], size_[p], mesh_.points[q], size_[q], weights_.alignment > 0.0);
  }
  add_up(c);
  return energy_[c];
}

void QuadRelocator::add_up(CellId c) {
  std::array<Point<2>, 4> p;
  for (int i = 0; i < 4; ++i) p[i] = mesh_.points[around(mesh_, c, i)];
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
    sum += corner(p[(i + 1) & 3] - p[i], edges_[c][i], p[(i + 3) & 3] - p[i], edges_[c][(i + 3) & 3]);
  energy_[c] = sum;
}

void QuadRelocator::refresh(CellId c) {
  touch_cell(c);
  add_up(c);
}

void QuadRelocator::forget_cell(CellId c) {
  touch_cell(c);
  energy_[c] = 0.0;
}

double QuadRelocator::change() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < old_cells_.size(); ++i) sum += energy_[old_cells_[i]] - old_energy_[i];
  for (std::size_t c = cell_stamp_.size(); c < mesh_.cells.size(); ++c) sum += energy_[c];
  return sum;
}

bool QuadRelocator::collect(VertexId v) {
  if (!find_star(mesh_, v, star_)) return false;
  spoke_count_ = star_.count + (star_.closed ? 0 : 1);
  for (int k = 0; k < star_.count; ++k) {
    const CellId c = star_.cell[k];
    const int i = star_.place[k];
    Spoke& s = spokes_[k];
    s.end = around(mesh_, c, i + 1);
    s.q = mesh_.points[s.end];
    s.H = size_[s.end];
    s.now = edges_[c][i];
    if (k + 1 == star_.count && !star_.closed) {
      Spoke& last = spokes_[k + 1];
      last.end = around(mesh_, c, i + 3);
      last.q = mesh_.points[last.end];
      last.H = size_[last.end];
      last.now = edges_[c][(i + 3) & 3];
    }
    Wedge& w = wedges_[k];
    w.cell = c;
    w.place = i;
    w.o = mesh_.points[around(mesh_, c, i + 2)];
    w.far1 = edges_[c][(i + 1) & 3];
    w.far2 = edges_[c][(i + 2) & 3];
  }
  return true;
}

/// Energy of the corners with the vertex at x; what is above `limit` is not added up to the end.
double QuadRelocator::try_at(const Point<2>& x, double limit) {
  size_at_ = background_.at(x);
  const bool aligned = weights_.alignment > 0.0;
  for (int k = 0; k < spoke_count_; ++k) spokes_[k].next = edge_term(background_, x, size_at_, spokes_[k].q, spokes_[k].H, aligned);
  double sum = 0.0;
  for (int k = 0; k < star_.count; ++k) {
    const Spoke &a = spokes_[k], &b = spokes_[k + 1 == spoke_count_ ? 0 : k + 1];
    Wedge& w = wedges_[k];
    w.energy = corner(a.q - x, a.next, b.q - x, b.next) + corner(w.o - a.q, w.far1, x - a.q, a.next) +
               corner(x - b.q, b.next, w.o - b.q, w.far2);
    sum += w.energy;
    if (!(sum < limit)) break;
  }
  return sum;
}

bool QuadRelocator::derivatives(VertexId v, Derivatives& sum) {
  if (!collect(v)) return false;
  const Point<2> x = mesh_.points[v];

  // Derivatives of the spokes' lengths and alignments.
  const SizeJet here = background_.jet(x);
  std::array<EdgeSlope, OrderedStar::most + 1> slope;
  for (int k = 0; k < spoke_count_; ++k) {
    Spoke& s = spokes_[k];
    const Point<2> e = s.q - x;
    const SizeJet mid = background_.jet(0.5 * (x + s.q));
    const Sample a(here.H, e), m(mid.H, e), b(s.H, e);
    const double factor = s.now.l / (a.l + 4.0 * m.l + b.l);  // 1/6, but where two more points were looked at
    const Point<2> by_e = a.by_edge(here.H) + 4.0 * m.by_edge(mid.H) + b.by_edge(s.H);
    const Shape2 G{s.now.g11, s.now.g12, s.now.g22};
    EdgeSlope& d = slope[k];
    d.e = e;
    d.dl = factor * (Point<2>(a.by_sizes(here.H, here.dx, e) + 2.0 * m.by_sizes(mid.H, mid.dx, e),
                              a.by_sizes(here.H, here.dy, e) + 2.0 * m.by_sizes(mid.H, mid.dy, e)) -
                     by_e);
    d.ds = Point<2>::Zero();
    if (weights_.alignment > 0.0)
      d.ds = 0.5 * Point<2>(misalignment_by_sizes(mid.H, G, mid.dx, e), misalignment_by_sizes(mid.H, G, mid.dy, e)) -
             misalignment_by_edge(G, e);
    d.dll = s.now.l * s.now.l / scalar(G, e);
  }

  // Sum over the corners that change.
  sum = {};
  const auto add = [&](const Point<2>& e1, const EdgeTerm& a, const EdgeSlope* da, const Point<2>& e2,
                       const EdgeTerm& b, const EdgeSlope* db, const Point<2>& dcross) {
    const double cross = e1[0] * e2[1] - e1[1] * e2[0];
    const double g11 = a.g11 + b.g11, g12 = a.g12 + b.g12, g22 = a.g22 + b.g22;
    const double q1 = g11 * e1[0] * e1[0] + 2.0 * g12 * e1[0] * e1[1] + g22 * e1[1] * e1[1];
    const double q2 = g11 * e2[0] * e2[0] + 2.0 * g12 * e2[0] * e2[1] + g22 * e2[1] * e2[1];
    const double L1 = a.l * a.l, L2 = b.l * b.l, T = L1 + L2;
    const double kappa = std::sqrt((g11 * g22 - g12 * g12) * (L1 * L2) / (q1 * q2));
    const double raw = cross * kappa;
    double d = raw, chain = 1.0;
    if (weights_.delta > 0.0) {
      const double root = std::sqrt(d * d + 4.0 * weights_.delta * weights_.delta);
      d = 0.5 * (d + root);
      chain = d / root;
    }
    const double align = 0.5 * weights_.alignment;
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
    if (weights_.shape > 0.0) {
      const double dot = g11 * e1[0] * e2[0] + g12 * (e1[0] * e2[1] + e1[1] * e2[0]) + g22 * e1[1] * e2[1];
      const double mean = dot * std::sqrt(L1 * L2 / (q1 * q2)), D = T - mean, eta = 2.0 * raw / D;
      const double lack = weights_.shape_floor - eta;
      if (lack > 0) {
        sum.value += weights_.shape * lack * lack;
        // d eta = (2 d raw - eta dD) / D, the mean product taken with the metric frozen.
        Point<2> gm = Point<2>::Zero();
        const double ratio = std::sqrt(L1 * L2 / (q1 * q2));
        if (da != nullptr) gm += (ratio * da->sign) * Point<2>(g11 * e2[0] + g12 * e2[1], g12 * e2[0] + g22 * e2[1]);
        if (db != nullptr) gm += (ratio * db->sign) * Point<2>(g11 * e1[0] + g12 * e1[1], g12 * e1[0] + g22 * e1[1]);
        const Point<2> ge = (1.0 / D) * ((2.0 / chain) * gdm - eta * (gT - gm));
        sum.gradient -= 2.0 * weights_.shape * lack * ge;
        sum.xx += 2.0 * weights_.shape * ge[0] * ge[0];
        sum.xy += 2.0 * weights_.shape * ge[0] * ge[1];
        sum.yy += 2.0 * weights_.shape * ge[1] * ge[1];
      }
    }
  };
  for (int k = 0; k < spoke_count_; ++k) slope[k].sign = -1.0;
  for (int k = 0; k < star_.count; ++k) {
    const int n = k + 1 == spoke_count_ ? 0 : k + 1;
    const Spoke &a = spokes_[k], &b = spokes_[n];
    const Wedge& w = wedges_[k];
    // cross(a.q - x, b.q - x): its gradient is the edge from b to a turned.
    add(slope[k].e, a.now, &slope[k], slope[n].e, b.now, &slope[n],
        Point<2>(a.q[1] - b.q[1], b.q[0] - a.q[0]));
    // At the ends of the spokes the edge points the other way.
    EdgeSlope back = slope[k];
    back.sign = 1.0;
    const Point<2> f = w.o - a.q;
    add(f, w.far1, nullptr, x - a.q, a.now, &back, Point<2>(-f[1], f[0]));
    EdgeSlope forth = slope[n];
    forth.sign = 1.0;
    const Point<2> g = w.o - b.q;
    add(x - b.q, b.now, &forth, g, w.far2, nullptr, Point<2>(g[1], -g[0]));
  }

  return true;
}

Point<2> QuadRelocator::Derivatives::step() const {
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

double QuadRelocator::Derivatives::step_along(const Point<2>& t) const {
  const double h = std::abs(xx * t[0] * t[0] + 2 * xy * t[0] * t[1] + yy * t[1] * t[1]);
  return h > 0 ? -t.dot(gradient) / h : 0.0;
}

double QuadRelocator::relocate(VertexId v) {
  const VertexSupport support = mesh_.support[v];
  Derivatives sum;
  if (support.dim == 0 || !derivatives(v, sum)) return 0.0;
  const Point<2> x = mesh_.points[v];
  const double before = sum.value;
  Point<2> step;
  if (support.dim == 2) {
    step = sum.step();
  } else {
    const Geometry<2>& geometry = *mesh_.geometry;
    const auto& f = geometry.facets[mesh_.anchor[v]];
    const Point<2> t = (geometry.points[f[1]] - geometry.points[f[0]]).normalized();
    step = sum.step_along(t) * t;
  }
  const double reach = length_in(size_[v], step);
  const double slope_along = sum.gradient.dot(step);
  if (!(-slope_along > rest)) return 0.0;
  const double most = 0.5;
  double scale = reach * relaxation > most ? most / reach : relaxation;
  for (int attempt = 0; attempt < 5; ++attempt, scale *= 0.4) {
    Point<2> y = x + scale * step;
    Index anchor = mesh_.anchor[v];
    if (support.dim == 1) y = slide(*mesh_.geometry, support, anchor, y);
    const double after = try_at(y, before);
    if (!(after < before + 1e-4 * scale * std::min(0.0, slope_along))) continue;
    if (journal != nullptr) journal->touch(v);
    touch_vertex(v);
    size_[v] = size_at_;
    mesh_.points[v] = y;
    mesh_.anchor[v] = anchor;
    for (int k = 0; k < star_.count; ++k) {
      const int n = k + 1 == spoke_count_ ? 0 : k + 1;
      const Wedge& w = wedges_[k];
      touch_cell(w.cell);
      edges_[w.cell][w.place] = spokes_[k].next;
      edges_[w.cell][(w.place + 3) & 3] = spokes_[n].next;
      const Spoke &a = spokes_[k], &b = spokes_[n];
      energy_[w.cell] = w.energy + corner(b.q - w.o, w.far2, a.q - w.o, w.far1);
    }
    return before - after;
  }
  return 0.0;
}

}  // namespace pillowmesh
