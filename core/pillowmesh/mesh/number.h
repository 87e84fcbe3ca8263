// Numbers and their decimal text: correctly rounded, independent of the locale, the same bits on every platform.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pillowmesh {

// Not std::from_chars and std::to_chars, which libc++ 14 lacks for double; not strtod and printf, which obey the locale
// and cost the WebAssembly module 10 kB for long doubles that nobody uses.

/// Room that format_double and format_integer need at the most.
inline constexpr int kNumberLength = 32;

/// Reads an unsigned decimal number (`12`, `.5`, `1.5e-3`) at the start of `text`.
/// \return the characters read, 0 if no number starts here.
std::size_t read_number(std::string_view text, double& value);

/// Reads all of `text` as a decimal number: optional sign, digits, point, exponent (e, or Fortran's d); `nan` and
/// `inf` are read too, so that the caller can say that they are not coordinates.
/// \return false when any of `text` is left over.
bool parse_double(std::string_view text, double& value);

/// Reads all of `text` as a decimal integer. \return false when malformed or beyond 64 bits.
bool parse_integer(std::string_view text, std::int64_t& value);

/// Writes the first of 15, 16, 17 significant digits that reads back as the same double, without trailing zeros.
/// \pre `out` has kNumberLength bytes. \return the number of characters written; no terminator.
int format_double(double value, char* out);

/// \return the number of characters written; no terminator.
int format_integer(std::int64_t value, char* out);

/// The text of format_double.
std::string number_text(double value);

/// `value` rounded to `digits` significant digits, for people to read. \pre 1 <= digits <= 15
std::string rounded_text(double value, int digits);

}  // namespace pillowmesh
