// Second versions of functions for registers of 256 bits, chosen as the program runs.
#pragma once

/// Compiled for the registers of whoever calls them.
#if defined(__GNUC__) || defined(__clang__)
#define PILLOWMESH_LANES inline __attribute__((always_inline))
#define PILLOWMESH_LANES_LAMBDA __attribute__((always_inline))
#else
#define PILLOWMESH_LANES inline
#define PILLOWMESH_LANES_LAMBDA
#endif

/// A second version, where there can be one. Without fused multiplication and addition, which would round differently.
#if defined(__x86_64__) && defined(__GNUC__)
#define PILLOWMESH_WIDE __attribute__((target("avx2")))

namespace pillowmesh {
/// The machine that the program runs on has registers of 256 bits.
inline const bool kWide = __builtin_cpu_supports("avx2") != 0;
}  // namespace pillowmesh
#endif
