#include "pillowmesh/smooth/quad_relocate.h"

#include <algorithm>
#include <utility>

#include "pillowmesh/mesh/overlap.h"
#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {

bool QuadRelocator::collect(VertexId v) {
  if (!find_star(mesh_, v, star_)) return false;
  spoke_count_ = star_.count + (star_.closed ? 0 : 1);
  const auto spoke = [&](int k, CellId c, int place, int side) {
    const VertexId w = around(mesh_, c, place);
    spokes_.end[k] = w;
    spokes_.qx[k] = mesh_.points[w][0];
    spokes_.qy[k] = mesh_.points[w][1];
    spokes_.jet.set(k, size_[w]);
    now_.set(k, edges_[c][side & 3]);
  };
  for (int k = 0; k < star_.count; ++k) {
    const CellId c = star_.cell[k];
    const int i = star_.place[k];
    spoke(k, c, i + 1, i);
    if (k + 1 == star_.count && !star_.closed) spoke(k + 1, c, i + 3, i + 3);
    const VertexId o = around(mesh_, c, i + 2);
    wedges_.ox[k] = mesh_.points[o][0];
    wedges_.oy[k] = mesh_.points[o][1];
    if (shaped()) wedges_.jet[k] = size_[o];
    wedges_.far.set(2 * k, edges_[c][(i + 1) & 3]);
    wedges_.far.set(2 * k + 1, edges_[c][(i + 2) & 3]);
  }
  // Lanes begin anywhere: the next after the last is the first. On the boundary what comes after the last is computed, too,
  // and of no use.
  for (int to = spoke_count_; to < padded(); ++to) {
    const int from = again(to);
    spokes_.end[to] = spokes_.end[from];
    spokes_.qx[to] = spokes_.qx[from];
    spokes_.qy[to] = spokes_.qy[from];
    spokes_.jet.set(to, spokes_.jet.get(from));
    now_.copy(from, to);
  }
  for (int k = 0; k < star_.count; ++k) {
    wedges_.fx[2 * k] = wedges_.ox[k] - spokes_.qx[k];
    wedges_.fy[2 * k] = wedges_.oy[k] - spokes_.qy[k];
    wedges_.fx[2 * k + 1] = spokes_.qx[k + 1] - wedges_.ox[k];
    wedges_.fy[2 * k + 1] = spokes_.qy[k + 1] - wedges_.oy[k];
  }
  if (shaped())
    for (int k = 0; k < star_.count; ++k)
      wedges_.across[k] = length({spokes_.qx[k], spokes_.qy[k]}, spokes_.jet.get(k),
                                 {spokes_.qx[k + 1], spokes_.qy[k + 1]}, spokes_.jet.get(k + 1));
  return true;
}

namespace {

template <class R>
PILLOWMESH_LANES JetOf<R> everywhere(const JetOf<double>& j) {
  return {same<R>(j.a),  same<R>(j.b),  same<R>(j.c),  same<R>(j.ax), same<R>(j.bx),
          same<R>(j.cx), same<R>(j.ay), same<R>(j.by), same<R>(j.cy)};
}


}  // namespace

/// Energy of the corners with the vertex at x; what is above `limit` is not added up to the end.
double QuadRelocator::try_at(const Point<2>& x, double limit) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Row ex, ey;
  for (int k = 0; k < padded(); ++k) ex[k] = spokes_.qx[k] - x[0], ey[k] = spokes_.qy[k] - x[1];
  // What is inside out needs no metric.
  if (weights_.delta == 0.0)
    for (int k = 0; k < star_.count; ++k) {
      const double *fx = &wedges_.fx[2 * k], *fy = &wedges_.fy[2 * k];
      if (!(ex[k] * ey[k + 1] - ey[k] * ex[k + 1] > 0) || !(fy[0] * ex[k] - fx[0] * ey[k] > 0) ||
          !(fy[1] * ex[k + 1] - fx[1] * ey[k + 1] > 0))
        return infinite;
    }
  size_at_ = jet_of(background_.jet(x, leaf_at_));
#if defined(PILLOWMESH_WIDE)
  if (kWide) return wide_sum_of_corners(x, ex, ey, limit);
#endif
  return sum_of_corners<Pair>(x, ex, ey, limit);
}

template <class R>
double QuadRelocator::sum_of_corners(const Point<2>& x, const Row& ex, const Row& ey, double limit) {
  constexpr int lanes = kWidth<R>, wedges = lanes / 2;
  const int n = star_.count;
  const JetOf<R> here = everywhere<R>(size_at_);
  for (int k = 0; k < spoke_count_; k += lanes)
    next_.store_lanes(k, edge_term<R>(look_up(k), weights_.rough, same<R>(x[0]), same<R>(x[1]), load<R>(&ex[k]),
                                      load<R>(&ey[k]), here, spokes_.jet.lanes<R>(k)));
  for (int to = spoke_count_; to < padded(); ++to) next_.copy(again(to), to);
  double sum = 0.0;
  for (int k = 0; k < n; k += lanes) {
    const R e1x = load<R>(&ex[k]), e1y = load<R>(&ey[k]), e2x = load<R>(&ex[k + 1]), e2y = load<R>(&ey[k + 1]);
    const R near =
        corner_energy<R>(e1x * e2y - e1y * e2x, e1x, e1y, next_.lanes<R>(k), e2x, e2y, next_.lanes<R>(k + 1), weights_);
    for (int j = k; j < k + lanes && j < n; j += wedges) {
      const R fx = load<R>(&wedges_.fx[2 * j]), fy = load<R>(&wedges_.fy[2 * j]), sx = ends<R>(&ex[j]), sy = ends<R>(&ey[j]);
      const R far =
          corner_energy<R>(fy * sx - fx * sy, sx, sy, next_.ends_from<R>(j), fx, fy, wedges_.far.lanes<R>(2 * j), weights_);
      for (int i = 0; i < wedges && j + i < n; ++i)
        sum += wedges_.energy[j + i] = near[j - k + i] + (far[2 * i] + far[2 * i + 1]);
    }
    if (weights_.delta == 0.0 && !(sum < limit)) return sum;  // with delta what comes may be negative
  }
  if (shaped())
    for (int j = 0; j < n; ++j) {
      const double out = length(x, size_at_, {wedges_.ox[j], wedges_.oy[j]}, wedges_.jet[j]);
      const double E = shape_energy(next_.l[j], next_.l[j + 1], wedges_.across[j], weights_) +
                       shape_energy(wedges_.far.l[2 * j], next_.l[j], out, weights_) +
                       shape_energy(next_.l[j + 1], wedges_.far.l[2 * j + 1], out, weights_);
      wedges_.energy[j] += E;
      sum += E;
    }
  return sum;
}

bool QuadRelocator::derivatives(VertexId v, Derivatives& sum) {
  if (!collect(v)) return false;
  leaf_at_ = leaf_[v];
  std::fill_n(spokes_.hints.begin(), 2 * spoke_count_, leaf_at_);
  const Point<2> x = mesh_.points[v];
  sum = {};
#if defined(PILLOWMESH_WIDE)
  if (kWide)
    wide_add_corners(v, x, sum);
  else
#endif
    add_corners<Pair>(v, x, sum);
  if (shaped()) add_shapes(x, size_[v], sum);
  return true;
}

template <class R>
void QuadRelocator::add_corners(VertexId v, const Point<2>& x, Derivatives& sum) {
  constexpr int lanes = kWidth<R>, wedges = lanes / 2;
  const JetOf<R> here = everywhere<R>(size_[v]);
  Row ex, ey;
  for (int k = 0; k < padded(); ++k) ex[k] = spokes_.qx[k] - x[0], ey[k] = spokes_.qy[k] - x[1];
  std::array<Row, 6> slopes;
  for (int k = 0; k < spoke_count_; k += lanes) {
    const EdgeSlopeOf<R> d = edge_slope<R>(look_up(k), weights_, same<R>(x[0]), same<R>(x[1]), load<R>(&ex[k]),
                                           load<R>(&ey[k]), now_.lanes<R>(k), here, spokes_.jet.lanes<R>(k));
    store(&slopes[0][k], d.lx), store(&slopes[1][k], d.ly), store(&slopes[2][k], d.sx), store(&slopes[3][k], d.sy);
    store(&slopes[4][k], d.frozen), store(&slopes[5][k], d.turn);
  }
  for (int to = spoke_count_; to < padded(); ++to)
    for (Row& row : slopes) row[to] = row[again(to)];
  const auto slope = [&](int k) PILLOWMESH_LANES_LAMBDA {
    return EdgeSlopeOf<R>{load<R>(&slopes[0][k]), load<R>(&slopes[1][k]), load<R>(&slopes[2][k]),
                          load<R>(&slopes[3][k]), load<R>(&slopes[4][k]), load<R>(&slopes[5][k])};
  };
  const auto slope_of_ends = [&](int k) PILLOWMESH_LANES_LAMBDA {
    return EdgeSlopeOf<R>{ends<R>(&slopes[0][k]), ends<R>(&slopes[1][k]), ends<R>(&slopes[2][k]),
                          ends<R>(&slopes[3][k]), ends<R>(&slopes[4][k]), ends<R>(&slopes[5][k])};
  };

  const int n = star_.count;
  for (int k = 0; k < n; k += lanes) {
    const R e1x = load<R>(&ex[k]), e1y = load<R>(&ey[k]), e2x = load<R>(&ex[k + 1]), e2y = load<R>(&ey[k + 1]);
    QuadDerivativesOf<R> near;
    // cross(q1 - x, q2 - x): its gradient is the edge from q2 to q1 turned.
    add_corner<2, R>(e1x * e2y - e1y * e2x, e1y - e2y, e2x - e1x, e1x, e1y, now_.lanes<R>(k), slope(k), e2x, e2y,
                     now_.lanes<R>(k + 1), slope(k + 1), weights_, near);
    sum.add(near, n - k < lanes ? n - k : lanes);
  }
  // Sums of wedges with an even number, and with an odd one, whether they are computed together or not.
  std::array<QuadDerivativesOf<R>, 2 / wedges> far;
  for (int j = 0; j < n; j += wedges) {
    const R fx = load<R>(&wedges_.fx[2 * j]), fy = load<R>(&wedges_.fy[2 * j]), sx = ends<R>(&ex[j]), sy = ends<R>(&ey[j]);
    // cross(f, x - q) where the spoke is the second edge; where it is the first f points the other way.
    const bool alone = (n & 1) != 0 && j + 1 == n;
    QuadDerivativesOf<R> last;
    add_corner<1, R>(fy * sx - fx * sy, -fy, fx, sx, sy, now_.ends_from<R>(j), slope_of_ends(j), fx, fy,
                     wedges_.far.lanes<R>(2 * j), slope_of_ends(j), weights_, alone ? last : far[j % (2 / wedges)]);
    if (alone) sum.add(last, 2);
  }
  for (const auto& part : far) sum.add(part, lanes);
}

#if defined(PILLOWMESH_WIDE)
PILLOWMESH_WIDE double QuadRelocator::wide_sum_of_corners(const Point<2>& x, const Row& ex, const Row& ey, double limit) {
  return sum_of_corners<Four>(x, ex, ey, limit);
}
PILLOWMESH_WIDE void QuadRelocator::wide_add_corners(VertexId v, const Point<2>& x, Derivatives& sum) {
  add_corners<Four>(v, x, sum);
}
#endif

void QuadRelocator::add_shapes(const Point<2>& x, const Jet& here, Derivatives& sum) {
  const auto gradient = [&](Index* hints, const Point<2>& e, const EdgeTerm& term, const Jet& there) {
    const EdgeSlope d = edge_slope(EdgeLookup{background_, hints, 1}, weights_, x[0], x[1], e[0], e[1], term, here, there);
    return Point<2>(term.l * d.lx, term.l * d.ly);
  };
  const auto spoke = [&](int k) {
    return gradient(&spokes_.hints[2 * again(k)], {spokes_.qx[k] - x[0], spokes_.qy[k] - x[1]}, now_.get(k), spokes_.jet.get(k));
  };
  for (int k = 0; k < star_.count; ++k) {
    const Point<2> o(wedges_.ox[k] - x[0], wedges_.oy[k] - x[1]);
    EdgeHints<1> hints(leaf_at_);
    const EdgeTerm out = edge_term(EdgeLookup{background_, hints.data(), 1}, weights_.rough, x[0], x[1], o[0], o[1], here, wedges_.jet[k]);
    const Point<2> da = spoke(k), db = spoke(k + 1), dout = gradient(hints.data(), o, out, wedges_.jet[k]);
    const double a = now_.l[k], b = now_.l[k + 1];
    add_shape(a, &da, b, &db, wedges_.across[k], nullptr, weights_, sum);
    add_shape(wedges_.far.l[2 * k], nullptr, a, &da, out.l, &dout, weights_, sum);
    add_shape(b, &db, wedges_.far.l[2 * k + 1], nullptr, out.l, &dout, weights_, sum);
  }
}

Point<2> curve_direction(const Mesh<2>& mesh, VertexId v) {
  return tangents(mesh, v)[0].normalized();
}

/// Puts the vertex where it was tried last.
void QuadRelocator::keep(VertexId v, const Point<2>& x) {
  if (journal != nullptr) journal->touch(v);
  touch_vertex(v);
  size_[v] = size_at_;
  leaf_[v] = leaf_at_;
  mesh_.points[v] = x;
  for (int k = 0; k < star_.count; ++k) {
    const CellId c = star_.cell[k];
    const int i = star_.place[k];
    touch_cell(c);
    edges_[c][i] = next_.get(k);
    edges_[c][(i + 3) & 3] = next_.get(k + 1);
    const EdgeTerm far1 = wedges_.far.get(2 * k), far2 = wedges_.far.get(2 * k + 1);
    const Point<2> o(wedges_.ox[k], wedges_.oy[k]);
    energy_[c] = wedges_.energy[k] + corner_energy(Point<2>(spokes_.qx[k + 1] - o[0], spokes_.qy[k + 1] - o[1]), far2,
                                                   Point<2>(spokes_.qx[k] - o[0], spokes_.qy[k] - o[1]), far1, weights_);
    if (shaped()) energy_[c] += shape_energy(far2.l, far1.l, wedges_.across[k], weights_);
  }
}

/// Whether the mesh would lie over itself with a vertex of the boundary at x, at the vertex or at one beside it there.
bool QuadRelocator::folds_at(VertexId v, const Point<2>& x, Index anchor) {
  const Point<2> old = std::exchange(mesh_.points[v], x);
  std::swap(mesh_.anchor[v], anchor);
  const bool folded = folded_at(mesh_, v) || folded_at(mesh_, spokes_.end[0]) || folded_at(mesh_, spokes_.end[spoke_count_ - 1]);
  std::swap(mesh_.anchor[v], anchor);
  mesh_.points[v] = old;
  return folded;
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
    if (support.dim == 1 && weights_.delta == 0.0 && folds_at(v, y, anchor)) continue;
    keep(v, y);
    mesh_.anchor[v] = anchor;
    return before - after;
  }
  return 0.0;
}

}  // namespace pillowmesh
