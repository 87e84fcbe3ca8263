#include "pillowmesh/quality/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pillowmesh {

Statistics statistics(std::span<const double> values) {
  Statistics s;
  if (values.empty()) return s;
  s.count = static_cast<std::int64_t>(values.size());
  const double count = static_cast<double>(s.count);
  s.min = s.max = values[0];
  double sum = 0.0;
  std::int64_t in_range = 0;
  for (const double v : values) {
    // Written so that a value that is not a number is not passed over.
    s.min = v >= s.min ? s.min : v;
    s.max = v <= s.max ? s.max : v;
    sum += v;
    in_range += v >= 1.0 / std::numbers::sqrt2 && v <= std::numbers::sqrt2 ? 1 : 0;
  }
  s.mean = sum / count;
  double squares = 0.0;
  for (const double v : values) squares += (v - s.mean) * (v - s.mean);
  s.cv = s.mean == 0.0 ? 0.0 : std::sqrt(squares / count) / s.mean;
  s.share_in_range = static_cast<double>(in_range) / count;
  return s;
}

}  // namespace pillowmesh
