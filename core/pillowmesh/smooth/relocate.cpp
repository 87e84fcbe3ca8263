#include "pillowmesh/smooth/relocate.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {
namespace {

/// Solves H x = -g for a symmetric H made positive definite by adding to its diagonal.
template <int N>
Eigen::Matrix<double, N, 1> descend(Eigen::Matrix<double, N, N> H, const Eigen::Matrix<double, N, 1>& g) {
  double scale = 0.0;
  for (int i = 0; i < N; ++i) scale = std::max(scale, std::abs(H(i, i)));
  double shift = 0.0;
  for (int attempt = 0; attempt < 12; ++attempt) {
    // LDL' by hand: the sizes are 1 to 3.
    Eigen::Matrix<double, N, N> L = Eigen::Matrix<double, N, N>::Identity();
    Eigen::Matrix<double, N, 1> D, x;
    bool positive = true;
    for (int j = 0; j < N && positive; ++j) {
      D[j] = H(j, j) + shift;
      for (int k = 0; k < j; ++k) D[j] -= L(j, k) * L(j, k) * D[k];
      positive = D[j] > 1e-8 * scale;
      for (int i = j + 1; i < N && positive; ++i) {
        L(i, j) = H(i, j);
        for (int k = 0; k < j; ++k) L(i, j) -= L(i, k) * L(j, k) * D[k];
        L(i, j) /= D[j];
      }
    }
    if (positive) {
      for (int i = 0; i < N; ++i) {
        x[i] = -g[i];
        for (int k = 0; k < i; ++k) x[i] -= L(i, k) * x[k];
      }
      for (int i = N - 1; i >= 0; --i) {
        x[i] /= D[i];
        for (int k = i + 1; k < N; ++k) x[i] -= L(k, i) * x[k];
      }
      return x;
    }
    shift = shift == 0.0 ? 1e-2 * scale : 4.0 * shift;
  }
  return -g / (scale > 0 ? scale : 1.0);
}

/// Directions in which a vertex may move: columns, `count` of them.
template <int Dim>
struct Tangent {
  std::array<Point<Dim>, Dim> direction;
  int count;
};

template <int Dim>
Tangent<Dim> tangent_at(const Mesh<Dim>& mesh, VertexId v) {
  Tangent<Dim> t{};
  const VertexSupport s = mesh.support[v];
  const auto& g = *mesh.geometry;
  if (s.dim == Dim) {
    for (int d = 0; d < Dim; ++d) t.direction[d] = Point<Dim>::Unit(d);
    t.count = Dim;
    return t;
  }
  t.count = s.dim;
  if (s.dim == 1) {
    Point<Dim> e;
    if constexpr (Dim == 2)
      e = g.points[g.facets[mesh.anchor[v]][1]] - g.points[g.facets[mesh.anchor[v]][0]];
    else
      e = g.points[g.segments[mesh.anchor[v]][1]] - g.points[g.segments[mesh.anchor[v]][0]];
    t.direction[0] = e / std::sqrt(e.squaredNorm());
  }
  if constexpr (Dim == 3)
    if (s.dim == 2) {
      const auto& f = g.facets[mesh.anchor[v]];
      const Point<3> a = g.points[f[3]] - g.points[f[0]], b = g.points[f[2]] - g.points[f[1]];
      const Point<3> u = a / std::sqrt(a.squaredNorm());
      Point<3> w = b - u.dot(b) * u;
      t.direction[0] = u;
      t.direction[1] = w / std::sqrt(w.squaredNorm());
    }
  return t;
}

template <int N, int Dim>
Point<Dim> step_along(const Tangent<Dim>& t, const Derivatives<Dim>& d) {
  Eigen::Matrix<double, N, N> H;
  Eigen::Matrix<double, N, 1> g;
  for (int i = 0; i < N; ++i) {
    g[i] = t.direction[i].dot(d.gradient);
    const Point<Dim> Hd = d.hessian * t.direction[i];
    for (int j = 0; j < N; ++j) H(j, i) = t.direction[j].dot(Hd);
  }
  const auto x = descend<N>(H, g);
  Point<Dim> step = Point<Dim>::Zero();
  for (int i = 0; i < N; ++i) step += x[i] * t.direction[i];
  return step;
}

template <int Dim>
double target_length(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  if constexpr (Dim == 2) {
    return 0.955;
  } else {
    const auto edges = unique_edges(mesh);
    double sum = 0.0;
    for (const auto& [a, b] : edges) {
      const Point<Dim> e = mesh.points[b] - mesh.points[a];
      sum += std::sqrt(dot(field.evaluate(Point<Dim>(0.5 * (mesh.points[a] + mesh.points[b]))), e, e));
    }
    return std::min(std::sqrt(sum / static_cast<double>(edges.size())), 1.0);
  }
}

}  // namespace

template <int Dim>
Relocator<Dim>::Relocator(Mesh<Dim>& mesh, const MetricField<Dim>& field, RelocateOptions options)
    : mesh_(mesh), field_(field.scaled(options.target_length > 0 ? options.target_length : target_length(mesh, field))), options_(options) {
  metric_.resize(mesh.points.size());
  active_.assign(mesh.points.size(), 0);
  std::array<SymTensor<Dim>, 256> batch;
  for (std::size_t i = 0; i < mesh.points.size(); i += batch.size()) {
    const std::size_t n = std::min(batch.size(), mesh.points.size() - i);
    field_.evaluate(std::span(mesh.points).subspan(i, n), batch);
    for (std::size_t k = 0; k < n; ++k) metric_[i + k] = corner_metric(batch[k]);
  }
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    active_[v] = mesh.vertex_cell[v] != kNone && mesh.support[v].dim > 0;
}

template <int Dim>
int Relocator<Dim>::spoke_to(VertexId w) {
  for (std::size_t i = 0; i < spokes_.size(); ++i)
    if (spokes_[i].end == w) return static_cast<int>(i);
  spokes_.push_back({w, 0, 0, 0, 0, false});
  return static_cast<int>(spokes_.size()) - 1;
}

template <int Dim>
void Relocator<Dim>::collect(VertexId v) {
  vertex_star(mesh_, v, star_);
  corners_.clear();
  far_corners_.clear();
  spokes_.clear();
  for (const auto& [c, corner] : star_) {
    Corner here;
    here.sign = static_cast<std::int8_t>(Cell<Dim>::corner_sign(corner));
    for (int d = 0; d < Dim; ++d) {
      const int k = corner ^ (1 << d);
      here.spoke[d] = static_cast<std::int8_t>(spoke_to(mesh_.cells[c][k]));
      FarCorner& far = far_corners_.emplace_back();
      far.origin = mesh_.cells[c][k];
      far.sign = static_cast<std::int8_t>(Cell<Dim>::corner_sign(k));
      far.end = static_cast<std::int8_t>(d);
      far.spoke = here.spoke[d];
      for (int j = 0; j < Dim; ++j) far.ends[j] = mesh_.cells[c][k ^ (1 << j)];
    }
    corners_.push_back(here);
  }
  hold_far_corners();
}

/// The edges of the far corners that do not move, scaled to their integrated lengths. In 3D they are six times as many as
/// those that move; there the metric at their ends must do.
template <int Dim>
void Relocator<Dim>::hold_far_corners() {
  if constexpr (Dim == 2) {
    sample_points_.clear();
    for (const FarCorner& far : far_corners_)
      sample_points_.push_back(0.5 * (mesh_.points[far.origin] + mesh_.points[far.ends[1 - far.end]]));
    samples_.resize(sample_points_.size());
    field_.evaluate(sample_points_, samples_);
  }
  std::size_t sample = 0;
  Frame<Dim> e;
  for (FarCorner& far : far_corners_) {
    const CornerMetric<Dim>& metric = metric_[far.origin];
    for (int d = 0; d < Dim; ++d) {
      e[d] = mesh_.points[far.ends[d]] - mesh_.points[far.origin];
      if (d == far.end) continue;
      const double a = std::sqrt(dot(metric.M, e[d], e[d])), b = std::sqrt(dot(metric_[far.ends[d]].M, e[d], e[d]));
      double length = mean_length(a, b);
      if constexpr (Dim == 2) {
        const double middle = std::sqrt(dot(samples_[sample++], e[d], e[d]));
        length = 0.5 * (mean_length(a, middle) + mean_length(middle, b));
      }
      e[d] *= length / a;
    }
    far.held = hold_corner(e, far.sign, metric, far.end);
  }
}

/// The metric at a candidate position and on the edges there; their integrated lengths go to spokes_. One point in the
/// middle of an edge, and two more where the size varies a lot along it: the energy must agree with its gradient.
template <int Dim>
void Relocator<Dim>::evaluate(const Point<Dim>& position, Candidate& at) {
  constexpr double varies = 1.25;
  sample_points_.clear();
  sample_points_.push_back(position);
  for (const Spoke& s : spokes_) sample_points_.push_back(0.5 * (position + mesh_.points[s.end]));
  samples_.resize(sample_points_.size());
  field_.evaluate(sample_points_, samples_);
  at.position = position;
  at.metric = corner_metric(samples_[0]);
  sample_points_.clear();
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    Spoke& s = spokes_[i];
    const Point<Dim> e = mesh_.points[s.end] - position;
    s.here = std::sqrt(dot(at.metric.M, e, e));
    s.middle = std::sqrt(dot(samples_[i + 1], e, e));
    s.there = std::sqrt(dot(metric_[s.end].M, e, e));
    s.length = 0.5 * (mean_length(s.here, s.middle) + mean_length(s.middle, s.there));
    const double low = std::min(s.middle, std::min(s.here, s.there)), high = std::max(s.middle, std::max(s.here, s.there));
    s.varies = high > varies * low;
    if (!s.varies) continue;
    sample_points_.push_back(position + 0.25 * e);
    sample_points_.push_back(position + 0.75 * e);
  }
  if (sample_points_.empty()) return;
  samples_.resize(sample_points_.size());
  field_.evaluate(sample_points_, samples_);
  std::size_t sample = 0;
  for (Spoke& s : spokes_) {
    if (!s.varies) continue;
    const Point<Dim> e = mesh_.points[s.end] - position;
    const double near = std::sqrt(dot(samples_[sample], e, e)), far = std::sqrt(dot(samples_[sample + 1], e, e));
    sample += 2;
    s.length = 0.25 * (mean_length(s.here, near) + mean_length(near, s.middle) + mean_length(s.middle, far) +
                       mean_length(far, s.there));
  }
}

template <int Dim>
double Relocator<Dim>::energy_at(const Candidate& at) const {
  double sum = 0.0;
  for (const FarCorner& far : far_corners_) {
    const Spoke& s = spokes_[far.spoke];
    sum += held_energy(far.held, Point<Dim>((s.length / s.there) * (at.position - mesh_.points[s.end])));
  }
  Frame<Dim> e;
  for (const Corner& corner : corners_) {
    for (int d = 0; d < Dim; ++d) {
      const Spoke& s = spokes_[corner.spoke[d]];
      e[d] = (s.length / s.here) * (mesh_.points[s.end] - at.position);
    }
    sum += corner_energy(e, corner.sign, at.metric);
  }
  return sum;
}

/// Exact for lengths and angles with the metric held fixed, except that the gradient of a length is that of its integral:
/// by the first variation it depends on the metric at the moving end alone, d l / d x = -M e / |e|_M.
template <int Dim>
Derivatives<Dim> Relocator<Dim>::derivatives_at(const Candidate& at) const {
  Derivatives<Dim> sum;
  const auto length_gradient = [&](const Spoke& s, const SymTensor<Dim>& M, double length) {
    const Point<Dim> out = mesh_.points[s.end] - at.position;
    const Point<Dim> integrated = -1.0 / s.here * multiply(at.metric.M, out);
    const Point<Dim> frozen = -s.length / (length * length) * multiply(M, out);
    return Point<Dim>(integrated - frozen);
  };
  for (const FarCorner& far : far_corners_) {
    const Spoke& s = spokes_[far.spoke];
    const double ratio = s.length / s.there;
    add_held_derivatives(far.held, Point<Dim>(ratio * (at.position - mesh_.points[s.end])), ratio,
                         length_gradient(s, far.held.M, s.there), sum);
  }
  Frame<Dim> e;
  EdgeSlopes<Dim> slopes;
  for (const Corner& corner : corners_) {
    for (int d = 0; d < Dim; ++d) {
      const Spoke& s = spokes_[corner.spoke[d]];
      slopes.slope[d] = -s.length / s.here;
      slopes.length_gradient[d] = length_gradient(s, at.metric.M, s.here);
      e[d] = (s.length / s.here) * (mesh_.points[s.end] - at.position);
    }
    add_corner_derivatives(e, corner.sign, at.metric, slopes, sum);
  }
  return sum;
}

/// Over the cells of star_.
template <int Dim>
double Relocator<Dim>::lowest_scaled_jacobian() const {
  double lowest = 1.0;
  for (const auto& [c, corner] : star_) lowest = std::min(lowest, min_scaled_jacobian(mesh_, c));
  return lowest;
}

template <int Dim>
bool Relocator<Dim>::newton_step(VertexId v, const Derivatives<Dim>& d, Point<Dim>& step) const {
  const Tangent<Dim> t = tangent_at(mesh_, v);
  if (t.count == 1) step = step_along<1>(t, d);
  if (t.count == 2) step = step_along<2>(t, d);
  if constexpr (Dim == 3)
    if (t.count == 3) step = step_along<3>(t, d);
  return t.count > 0 && step.squaredNorm() > 0;
}

template <int Dim>
double Relocator<Dim>::relocate(VertexId v) {
  collect(v);
  Candidate now;
  evaluate(mesh_.points[v], now);
  double shortest2 = std::numeric_limits<double>::infinity();
  for (const Spoke& s : spokes_) shortest2 = std::min(shortest2, (mesh_.points[s.end] - now.position).squaredNorm());
  const double shortest = std::sqrt(shortest2);
  const Derivatives<Dim> d = derivatives_at(now);
  last_energy_ = d.value;
  last_decrease_ = 0.0;
  Point<Dim> step;
  if (!newton_step(v, d, step)) return 0.0;
  step *= options_.relaxation;
  const double length = std::sqrt(step.squaredNorm());
  if (length > 0.8 * shortest) step *= 0.8 * shortest / length;

  const double slope = d.gradient.dot(step);
  if (!(slope < 0)) return 0.0;
  double t = 1.0;
  for (int attempt = 0; attempt < 5; ++attempt, t *= 0.45) {
    if (dot(now.metric.M, step, step) * t * t < 1e-2 * options_.rest * options_.rest) return 0.0;
    Index anchor = mesh_.anchor[v];
    Candidate next;
    evaluate(slide(*mesh_.geometry, mesh_.support[v], anchor, Point<Dim>(now.position + t * step)), next);
    const double energy = energy_at(next);
    if (!(energy <= d.value + 1e-4 * t * slope)) continue;
    const Point<Dim> move = next.position - now.position;
    mesh_.points[v] = next.position;
    if (Dim == 3 && options_.quality_guard > 0) {
      const double lowest = lowest_scaled_jacobian();
      if (lowest < options_.quality_guard) {
        mesh_.points[v] = now.position;
        if (lowest < lowest_scaled_jacobian()) continue;
        mesh_.points[v] = next.position;
      }
    }
    mesh_.anchor[v] = anchor;
    metric_[v] = next.metric;
    last_decrease_ = d.value - energy;
    return std::sqrt(dot(now.metric.M, move, move));
  }
  return 0.0;
}

template <int Dim>
SweepResult Relocator<Dim>::sweep() {
  SweepResult result;
  for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
    if (!active_[v]) continue;
    active_[v] = 0;
    const double moved = relocate(v);
    result.energy += last_energy_;
    if (moved == 0.0) continue;
    ++result.moved;
    result.decrease += last_decrease_;
    if (moved < options_.rest) continue;
    for (const auto& [c, corner] : star_)
      for (const VertexId w : mesh_.cells[c]) active_[w] = mesh_.support[w].dim > 0;
  }
  result.converged = result.moved == 0 || result.decrease <= options_.converged * result.energy;
  return result;
}

template class Relocator<2>;
template class Relocator<3>;

}  // namespace pillowmesh
