// Population statistics of an indicator.
#pragma once

#include <cstdint>
#include <span>

namespace pillowmesh {

/// `cv` is the population standard deviation divided by the mean (the paper's "sigma").
struct Statistics {
  std::int64_t count = 0;
  double min = 0.0;
  double mean = 0.0;
  double max = 0.0;
  double cv = 0.0;
  double share_in_range = 0.0;  ///< share of values in [1/sqrt 2, sqrt 2]
};

/// Two passes over the values, summed in index order: the same bits everywhere.
Statistics statistics(std::span<const double> values);

}  // namespace pillowmesh
