// Further versions of functions for registers of 256 and of 512 bits, chosen as the program runs.
#pragma once

/// Compiled for the registers of whoever calls them.
#if defined(__GNUC__) || defined(__clang__)
#define PILLOWMESH_LANES inline __attribute__((always_inline))
#define PILLOWMESH_LANES_LAMBDA __attribute__((always_inline))
#else
#define PILLOWMESH_LANES inline
#define PILLOWMESH_LANES_LAMBDA
#endif

/// A further version, where there can be one. Without fused multiplication and addition, which would round differently.
#if defined(__x86_64__) && defined(__GNUC__)
#define PILLOWMESH_WIDE __attribute__((target("avx2")))
#if defined(__clang__)
#define PILLOWMESH_WIDEST __attribute__((target("avx512f,avx512dq,avx512vl")))
#else
#define PILLOWMESH_WIDEST __attribute__((target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")))
#endif

namespace pillowmesh {
/// The machine that the program runs on has registers of 256 bits.
inline const bool kWide = __builtin_cpu_supports("avx2") != 0;
/// And of 512.
inline const bool kWidest = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                            __builtin_cpu_supports("avx512vl") != 0;
}  // namespace pillowmesh
#endif
