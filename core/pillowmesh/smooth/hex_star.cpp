#include "pillowmesh/smooth/hex_star.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pillowmesh {
namespace {

using Vector = std::array<double, 3>;

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vector times(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline void add(Vector& a, double s, const Vector& b) {
  for (int i = 0; i < 3; ++i) a[i] += s * b[i];
}
inline Vector times(const std::array<double, 6>& m, const Vector& a) {
  return {m[0] * a[0] + m[1] * a[1] + m[3] * a[2], m[1] * a[0] + m[2] * a[1] + m[4] * a[2],
          m[3] * a[0] + m[4] * a[1] + m[5] * a[2]};
}

/// Derivatives of mean_length(a, b) by a and b.
inline std::array<double, 2> mean_length_slopes(double a, double b) {
  const double s = 1.0 / (a + b), r = (a - b) * s, i = 1.0 / (15 - 4 * r * r);
  const double half = 0.5 * (15 - 9 * r * r) * i, change = -150 * r * s * i * i;
  return {half + change * b, half - change * a};
}

}  // namespace

HexStar::VertexMetric HexStar::vertex_metric(const SymTensor<3>& M) {
  const double det = determinant(M);
  return {M, std::sqrt(det), 1.0 / det};
}

HexStar::HexStar(const Mesh<3>& mesh, const MetricField<3>& field) : mesh_(mesh), field_(field.approximated()), table_(mesh) {
  metric_.resize(mesh.points.size());
  std::array<SymTensor<3>, 256> batch;
  for (std::size_t i = 0; i < mesh.points.size(); i += batch.size()) {
    const std::size_t n = std::min(batch.size(), mesh.points.size() - i);
    field_.evaluate(std::span(mesh.points).subspan(i, n), batch);
    for (std::size_t k = 0; k < n; ++k) metric_[i + k] = vertex_metric(batch[k]);
  }
}

void HexStar::visit(VertexId v) {
  vertex_ = v;
  spoke_vertices_ = table_.spokes(v);
  facets_ = table_.facets(v);
  corners_ = table_.corners(v);
  spokes_.resize(spoke_vertices_.size());
  outer_.resize(2 * facets_.size());
  far_.resize(3 * corners_.size());
  products_.resize(facets_.size() + corners_.size());
  hold();
}

/// What does not move: the outer edges, by the metric at their ends, and the far corners without their edge to the
/// vertex.
void HexStar::hold() {
  for (std::size_t i = 0; i < outer_.size(); ++i) {
    const StarFacet& q = facets_[i / 2];
    const VertexId from = spoke_vertices_[i % 2 == 0 ? q.a : q.b];
    const Point<3>&p = mesh_.points[from], &to = mesh_.points[q.diagonal];
    const Vector e{to[0] - p[0], to[1] - p[1], to[2] - p[2]};
    const Vector m = times(metric_[from].M.m, e);
    const double a2 = dot(e, m), b2 = dot(e, times(metric_[q.diagonal].M.m, e));
    const double a = std::sqrt(a2);
    const double ratio = mean_length(a, std::sqrt(b2)) / a, square = ratio * ratio;
    outer_[i] = {times(ratio, e), times(ratio, m), square * a2, square * dot(e, e)};
  }
  FarCorner* far = far_.data();
  for (const StarCorner& corner : corners_)
    for (int j = 0; j < 3; ++j, ++far) {
      far->spoke = corner.spoke[j];
      far->outer0 = corner.outer[j][0];
      far->outer1 = corner.outer[j][1];
      const OuterEdge &e0 = outer_[far->outer0], &e1 = outer_[far->outer1];
      far->c = cross(e1.e, e0.e);
      const double g = dot(e0.e, e1.m);
      far->t = e0.length2 + e1.length2;
      far->minor = e0.length2 * e1.length2 - g * g;
    }
}

/// Spokes are measured at their ends and in the middle, and at two points more where the size varies a lot along them:
/// the energy must agree with its gradient.
void HexStar::look_at(const Point<3>& position) {
  constexpr double varies = 1.25;
  const int count = static_cast<int>(spokes_.size());
  sample_points_.clear();
  for (int k = 0; k < count; ++k) {
    const Point<3>& end = mesh_.points[spoke_vertices_[k]];
    for (int d = 0; d < 3; ++d) spokes_[k].u[d] = end[d] - position[d];
    sample_points_.push_back(0.5 * (position + end));
  }
  sample_points_.push_back(position);
  middle_.resize(sample_points_.size());
  field_.evaluate(sample_points_, middle_);
  here_ = vertex_metric(middle_[count]);
  sample_points_.clear();
  for (int k = 0; k < count; ++k) {
    Spoke& s = spokes_[k];
    s.near_m = times(here_.M.m, s.u);
    s.far_m = times(metric_[spoke_vertices_[k]].M.m, s.u);
    s.here = std::sqrt(dot(s.u, s.near_m));
    s.middle_m = times(middle_[k].m, s.u);
    s.middle = std::sqrt(dot(s.u, s.middle_m));
    s.there = std::sqrt(dot(s.u, s.far_m));
    s.length = 0.5 * (mean_length(s.here, s.middle) + mean_length(s.middle, s.there));
    const double low = std::min(s.middle, std::min(s.here, s.there)),
                 high = std::max(s.middle, std::max(s.here, s.there));
    s.varies = high > varies * low;
    if (!s.varies) continue;
    for (const double share : {0.25, 0.75})
      sample_points_.emplace_back(position[0] + share * s.u[0], position[1] + share * s.u[1],
                                  position[2] + share * s.u[2]);
  }
  if (!sample_points_.empty()) {
    samples_.resize(sample_points_.size());
    field_.evaluate(sample_points_, samples_);
  }
  const SymTensor<3>* quarter = samples_.data();
  for (Spoke& s : spokes_) {
    if (s.varies) {
      for (int side = 0; side < 2; ++side) {
        s.quarter_m[side] = times((quarter++)->m, s.u);
        s.quarter[side] = std::sqrt(dot(s.u, s.quarter_m[side]));
      }
      s.length = 0.25 * (mean_length(s.here, s.quarter[0]) + mean_length(s.quarter[0], s.middle) +
                         mean_length(s.middle, s.quarter[1]) + mean_length(s.quarter[1], s.there));
    }
    const double near = s.length / s.here, far = -s.length / s.there;
    s.near = times(near, s.u);
    s.near_m = times(near, s.near_m);
    s.far = times(far, s.u);
    s.far_m = times(far, s.far_m);
    s.near2 = dot(s.near, s.near);
    s.far2 = dot(s.far, s.far);
  }
}

double HexStar::energy() {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double sixth = 1.0 / 6.0;
  double sum = 0.0, lowest = infinite;
  for (FarCorner& f : far_) {
    const Spoke& s = spokes_[f.spoke];
    const VertexMetric& there = metric_[spoke_vertices_[f.spoke]];
    const double g = s.length * s.length;
    f.d = dot(f.c, s.far);
    f.p0 = dot(s.far, outer_[f.outer0].m);
    f.p1 = dot(s.far, outer_[f.outer1].m);
    f.N = (f.minor + g * f.t - f.p0 * f.p0 - f.p1 * f.p1) * there.inverse;
    lowest = std::min(lowest, f.d);
    sum += there.root * (sixth * ((f.t + g) * f.d + f.N / f.d) + (size_weight - 1.0) * f.d);
  }
  double* product = products_.data();
  for (const StarFacet& q : facets_) *product++ = dot(spokes_[q.a].near, spokes_[q.b].near_m);
  for (const StarCorner& corner : corners_) {
    const Spoke &a = spokes_[corner.spoke[0]], &b = spokes_[corner.spoke[1]], &c = spokes_[corner.spoke[2]];
    const double d = dot(a.near, cross(b.near, c.near));
    const double aa = a.length * a.length, bb = b.length * b.length, cc = c.length * c.length;
    const double ab = products_[corner.outer[0][0] / 2], bc = products_[corner.outer[1][0] / 2],
                 ca = products_[corner.outer[2][0] / 2];
    const double N = (aa * bb - ab * ab + bb * cc - bc * bc + cc * aa - ca * ca) * here_.inverse;
    lowest = std::min(lowest, d);
    *product++ = d;
    sum += here_.root * (sixth * ((aa + bb + cc) * d + N / d) + (size_weight - 1.0) * d);
  }
  return lowest > 0 ? sum : infinite;
}

/// For each corner E = q (T d + N / d) + w d, of which gradient and Hessian follow from those of T, N and d. What the
/// corners of a spoke or facet have in common is multiplied out once.
Derivatives<3> HexStar::derivatives() {
  Derivatives<3> out;
  out.value = energy();
  if (!(out.value < std::numeric_limits<double>::infinity())) return out;
  Vector gradient{};
  Symmetric hessian;
  for (Spoke& s : spokes_) s.sum = {};
  for (const FarCorner& f : far_) {
    Spoke& s = spokes_[f.spoke];
    const VertexMetric& there = metric_[spoke_vertices_[f.spoke]];
    const Vector &m0 = outer_[f.outer0].m, &m1 = outer_[f.outer1].m;
    const double q = there.root / 6.0, w = there.root * (size_weight - 1.0);
    const double i = 1.0 / f.d, T = f.t + s.length * s.length, qi = q * i, N = f.N;
    // grad N = 2 (t M e - p0 m0 - p1 m1) / det M
    Vector dN = times(2.0 * there.inverse * f.t, s.far_m);
    add(dN, -2.0 * there.inverse * f.p0, m0);
    add(dN, -2.0 * there.inverse * f.p1, m1);
    const Vector dT = times(2.0, s.far_m);
    Vector y;  // H = ... + y c' + c y'
    for (int k = 0; k < 3; ++k) {
      s.sum.far[k] += q * f.d * dT[k] + qi * dN[k] + (q * T - qi * i * N + w) * f.c[k];
      y[k] = q * dT[k] - qi * i * dN[k] + qi * i * i * N * f.c[k];
    }
    s.sum.metric += 2.0 * (q * f.d + qi * f.t * there.inverse);
    const double outer = -2.0 * qi * there.inverse;
    s.sum.rest.add_square(outer, m0);
    s.sum.rest.add_square(outer, m1);
    s.sum.rest.add_product(y, f.c);
  }
  const double q = here_.root / 6.0, w = here_.root * (size_weight - 1.0), inverse = here_.inverse;
  const double* volume = products_.data() + facets_.size();
  facet_sums_.assign(facets_.size(), {});
  double of_metric = 0.0;
  for (const StarCorner& corner : corners_) {
    const std::array<Spoke*, 3> s{&spokes_[corner.spoke[0]], &spokes_[corner.spoke[1]], &spokes_[corner.spoke[2]]};
    const double d = *volume++, i = 1.0 / d, qi = q * i;
    std::array<double, 3> g, b, cross_term;  // cross_term[j]: of the edges j and j + 1
    for (int j = 0; j < 3; ++j) {
      g[j] = s[j]->length * s[j]->length;
      b[j] = -s[j]->length / s[j]->here;  // the edge's slope
      cross_term[j] = products_[corner.outer[j][0] / 2];
    }
    const double T = g[0] + g[1] + g[2];
    std::array<double, 3> minor;  // without edge j
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3, l = (j + 2) % 3;
      minor[j] = (g[k] * g[l] - cross_term[k] * cross_term[k]) * inverse;
    }
    const double N = minor[0] + minor[1] + minor[2];
    Vector dd{};
    for (int j = 0; j < 3; ++j) add(dd, b[j], cross(s[(j + 1) % 3]->near, s[(j + 2) % 3]->near));
    Vector y = times(qi * i * i * N, dd);
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3, l = (j + 2) % 3;
      // grad T = sum 2 b_j m_j, grad N = sum of_N m_j
      const double of_T = 2.0 * b[j];
      const double of_N = 2.0 * inverse * ((T - g[j]) * b[j] - cross_term[j] * b[k] - cross_term[l] * b[l]);
      s[j]->sum.near += q * d * of_T + qi * of_N;
      add(y, q * of_T - qi * i * of_N, s[j]->near_m);
      s[j]->sum.length += q * ((2.0 * g[j] + T) * d + (N - 2.0 * minor[j]) * i) + w * d;
      const double change = g[k] * b[j] * b[j] + g[j] * b[k] * b[k] - 2.0 * cross_term[j] * b[j] * b[k];
      of_metric += 2.0 * (q * d * b[j] * b[j] + qi * inverse * change);
      auto& facet = facet_sums_[corner.outer[j][0] / 2];
      facet[0] += 2.0 * inverse * qi;
      // E = v (T / 6 + N / 6 v^2 + w - 1) with v^2 = det G, of which the derivative by a product is twice the minor.
      const double of_d2 = 2.0 * inverse * (cross_term[k] * cross_term[l] - g[l] * cross_term[j]);
      facet[1] += (q * (T - N * i * i) + w) * of_d2 * 0.5 * i - 2.0 * q * i * inverse * cross_term[j];
    }
    add(gradient, q * T - qi * i * N + w, dd);
    hessian.add_product(y, dd);
  }
  for (std::size_t k = 0; k < spokes_.size(); ++k) {
    const Spoke& s = spokes_[k];
    const double slope = s.length / s.there, squared = slope * slope;
    add(gradient, slope, s.sum.far);
    add(gradient, s.sum.near, s.near_m);
    hessian.add(squared * s.sum.metric, metric_[spoke_vertices_[k]].M.m);
    hessian.add(squared, s.sum.rest.m);
  }
  hessian.add(of_metric, here_.M.m);
  for (std::size_t k = 0; k < facets_.size(); ++k) {
    const Spoke &a = spokes_[facets_[k].a], &b = spokes_[facets_[k].b];
    Vector difference = times(b.length / b.here, a.near_m);
    add(difference, -a.length / a.here, b.near_m);
    hessian.add_square(-facet_sums_[k][0], difference);
  }
  add_change_of_metric(gradient);
  for (int i = 0; i < 3; ++i) {
    out.gradient[i] = gradient[i];
    for (int j = 0; j < 3; ++j) out.hessian(i, j) = hessian.m[SymTensor<3>::at(i, j)];
  }
  return out;
}

/// What the metric's change from place to place adds: through the ratio of each edge's integrated length to that in the
/// metric at its end, and through the angles at the vertex. The derivative of the metric, D, enters as D : S with one
/// symmetric matrix S, and comes from the linear function that fits the metrics in the middles of the edges best.
void HexStar::add_change_of_metric(Vector& gradient) {
  Symmetric S;
  for (std::size_t k = 0; k < facets_.size(); ++k) {
    Spoke &a = spokes_[facets_[k].a], &b = spokes_[facets_[k].b];
    const double by_product = facet_sums_[k][1], half = 0.5 * by_product * products_[k];
    S.add_product(times(0.5 * by_product, a.near), b.near);
    a.sum.angle -= half;
    b.sum.angle -= half;
  }
  std::array<double, 6> moments{};  // of the edges, in units of the metric
  for (std::size_t k = 0; k < spokes_.size(); ++k) {
    const Spoke& s = spokes_[k];
    const double by_far = dot(s.sum.far, s.far) / s.length, by_near = s.sum.length / s.length,
                 by_length = by_far + by_near;
    // The gradients above have the ratios fixed: take out their lengths' part, add that of the integrated length.
    add(gradient, by_near / s.here, s.near_m);
    add(gradient, -by_far / s.there, s.far_m);
    const auto sample = [&](double weight, double length, double moves, const Vector& m) {
      add(gradient, -by_length * weight / length, m);
      return 0.5 * moves * weight / length;
    };
    const Vector here_m = times(s.here / s.length, s.near_m), there_m = times(-s.there / s.length, s.far_m);
    double of_metric = 0.0;
    if (s.varies) {
      const auto w0 = mean_length_slopes(s.here, s.quarter[0]), w1 = mean_length_slopes(s.quarter[0], s.middle),
                 w2 = mean_length_slopes(s.middle, s.quarter[1]), w3 = mean_length_slopes(s.quarter[1], s.there);
      of_metric += sample(0.25 * w0[0], s.here, 1.0, here_m);
      of_metric += sample(0.25 * (w0[1] + w1[0]), s.quarter[0], 0.75, s.quarter_m[0]);
      of_metric += sample(0.25 * (w1[1] + w2[0]), s.middle, 0.5, s.middle_m);
      of_metric += sample(0.25 * (w2[1] + w3[0]), s.quarter[1], 0.25, s.quarter_m[1]);
      sample(0.25 * w3[1], s.there, 0.0, there_m);
    } else {
      const auto w0 = mean_length_slopes(s.here, s.middle), w1 = mean_length_slopes(s.middle, s.there);
      of_metric += sample(0.5 * w0[0], s.here, 1.0, here_m);
      of_metric += sample(0.5 * (w0[1] + w1[0]), s.middle, 0.5, s.middle_m);
      sample(0.5 * w1[1], s.there, 0.0, there_m);
    }
    S.add_square(by_length * of_metric, s.u);
    S.add_square(s.sum.angle / (s.length * s.length), s.near);
    const double weight = 1.0 / (s.here * s.here);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) moments[SymTensor<3>::at(j, i)] += weight * s.u[i] * s.u[j];
  }
  Vector sum{};
  for (std::size_t k = 0; k < spokes_.size(); ++k) {
    const Spoke& s = spokes_[k];
    std::array<double, 6> change;
    for (int i = 0; i < 6; ++i) change[i] = middle_[k].m[i] - here_.M.m[i];
    const double along = change[0] * S.m[0] + change[2] * S.m[2] + change[5] * S.m[5] +
                         2.0 * (change[1] * S.m[1] + change[3] * S.m[3] + change[4] * S.m[4]);
    add(sum, 2.0 * along / (s.here * s.here), s.u);  // the middle is half the edge away
  }
  const auto& [a, b, c, d, e, f] = moments;
  const std::array<double, 6> cofactor{c * f - e * e, d * e - b * f, a * f - d * d,
                                       b * e - c * d, b * d - a * e, a * c - b * b};
  const double determinant = a * cofactor[0] + b * cofactor[1] + d * cofactor[3];
  if (!(determinant > 0)) return;
  add(gradient, 1.0 / determinant, times(cofactor, sum));
}

bool HexStar::below(double floor) const {
  const double squared = floor * floor;
  int count = 0;
  for (const FarCorner& f : far_)
    count += f.d * f.d < squared * spokes_[f.spoke].far2 * outer_[f.outer0].euclid2 * outer_[f.outer1].euclid2;
  const double* d = products_.data() + facets_.size();
  for (const StarCorner& corner : corners_) {
    count += *d * *d <
             squared * spokes_[corner.spoke[0]].near2 * spokes_[corner.spoke[1]].near2 * spokes_[corner.spoke[2]].near2;
    ++d;
  }
  return count > 0;
}

double HexStar::lowest_scaled_jacobian() const {
  double lowest = 1.0;
  for (const FarCorner& f : far_)
    lowest =
        std::min(lowest, f.d / std::sqrt(spokes_[f.spoke].far2 * outer_[f.outer0].euclid2 * outer_[f.outer1].euclid2));
  const double* d = products_.data() + facets_.size();
  for (const StarCorner& corner : corners_) {
    double lengths2 = 1.0;
    for (const int s : corner.spoke) lengths2 *= spokes_[s].near2;
    lowest = std::min(lowest, *d++ / std::sqrt(lengths2));
  }
  return lowest;
}

double HexStar::shortest2() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Spoke& s : spokes_) least = std::min(least, dot(s.u, s.u));
  return least;
}

}  // namespace pillowmesh
