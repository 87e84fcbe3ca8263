// The arithmetic behind number.h: a decimal and the double nearest to it, both ways, without the C library.
#pragma once

#include <cstdint>
#include <string_view>

namespace pillowmesh {

/// digits * 10^exponent
struct Decimal {
  std::uint64_t digits = 0;
  std::int64_t exponent = 0;
};

/// The double nearest to the decimal, ties to even. A few instructions when at most 19 digits and a factor of at most
/// 10^27 are involved, as in coordinates; otherwise microseconds.
double nearest_double(Decimal decimal);

/// The same for any number of digits: `text` has digits and at most one point; its value is scaled by 10^exponent.
double nearest_double(std::string_view text, std::int64_t exponent);

/// `value` rounded to n significant digits, ties to even. \pre value is positive and finite, 1 <= n <= 17
Decimal round_to_digits(double value, int n);

}  // namespace pillowmesh
