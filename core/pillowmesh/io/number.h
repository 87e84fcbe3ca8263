// Decimal text to double and back: correctly rounded, independent of the locale, the same bits on every platform.
#pragma once

#include <cstdint>
#include <string_view>

namespace pillowmesh {

/// Room that format_double and format_integer need at the most.
inline constexpr int kNumberLength = 32;

/// Reads all of `text` as a decimal number: optional sign, digits, point, exponent (e, or Fortran's d); `nan` and
/// `inf` are read too, so that the caller can say that they are not coordinates.
/// \return false when any of `text` is left over.
/// Not std::from_chars, which libc++ 14 lacks for double, and not strtod on the text, which obeys the locale.
bool parse_double(std::string_view text, double& value);

/// Reads all of `text` as a decimal integer. \return false when malformed or beyond 64 bits.
bool parse_integer(std::string_view text, std::int64_t& value);

/// Writes the first of 15, 16, 17 significant digits that reads back as the same double, without trailing zeros.
/// \pre `out` has kNumberLength bytes. \return the number of characters written; no terminator.
/// Not std::to_chars, which not every libc++ has for double: the text must be the same natively and in wasm.
int format_double(double value, char* out);

/// \return the number of characters written; no terminator.
int format_integer(std::int64_t value, char* out);

}  // namespace pillowmesh
