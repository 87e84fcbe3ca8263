#include "pillowmesh/smooth/quad_descent.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "pillowmesh/mesh/overlap.h"
#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {

/// \return false where there is no way down.
bool QuadDescent::find_direction() {
  const std::size_t n = mesh_.points.size();
  const bool first = direction_.size() != n;
  if (first) {
    direction_.assign(n, Point<2>::Zero());
    residual_.assign(n, Point<2>::Zero());
  }
  // r: the gradient downhill; z: r preconditioned, in start_ for the time being.
  start_.assign(n, Point<2>::Zero());
  double product = 0.0, change = 0.0;
  QuadRelocator::Derivatives d;
  const auto add = [&](VertexId v) {
    const VertexSupport& support = mesh_.support[v];
    if (support.dim == 0 || !relocator_.derivatives(v, d)) return;
    Point<2> r = -d.gradient, z;
    if (support.dim == 2) {
      z = d.step();
    } else {
      const Point<2> t = curve_direction(mesh_, v);
      z = d.step_along(t);
      r = t.dot(r) * t;
    }
    product += z.dot(r);
    change += z.dot(r - residual_[v]);
    residual_[v] = r;
    start_[v] = z;
  };
  seen_.assign(n, 0);
  for (CellId c = 0; c < mesh_.cell_count(); ++c) {
    if (!mesh_.alive(c)) continue;
    for (const VertexId v : mesh_.cells[c])
      if (std::exchange(seen_[v], 1) == 0) add(v);
  }
  if (!(product > 0)) return false;
  double beta = first || !(last_product_ > 0) ? 0.0 : std::max(0.0, change / last_product_);
  for (int attempt = 0; attempt < 2; ++attempt) {
    slope_ = 0.0;
    for (std::size_t v = 0; v < n; ++v) {
      direction_[v] = start_[v] + beta * direction_[v];
      slope_ -= direction_[v].dot(residual_[v]);
    }
    if (slope_ < 0) break;
    beta = 0.0;  // uphill: begin anew
  }
  last_product_ = product;
  return slope_ < 0;
}

double QuadDescent::energy_at(double step) {
  for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
    if (mesh_.vertex_cell[v] == kNone || mesh_.support[v].dim == 0) continue;
    mesh_.points[v] = start_[v] + step * direction_[v];
    if (mesh_.support[v].dim != 1) continue;
    mesh_.anchor[v] = start_anchor_[v];
    mesh_.points[v] = slide(*mesh_.geometry, mesh_.support[v], mesh_.anchor[v], mesh_.points[v]);
  }
  relocator_.measure_all(relocator_.weights());
  return folded() ? std::numeric_limits<double>::infinity() : relocator_.total_energy();
}

/// Whether the mesh lies over itself at the boundary: inside it cannot, as long as no corner is inverted.
bool QuadDescent::folded() const {
  for (VertexId v = 0; v < mesh_.vertex_count(); ++v)
    if (mesh_.vertex_cell[v] != kNone && mesh_.support[v].dim < 2 && folded_at(mesh_, v)) return true;
  return false;
}

double QuadDescent::iterate() {
  const double before = relocator_.total_energy();
  if (!find_direction()) return 0.0;
  start_ = mesh_.points;
  start_anchor_ = mesh_.anchor;
  double step = last_step_, energy = energy_at(step);
  for (int i = 0; i < 6 && !(energy < before); ++i) energy = energy_at(step *= 0.3);
  if (energy < before) {
    // The minimum of the parabola through what is known.
    const double best = std::clamp(-0.5 * slope_ * step * step / (energy - before - slope_ * step), 0.1 * step, 3.0 * step);
    if (std::abs(best - step) > 0.1 * step) {
      const double there = energy_at(best);
      if (there < energy) {
        energy = there;
        step = best;
      } else {
        energy = energy_at(step);
      }
    }
    last_step_ = step;
    return before - energy;
  }
  energy_at(0.0);
  mesh_.points = start_;
  mesh_.anchor = start_anchor_;
  relocator_.measure_all(relocator_.weights());
  restart();
  return 0.0;
}

}  // namespace pillowmesh
