// Random numbers that are the same on every machine.
#pragma once

#include <cstdint>

#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh {

/// SplitMix64 (Steele, Lea and Flood, 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Uniform in (0, 1).
  double uniform() { return (static_cast<double>(next() >> 12) + 0.5) * 0x1p-52; }
  /// Exponentially distributed with mean 1.
  double exponential() { return -portable::log(uniform()); }

 private:
  std::uint64_t state_;
};

}  // namespace pillowmesh
