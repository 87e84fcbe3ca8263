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
    sum += corner_energy(p[(i + 1) & 3] - p[i], edges_[c][i], p[(i + 3) & 3] - p[i], edges_[c][(i + 3) & 3], weights_);
  if (shaped()) {
    std::array<SizeTensor, 4> H;
    for (int i = 0; i < 4; ++i) H[i] = size_[around(mesh_, c, i)];
    const std::array<double, 2> across{diagonal(p[1], H[1], p[3], H[3]), diagonal(p[0], H[0], p[2], H[2])};
    for (int i = 0; i < 4; ++i) sum += shape_energy(edges_[c][i], edges_[c][(i + 3) & 3], across[i & 1], weights_);
  }
  energy_[c] = sum;
}

double QuadRelocator::diagonal(const Point<2>& p, const SizeTensor& P, const Point<2>& q, const SizeTensor& Q) {
  return edge_term(background_, p, P, q, Q, false).l;
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
    const VertexId o = around(mesh_, c, i + 2);
    w.o = mesh_.points[o];
    w.H = size_[o];
    w.far1 = edges_[c][(i + 1) & 3];
    w.far2 = edges_[c][(i + 2) & 3];
  }
  if (shaped())
    for (int k = 0; k < star_.count; ++k) {
      const Spoke &a = spokes_[k], &b = spokes_[k + 1 == spoke_count_ ? 0 : k + 1];
      wedges_[k].diagonal = diagonal(a.q, a.H, b.q, b.H);
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
    w.energy = corner_energy(a.q - x, a.next, b.q - x, b.next, weights_) +
               corner_energy(w.o - a.q, w.far1, x - a.q, a.next, weights_) +
               corner_energy(x - b.q, b.next, w.o - b.q, w.far2, weights_);
    if (shaped()) {
      const double out = diagonal(x, size_at_, w.o, w.H);
      w.energy += shape_energy(a.next, b.next, w.diagonal, weights_) + shape_energy(w.far1, a.next, out, weights_) +
                  shape_energy(b.next, w.far2, out, weights_);
    }
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
    const Spoke& s = spokes_[k];
    slope[k] = edge_slope(s.q - x, s.now, here, background_.jet(0.5 * (x + s.q)), s.H, weights_);
  }

  // Sum over the corners that change.
  sum = {};
  for (int k = 0; k < star_.count; ++k) {
    const int n = k + 1 == spoke_count_ ? 0 : k + 1;
    const Spoke &a = spokes_[k], &b = spokes_[n];
    const Wedge& w = wedges_[k];
    // cross(a.q - x, b.q - x): its gradient is the edge from b to a turned.
    add_corner(a.q - x, a.now, &slope[k], b.q - x, b.now, &slope[n], Point<2>(a.q[1] - b.q[1], b.q[0] - a.q[0]), weights_, sum);
    // At the ends of the spokes the edge points the other way.
    EdgeSlope back = slope[k];
    back.sign = 1.0;
    const Point<2> f = w.o - a.q;
    add_corner(f, w.far1, nullptr, x - a.q, a.now, &back, Point<2>(-f[1], f[0]), weights_, sum);
    EdgeSlope forth = slope[n];
    forth.sign = 1.0;
    const Point<2> g = w.o - b.q;
    add_corner(x - b.q, b.now, &forth, g, w.far2, nullptr, Point<2>(g[1], -g[0]), weights_, sum);
    if (!shaped()) continue;
    const EdgeTerm out = edge_term(background_, x, here.H, w.o, w.H, false);
    const EdgeSlope dout = edge_slope(w.o - x, out, here, background_.jet(0.5 * (x + w.o)), w.H, {});
    add_shape(a.now, &slope[k], b.now, &slope[n], w.diagonal, nullptr, weights_, sum);
    add_shape(w.far1, nullptr, a.now, &slope[k], out.l, &dout, weights_, sum);
    add_shape(b.now, &slope[n], w.far2, nullptr, out.l, &dout, weights_, sum);
  }

  return true;
}

Point<2> curve_direction(const Mesh<2>& mesh, VertexId v) {
  return tangents(mesh, v)[0].normalized();
}

double QuadRelocator::relocate(VertexId v) {
  const VertexSupport support = mesh_.support[v];
  Derivatives sum;
  if (support.dim == 0 || !derivatives(v, sum)) return 0.0;
  const Point<2> x = mesh_.points[v];
  const double before = sum.value;
  const Point<2> step = support.dim == 2 ? sum.step() : sum.step_along(curve_direction(mesh_, v));
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
      energy_[w.cell] = w.energy + corner_energy(b.q - w.o, w.far2, a.q - w.o, w.far1, weights_);
      if (shaped()) energy_[w.cell] += shape_energy(w.far2, w.far1, w.diagonal, weights_);
    }
    return before - after;
  }
  return 0.0;
}

}  // namespace pillowmesh
