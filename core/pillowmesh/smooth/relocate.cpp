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
  if (s.dim == Dim) {
    for (int d = 0; d < Dim; ++d) t.direction[d] = Point<Dim>::Unit(d);
    t.count = Dim;
    return t;
  }
  t.count = s.dim;
  if (s.dim == 0) return t;
  const auto along = tangents(mesh, v);
  t.direction[0] = along[0] / std::sqrt(along[0].squaredNorm());
  if constexpr (Dim == 3)
    if (s.dim == 2) {
      const Point<3> w = along[1] - t.direction[0].dot(along[1]) * t.direction[0];
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

/// What two places too far along a step tell of the slope at its beginning. At a kink of the metric the energy rises at
/// once whichever way the derivatives, which are those of one side, point: then no place is worth a look.
class Secant {
 public:
  /// The energy changed by `rise` at t times the step, where it should have fallen at the rate `descent`. From the
  /// second place on sets `shorter` to the factor by which t leads to the least of the parabola through all. \return
  /// false when there is little to gain.
  bool add(double t, double rise, double descent, double& shorter) {
    constexpr double little = 0.1;
    if (!std::isfinite(rise)) return true;
    const double mean = rise / t;
    if (t_ > 0.0) {
      const double bend = (mean_ - mean) / (t_ - t), slope = mean - bend * t;
      if (slope >= -little * descent) return false;
      shorter = std::min(std::max(-0.5 * slope / (bend * t), 0.1), 0.6);
    }
    t_ = t;
    mean_ = mean;
    return true;
  }

 private:
  double t_ = 0.0, mean_ = 0.0;  ///< the last place, and the mean slope up to there
};

template <int Dim>
double target_length(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  if constexpr (Dim == 2) {
    return 0.955;
  } else {
    const auto edges = unique_edges(mesh);
    std::vector<Point<Dim>> middles;
    middles.reserve(edges.size());
    for (const auto& [a, b] : edges) middles.emplace_back(0.5 * (mesh.points[a] + mesh.points[b]));
    std::vector<SymTensor<Dim>> metrics(edges.size());
    field.approximated().evaluate(middles, metrics);
    double sum = 0.0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Point<Dim> e = mesh.points[edges[i][1]] - mesh.points[edges[i][0]];
      sum += std::sqrt(dot(metrics[i], e, e));
    }
    return std::min(std::sqrt(sum / static_cast<double>(edges.size())), 1.0);
  }
}

}  // namespace

template <int Dim>
Relocator<Dim>::Relocator(Mesh<Dim>& mesh, const MetricField<Dim>& field, RelocateOptions options)
    : mesh_(mesh),
      options_(options),
      star_(mesh, field.scaled(options.target_length > 0 ? options.target_length : target_length(mesh, field))) {
  active_.assign(mesh.points.size(), 0);
  stuck_.assign(mesh.points.size(), 0);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    active_[v] = mesh.vertex_cell[v] != kNone && mesh.support[v].dim > 0;
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
  const Point<Dim> from = mesh_.points[v];
  star_.visit(v);
  star_.look_at(from);
  const double shortest = std::sqrt(star_.shortest2());
  const Derivatives<Dim> d = star_.derivatives();
  const SymTensor<Dim> metric = star_.metric();
  last_energy_ = d.value;
  last_decrease_ = 0.0;
  Point<Dim> step;
  if (!newton_step(v, d, step)) return 0.0;
  step *= options_.relaxation;
  const double length = std::sqrt(step.squaredNorm());
  if (length > 0.8 * shortest) step *= 0.8 * shortest / length;

  const double slope = d.gradient.dot(step);
  if (!(slope < 0)) return 0.0;
  [[maybe_unused]] double guard = options_.quality_guard;
  if constexpr (Dim == 3)
    if (star_.below(guard)) guard = star_.lowest_scaled_jacobian();
  double t = 1.0, shorter = 0.45;
  [[maybe_unused]] Secant refused;
  for (int attempt = 0; attempt < 5; ++attempt, t *= shorter) {
    if (dot(metric, step, step) * t * t < 1e-2 * options_.rest * options_.rest) return 0.0;
    Index anchor = mesh_.anchor[v];
    const Point<Dim> to = slide(*mesh_.geometry, mesh_.support[v], anchor, Point<Dim>(from + t * step));
    star_.look_at(to);
    const double energy = star_.energy();
    // Next to where the parabola through what is known has its minimum.
    if constexpr (Dim == 3) shorter = std::min(std::max(-0.5 * t * slope / (energy - d.value - t * slope), 0.2), 0.6);
    if (!(energy <= d.value + 1e-4 * t * slope)) {
      if constexpr (Dim == 3)
        if (!refused.add(t, energy - d.value, -slope, shorter)) return 0.0;
      continue;
    }
    if constexpr (Dim == 3)
      if (star_.below(guard)) continue;
    mesh_.points[v] = to;
    mesh_.anchor[v] = anchor;
    star_.settle();
    last_decrease_ = d.value - energy;
    const Point<Dim> move = to - from;
    return std::sqrt(dot(metric, move, move));
  }
  return 0.0;
}

template <int Dim>
SweepResult Relocator<Dim>::sweep() {
  // In a metric with kinks many vertices come to lie where no step helps. To try there costs several times what a move
  // costs elsewhere: a neighbour must have moved by this many times what else is enough.
  constexpr double wakes_stuck = 30.0;
  SweepResult result;
  visited_.clear();
  for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
    if (!active_[v]) continue;
    active_[v] = 0;
    const double moved = relocate(v);
    stuck_[v] = moved == 0.0;
    visited_.push_back({last_energy_, last_decrease_});
    result.energy += last_energy_;
    if (moved == 0.0) continue;
    ++result.moved;
    result.decrease += last_decrease_;
    if (moved < options_.rest) continue;
    const bool wakes_all = Dim == 2 || moved >= wakes_stuck * options_.rest;
    star_.for_each_dependent([&](VertexId w) {
      if (mesh_.support[w].dim > 0 && (wakes_all || !stuck_[w])) active_[w] = 1;
    });
  }
  result.converged = result.moved == 0 || little_gained();
  return result;
}

/// A vertex counts with no more than some times the energy that is usual: a single huge one says nothing about the
/// others.
template <int Dim>
bool Relocator<Dim>::little_gained() {
  constexpr double unusual = 32.0;
  const auto middle = visited_.begin() + static_cast<std::ptrdiff_t>(visited_.size() / 2);
  std::nth_element(visited_.begin(), middle, visited_.end());
  const double most = unusual * (*middle)[0];
  double energy = 0.0, decrease = 0.0;
  for (const auto& [e, gained] : visited_) {
    energy += std::min(e, most);
    decrease += std::min(gained, most);
  }
  const double share = options_.converged > 0 ? options_.converged : (Dim == 2 ? 3e-6 : 3e-5);
  return decrease <= share * energy;
}

template class Relocator<2>;
template class Relocator<3>;

}  // namespace pillowmesh
