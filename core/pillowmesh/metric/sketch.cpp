#include "pillowmesh/metric/sketch.h"

#include <cmath>
#include <string>

#include "pillowmesh/mesh/portable_math.h"
#include "pillowmesh/metric/intersection.h"
#include "pillowmesh/metric/sample.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

SymTensor<2> log_metric_of(const Dab& dab) {
  Spectrum<2> s;
  const double c = portable::cos(dab.angle), n = portable::sin(dab.angle);
  s.vector = {Point<2>(c, n), Point<2>(-n, c)};
  const double across = -2.0 * portable::log(dab.size);
  s.value = {across - 2.0 * portable::log(dab.stretch), across};
  return compose(s);
}

/// 0 inside of the radius, 1 beyond twice the radius, smooth between.
double share_of_paper(double distance, double radius) {
  const double t = distance / radius - 1.0;
  return t <= 0.0 ? 0.0 : (t >= 1.0 ? 1.0 : t * t * (3.0 - 2.0 * t));
}

}  // namespace

Expected<NodalMetric<2>> sketch_metric(std::span<const Dab> dabs, double paper, const Point<2>& low,
                                       const Point<2>& high) {
  if (!(paper > 0.0) || !std::isfinite(paper))
    return Status::bad_input("the size where nothing is drawn should be a positive number");
  for (std::size_t k = 0; k < dabs.size(); ++k) {
    const Dab& d = dabs[k];
    const bool usable = std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.angle) && d.radius > 0.0 &&
                        std::isfinite(d.radius) && d.size > 1e-100 && d.size < 1e100 && d.stretch >= 1.0 &&
                        d.stretch < 1e6;
    if (!usable)
      return Status::bad_input(
          "dab " + std::to_string(k + 1) +
          " of the sketch: position and angle should be finite, radius and size positive, stretch from 1");
  }
  std::vector<SymTensor<2>> logs;
  for (const Dab& d : dabs) logs.push_back(log_metric_of(d));
  const SymTensor<2> blank = SymTensor<2>::isotropic(paper), log_blank = log_tensor(blank);
  const Evaluate<2> metric = [&](std::span<const Point<2>> points, std::span<SymTensor<2>> out) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      out[i] = blank;
      for (std::size_t k = 0; k < dabs.size(); ++k) {
        const double x = points[i][0] - dabs[k].x, y = points[i][1] - dabs[k].y;
        const double share = share_of_paper(std::sqrt(x * x + y * y), dabs[k].radius);
        if (share < 1.0) out[i] = intersect(out[i], exp_tensor((1.0 - share) * logs[k] + share * log_blank));
      }
    }
  };
  SampleOptions options;
  options.max_points = 40'000;
  for (const Dab& d : dabs) options.finest_start = std::min(options.finest_start, 0.7 * d.radius);
  return sample<2>(metric, low, high, options);
}

}  // namespace pillowmesh
