// Logarithm, hyperbolic tangent, sine and cosine without branches and tables: loops over many numbers are vectorised, where
// musl's functions go one by one. Only + - * / and moves of bits, so that a result is the same in every build.
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

/// x = n pi / 2 + y + rest, n the nearest whole number.
struct QuarterTurns {
  double y, rest;
  std::uint64_t n;  ///< its last bits
  bool whole;       ///< n is not 0
  bool doubtful;    ///< n might be another, or more digits of pi / 2 may be needed
};
/// As musl's functions do it, which sort x by size first. [FreeBSD's msun, e_rem_pio2.c]
inline QuarterTurns quarter_turns(double x) {
  constexpr double two_over_pi = 6.36619772367581382433e-01, half_pi_high = 1.57079632673412561417e+00,
                   half_pi_low = 6.07710050650619224932e-11, quarter_pi = 0x1.921fb54442d18p-1, to_whole = 0x1.8p52;
  const double shifted = x * two_over_pi + to_whole, n = shifted - to_whole;
  const double r = x - n * half_pi_high, w = n * half_pi_low, y = r - w, size = x < 0.0 ? -x : x, off = y < 0.0 ? -y : y;
  const bool whole = n != 0.0, cancelled = off < size * 0x1p-16, tie = !(off < quarter_pi - 4e-5), large = !(size < 0x1p20);
  return {y, (r - y) - w, __builtin_bit_cast(std::uint64_t, shifted), whole, ((whole & cancelled) | tie | large) != 0};
}

/// [FreeBSD's msun, k_sin.c]
inline double sine_of(const QuarterTurns& t) {
  const double x = t.y, z = x * x, w = z * z, v = z * x;
  const double r = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06) +
                   z * w * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
  constexpr double third = -1.66666666666666324348e-01;
  const double alone = x + v * (third + z * r), with_rest = x - ((z * (0.5 * t.rest - v * r) - t.rest) - v * third);
  const double y = t.whole ? with_rest : alone;
  return x == 0.0 ? x : y;
}
/// [FreeBSD's msun, k_cos.c]
inline double cosine_of(const QuarterTurns& t) {
  const double x = t.y, z = x * x, w = z * z;
  const double r = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05)) +
                   w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
  const double half = 0.5 * z, one = 1.0 - half;
  return one + (((1.0 - one) - half) + (z * r - x * t.rest));
}
/// -x where the second bit is set.
inline double signed_by(std::uint64_t bits, double x) {
  return __builtin_bit_cast(double, __builtin_bit_cast(std::uint64_t, x) ^ ((bits & 2) << 62));
}

/// Bit for bit what musl's functions give where t, the quarter turns of the argument, is not doubtful.
inline double sin(const QuarterTurns& t) {
  const double s = sine_of(t), c = cosine_of(t);
  return signed_by(t.n, (t.n & 1) != 0 ? c : s);
}
inline double cos(const QuarterTurns& t) {
  const double s = sine_of(t), c = cosine_of(t);
  return signed_by(t.n + 1, (t.n & 1) != 0 ? s : c);
}

}  // namespace pillowmesh::branchless
