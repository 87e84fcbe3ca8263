#include "pillowmesh/metric/number.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace pillowmesh {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// A positive number as mantissa * 2^exponent with the mantissa's top bit set. Scaling by ten rounds at 64 bits, so that
// even hundreds of steps stay below half a unit of the 53-bit result.
struct Scaled {
  std::uint64_t mantissa;
  int exponent;

  void normalise() {
    const int shift = std::countl_zero(mantissa);
    mantissa <<= shift;
    exponent -= shift;
  }
  void times_ten() {
    // m * 10 = m * 8 + m * 2 in 68 bits: bring down by 4 bits, rounding to nearest.
    const std::uint64_t low = (mantissa & 0xffffffffu) * 10;
    const std::uint64_t high = (mantissa >> 32) * 10 + (low >> 32);
    const std::uint64_t bottom = (low & 0xffffffffu) | (high << 32);
    mantissa = ((high >> 32) << 60) | (bottom >> 4);
    exponent += 4;
    if ((bottom & 8) != 0) ++mantissa;
    normalise();
  }
  void over_ten() {
    // Divide m * 2^32 by 10 in two 32-bit steps, then bring the 92 bits of the quotient back to 64.
    const std::uint64_t high = mantissa / 10;
    const std::uint64_t low = ((mantissa % 10) << 32) / 10;
    const int shift = std::countl_zero(high);
    mantissa = (high << shift) | (low >> (32 - shift));
    exponent -= shift;
    if (((low >> (31 - shift)) & 1) != 0) ++mantissa;
    if (mantissa == 0) {
      mantissa = std::uint64_t{1} << 63;
      ++exponent;
    }
  }
};

double scale_slowly(std::uint64_t digits, int power) {
  Scaled s{digits, 0};
  s.normalise();
  for (; power > 0; --power) s.times_ten();
  for (; power < 0; ++power) s.over_ten();
  return std::ldexp(static_cast<double>(s.mantissa), s.exponent);
}

/// read_number that also tells whether the value is known to be correctly rounded.
std::size_t read(std::string_view text, double& value, bool& exact) {
  std::size_t i = 0;
  std::uint64_t digits = 0;
  int power = 0;
  bool any = false;
  bool after_point = false;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.' && !after_point) {
      after_point = true;
    } else if (is_digit(c)) {
      any = true;
      if (digits < 1'000'000'000'000'000'000u) {
        digits = digits * 10 + static_cast<std::uint64_t>(c - '0');
        power -= after_point ? 1 : 0;
      } else {
        power += after_point ? 0 : 1;
      }
    } else {
      break;
    }
  }
  if (!any) return 0;

  if (i + 1 < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t j = i + 1;
    const bool negative = text[j] == '-';
    if (text[j] == '-' || text[j] == '+') ++j;
    if (j < text.size() && is_digit(text[j])) {
      int exponent = 0;
      for (; j < text.size() && is_digit(text[j]); ++j) exponent = std::min(exponent * 10 + (text[j] - '0'), 100000);
      power += negative ? -exponent : exponent;
      i = j;
    }
  }

  // Exact operands and one rounding: the correctly rounded result.
  constexpr double kTens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                              1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr std::uint64_t kExact = std::uint64_t{1} << 53;
  exact = digits <= kExact && power >= -22 && power <= 22;
  if (digits == 0 || power < -400) {
    value = 0.0;
  } else if (power > 400) {
    value = HUGE_VAL;
  } else if (exact && power >= 0) {
    value = static_cast<double>(digits) * kTens[power];
  } else if (exact) {
    value = static_cast<double>(digits) / kTens[-power];
  } else {
    value = scale_slowly(digits, power);
  }
  return i;
}

}  // namespace

std::size_t read_number(std::string_view text, double& value) {
  bool exact = false;
  return read(text, value, exact);
}

std::string write_number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  for (int digits = 15; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    for (char& c : text) {
      if (c == ',') c = '.';  // a locale's decimal comma
      if (c == '\0') break;
    }
    double back = 0.0;
    bool exact = false;
    read(text[0] == '-' ? text + 1 : text, back, exact);
    if (exact && back == std::fabs(value)) break;
  }
  return text;
}

}  // namespace pillowmesh
