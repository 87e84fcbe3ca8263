#include "pillowmesh/smooth/quad_star.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pillowmesh {

QuadStar::QuadStar(const Mesh<2>& mesh, const MetricField<2>& field) : mesh_(mesh), field_(field) {
  metric_.resize(mesh.points.size());
  std::array<SymTensor<2>, 256> batch;
  for (std::size_t i = 0; i < mesh.points.size(); i += batch.size()) {
    const std::size_t n = std::min(batch.size(), mesh.points.size() - i);
    field_.evaluate(std::span(mesh.points).subspan(i, n), batch);
    for (std::size_t k = 0; k < n; ++k) metric_[i + k] = corner_metric(batch[k]);
  }
}

int QuadStar::spoke_to(VertexId w) {
  for (std::size_t i = 0; i < spokes_.size(); ++i)
    if (spokes_[i].end == w) return static_cast<int>(i);
  spokes_.push_back({w, 0, 0, 0, 0, false});
  return static_cast<int>(spokes_.size()) - 1;
}

void QuadStar::visit(VertexId v) {
  vertex_ = v;
  vertex_star(mesh_, v, star_);
  corners_.clear();
  far_corners_.clear();
  spokes_.clear();
  for (const auto& [c, corner] : star_) {
    Corner here;
    here.sign = static_cast<std::int8_t>(Cell<2>::corner_sign(corner));
    for (int d = 0; d < 2; ++d) {
      const int k = corner ^ (1 << d);
      here.spoke[d] = static_cast<std::int8_t>(spoke_to(mesh_.cells[c][k]));
      FarCorner& far = far_corners_.emplace_back();
      far.origin = mesh_.cells[c][k];
      far.sign = static_cast<std::int8_t>(Cell<2>::corner_sign(k));
      far.end = static_cast<std::int8_t>(d);
      far.spoke = here.spoke[d];
      for (int j = 0; j < 2; ++j) far.ends[j] = mesh_.cells[c][k ^ (1 << j)];
    }
    corners_.push_back(here);
  }
  hold_far_corners();
}

/// The edges of the far corners that do not move, scaled to their integrated lengths.
void QuadStar::hold_far_corners() {
  sample_points_.clear();
  for (const FarCorner& far : far_corners_)
    sample_points_.push_back(0.5 * (mesh_.points[far.origin] + mesh_.points[far.ends[1 - far.end]]));
  samples_.resize(sample_points_.size());
  field_.evaluate(sample_points_, samples_);
  std::size_t sample = 0;
  Frame<2> e;
  for (FarCorner& far : far_corners_) {
    const CornerMetric<2>& metric = metric_[far.origin];
    for (int d = 0; d < 2; ++d) {
      e[d] = mesh_.points[far.ends[d]] - mesh_.points[far.origin];
      if (d == far.end) continue;
      const double a = std::sqrt(dot(metric.M, e[d], e[d])), b = std::sqrt(dot(metric_[far.ends[d]].M, e[d], e[d]));
      const double middle = std::sqrt(dot(samples_[sample++], e[d], e[d]));
      const double length = 0.5 * (mean_length(a, middle) + mean_length(middle, b));
      e[d] *= length / a;
    }
    far.held = hold_corner(e, far.sign, metric, far.end);
  }
}

/// The metric there and on the edges, whose integrated lengths go to spokes_. One point in the middle of an edge, and
/// two more where the size varies a lot along it: the energy must agree with its gradient.
void QuadStar::look_at(const Point<2>& position) {
  constexpr double varies = 1.25;
  sample_points_.clear();
  sample_points_.push_back(position);
  for (const Spoke& s : spokes_) sample_points_.push_back(0.5 * (position + mesh_.points[s.end]));
  samples_.resize(sample_points_.size());
  field_.evaluate(sample_points_, samples_);
  position_ = position;
  here_ = corner_metric(samples_[0]);
  sample_points_.clear();
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    Spoke& s = spokes_[i];
    const Point<2> e = mesh_.points[s.end] - position;
    s.here = std::sqrt(dot(here_.M, e, e));
    s.middle = std::sqrt(dot(samples_[i + 1], e, e));
    s.there = std::sqrt(dot(metric_[s.end].M, e, e));
    s.length = 0.5 * (mean_length(s.here, s.middle) + mean_length(s.middle, s.there));
    const double low = std::min(s.middle, std::min(s.here, s.there)),
                 high = std::max(s.middle, std::max(s.here, s.there));
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
    const Point<2> e = mesh_.points[s.end] - position;
    const double near = std::sqrt(dot(samples_[sample], e, e)), far = std::sqrt(dot(samples_[sample + 1], e, e));
    sample += 2;
    s.length = 0.25 * (mean_length(s.here, near) + mean_length(near, s.middle) + mean_length(s.middle, far) +
                       mean_length(far, s.there));
  }
}

double QuadStar::energy() const {
  double sum = 0.0;
  for (const FarCorner& far : far_corners_) {
    const Spoke& s = spokes_[far.spoke];
    sum += held_energy(far.held, Point<2>((s.length / s.there) * (position_ - mesh_.points[s.end])));
  }
  Frame<2> e;
  for (const Corner& corner : corners_) {
    for (int d = 0; d < 2; ++d) {
      const Spoke& s = spokes_[corner.spoke[d]];
      e[d] = (s.length / s.here) * (mesh_.points[s.end] - position_);
    }
    sum += corner_energy(e, corner.sign, here_);
  }
  return sum;
}

/// Exact for lengths and angles with the metric held fixed, except that the gradient of a length is that of its
/// integral: by the first variation it depends on the metric at the moving end alone, d l / d x = -M e / |e|_M.
Derivatives<2> QuadStar::derivatives() const {
  Derivatives<2> sum;
  const auto length_gradient = [&](const Spoke& s, const SymTensor<2>& M, double length) {
    const Point<2> out = mesh_.points[s.end] - position_;
    const Point<2> integrated = -1.0 / s.here * multiply(here_.M, out);
    const Point<2> frozen = -s.length / (length * length) * multiply(M, out);
    return Point<2>(integrated - frozen);
  };
  for (const FarCorner& far : far_corners_) {
    const Spoke& s = spokes_[far.spoke];
    const double ratio = s.length / s.there;
    add_held_derivatives(far.held, Point<2>(ratio * (position_ - mesh_.points[s.end])), ratio,
                         length_gradient(s, far.held.M, s.there), sum);
  }
  Frame<2> e;
  EdgeSlopes<2> slopes;
  for (const Corner& corner : corners_) {
    for (int d = 0; d < 2; ++d) {
      const Spoke& s = spokes_[corner.spoke[d]];
      slopes.slope[d] = -s.length / s.here;
      slopes.length_gradient[d] = length_gradient(s, here_.M, s.here);
      e[d] = (s.length / s.here) * (mesh_.points[s.end] - position_);
    }
    add_corner_derivatives(e, corner.sign, here_, slopes, sum);
  }
  return sum;
}

double QuadStar::shortest2() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Spoke& s : spokes_) least = std::min(least, (mesh_.points[s.end] - position_).squaredNorm());
  return least;
}

}  // namespace pillowmesh
