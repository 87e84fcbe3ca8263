#include "pillowmesh/mesh/number.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "pillowmesh/mesh/decimal.h"

namespace pillowmesh {
namespace {

/// More digits than this may not fit in 64 bits.
constexpr int kExactDigits = 19;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool same_word(std::string_view text, std::string_view lower) {
  if (text.size() != lower.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((text[i] | 0x20) != lower[i]) return false;
  return true;
}

/// The characters of an exponent (`e-3`) at the start of `text`, 0 if there is none; huge ones are cut to 100000.
std::size_t read_exponent(std::string_view text, bool fortran, std::int64_t& exponent) {
  std::size_t i = 0;
  if (text.empty()) return 0;
  const char letter = static_cast<char>(text[i++] | 0x20);
  if (letter != 'e' && !(fortran && letter == 'd')) return 0;
  const bool minus = i < text.size() && text[i] == '-';
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
  const std::size_t start = i;
  for (; i < text.size() && is_digit(text[i]); ++i)
    if (exponent < 100000) exponent = exponent * 10 + (text[i] - '0');
  if (minus) exponent = -exponent;
  return i > start ? i : 0;
}

std::size_t read_unsigned(std::string_view text, bool fortran, double& value) {
  Decimal decimal;
  int kept = 0;  // significant digits in `decimal`
  bool any = false, point = false, cut = false;
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.' && !point) {
      point = true;
      continue;
    }
    if (!is_digit(c)) break;
    any = true;
    if (kept < kExactDigits) {
      decimal.digits = decimal.digits * 10 + static_cast<std::uint64_t>(c - '0');
      if (decimal.digits != 0) ++kept;
      if (point) --decimal.exponent;
    } else {
      cut = cut || c != '0';
      if (!point) ++decimal.exponent;
    }
  }
  if (!any) return 0;
  std::int64_t stated = 0;
  const std::size_t length = i + read_exponent(text.substr(i), fortran, stated);
  if (length == i) stated = 0;
  decimal.exponent += stated;
  value = cut ? nearest_double(text.substr(0, i), stated) : nearest_double(decimal);
  return length;
}

/// The sign of `value`, and its text if it is not finite. \return the end of what was written
char* write_special(double value, char* out) {
  if (std::isnan(value)) {
    std::memcpy(out, "nan", 3);
    return out + 3;
  }
  if (std::signbit(value)) *out++ = '-';
  if (std::isinf(value)) {
    std::memcpy(out, "inf", 3);
    return out + 3;
  }
  return out;
}

char* write_decimal(Decimal decimal, char* out) {
  while (decimal.digits % 10 == 0) {
    decimal.digits /= 10;
    ++decimal.exponent;
  }
  char text[kNumberLength];
  const int n = format_integer(static_cast<std::int64_t>(decimal.digits), text);
  const int exponent = static_cast<int>(decimal.exponent) + n - 1;  // of the first digit
  const auto copy = [&](int from, int count) {
    std::memcpy(out, text + from, static_cast<std::size_t>(count));
    out += count;
  };
  if (exponent < -5 || exponent > 16) {  // d.ddde-xx
    copy(0, 1);
    if (n > 1) {
      *out++ = '.';
      copy(1, n - 1);
    }
    *out++ = 'e';
    out += format_integer(exponent, out);
  } else if (exponent < 0) {  // 0.00ddd
    *out++ = '0';
    *out++ = '.';
    for (int i = -1; i > exponent; --i) *out++ = '0';
    copy(0, n);
  } else if (n <= exponent + 1) {  // ddd00
    copy(0, n);
    for (int i = n; i <= exponent; ++i) *out++ = '0';
  } else {  // d.ddd
    copy(0, exponent + 1);
    *out++ = '.';
    copy(exponent + 1, n - exponent - 1);
  }
  return out;
}

}  // namespace

std::size_t read_number(std::string_view text, double& value) { return read_unsigned(text, false, value); }

bool parse_double(std::string_view text, double& value) {
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  double magnitude = 0.0;
  if (same_word(text, "nan")) {
    magnitude = std::numeric_limits<double>::quiet_NaN();
  } else if (same_word(text, "inf") || same_word(text, "infinity")) {
    magnitude = std::numeric_limits<double>::infinity();
  } else if (text.empty() || read_unsigned(text, true, magnitude) != text.size()) {
    return false;
  }
  value = negative ? -magnitude : magnitude;
  return true;
}

bool parse_integer(std::string_view text, std::int64_t& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

int format_integer(std::int64_t value, char* out) {
  return static_cast<int>(std::to_chars(out, out + kNumberLength, value).ptr - out);
}

int format_double(double value, char* out) {
  char* end = write_special(value, out);
  const double magnitude = std::fabs(value);
  if (magnitude < 1e15 && magnitude == std::floor(magnitude))
    return static_cast<int>(end - out) + format_integer(static_cast<std::int64_t>(magnitude), end);
  if (std::isfinite(value)) {
    int n = 15;
    Decimal decimal = round_to_digits(magnitude, n);
    while (n < 17 && nearest_double(decimal) != magnitude) decimal = round_to_digits(magnitude, ++n);
    end = write_decimal(decimal, end);
  }
  return static_cast<int>(end - out);
}

std::string number_text(double value) {
  char text[kNumberLength];
  return {text, static_cast<std::size_t>(format_double(value, text))};
}

std::string rounded_text(double value, int digits) {
  char text[kNumberLength];
  char* end = write_special(value, text);
  if (value == 0.0) *end++ = '0';
  if (value != 0.0 && std::isfinite(value)) end = write_decimal(round_to_digits(std::fabs(value), digits), end);
  return {text, static_cast<std::size_t>(end - text)};
}

}  // namespace pillowmesh
