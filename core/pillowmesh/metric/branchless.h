// Logarithm and hyperbolic tangent without branches and tables: loops over many numbers are vectorised, where musl's
// functions go one by one. Only + - * / and moves of bits, so that a result is the same in every build.
//
// After FreeBSD's msun: Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Permission to use, copy, modify,
// and distribute this software is freely granted, provided that this notice is preserved.
#pragma once

#include <cstdint>
#include <limits>

#if defined(__wasm__)
// Two numbers at a time are not worth the size of the loops.
#define PILLOWMESH_VECTORISED __attribute__((noinline)) inline
#else
#define PILLOWMESH_VECTORISED inline
#endif

namespace pillowmesh::branchless {

// std::bit_cast is missing from the library that WebAssembly is built with.

/// Within 1 ulp. [FreeBSD's msun, e_log.c]
PILLOWMESH_VECTORISED double log(double x) {
  constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
  constexpr std::uint64_t one = 0x3ff0000000000000, root_half = 0x3fe6a09e667f3bcd, mantissa = 0x000fffffffffffff;
  // x = 2^k (1 + f) with sqrt(1/2) <= 1 + f < sqrt(2); what is subnormal is scaled first.
  const bool tiny = x < 0x1p-1022;
  const double scaled = x * 0x1p54;
  const std::uint64_t bits = __builtin_bit_cast(std::uint64_t, tiny ? scaled : x) + (one - root_half);
  const double exponent = __builtin_bit_cast(double, (bits >> 52) | 0x4330000000000000) - (0x1p52 + 1023.0);
  const double k = tiny ? exponent - 54.0 : exponent;
  const double f = __builtin_bit_cast(double, (bits & mantissa) + root_half) - 1.0;
  const double s = f / (2.0 + f), z = s * s, w = z * z, half = 0.5 * f * f;
  const double even = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const double odd = z * (6.666666666666735130e-01 +
                          w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const double y = s * (half + (even + odd)) + k * ln2_low - half + f + k * ln2_high;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double outside = x == 0.0 ? -infinity : std::numeric_limits<double>::quiet_NaN();
  const double above = x < infinity ? y : x;
  return x > 0.0 ? above : outside;
}

/// exp(y) for 0 <= y < 700, within 1 ulp. [FreeBSD's msun, e_exp.c]
inline double exp_of_positive(double y) {
  constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
  // The nearest number of powers of two, in the last bits of a number that has no others.
  const double shifted = y * 1.44269504088896338700e+00 + 0x1.8p52, k = shifted - 0x1.8p52;
  const double high = y - k * ln2_high, low = k * ln2_low, r = high - low, t = r * r;
  const double c = r - t * (1.66666666666666019037e-01 +
                            t * (-2.77777777770155933842e-03 +
                                 t * (6.61375632143793436117e-05 + t * (-1.65339022054652515390e-06 + t * 4.13813679705723846039e-08))));
  const double scale = __builtin_bit_cast(double, (__builtin_bit_cast(std::uint64_t, shifted) + 1023) << 52);
  return (1.0 - ((low - r * c / (2.0 - c)) - high)) * scale;
}

/// Within 2 ulp. [Cephes, tanh.c, S. Moshier]
PILLOWMESH_VECTORISED double tanh(double x) {
  const double a = x < 0.0 ? -x : x, z = x * x;
  const double near = x + x * z *
                              (((-9.64399179425052238628e-1 * z - 9.92877231001918586564e1) * z - 1.61468768441708447952e3) /
                               (((z + 1.12811678491632931402e2) * z + 2.23548839060100448583e3) * z + 4.84406305325125486048e3));
  const double far = 1.0 - 2.0 / (exp_of_positive(2.0 * (a < 20.0 ? a : 20.0)) + 1.0);
  const double signed_far = x < 0.0 ? -far : far;
  const double y = a < 0.625 ? near : signed_far;
  return x == x ? y : x;
}

}  // namespace pillowmesh::branchless
