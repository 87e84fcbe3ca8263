#include "pillowmesh/io/number.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace pillowmesh {
namespace {

// GCC and Clang (also for wasm) have 128-bit integers; __extension__ keeps -Wpedantic quiet.
__extension__ using U128 = unsigned __int128;

constexpr std::int64_t kMaxMantissa = std::int64_t{1} << 53;
/// 5^27 is the largest power of five below 2^63.
constexpr int kMaxFive = 27;

template <int Base, int Count>
constexpr std::array<std::uint64_t, Count> powers() {
  std::array<std::uint64_t, Count> p{1};
  for (int i = 1; i < Count; ++i) p[i] = p[i - 1] * Base;
  return p;
}
constexpr auto kFives = powers<5, kMaxFive + 1>();
constexpr auto kTens = powers<10, 20>();

int bit_width(U128 v) {
  const auto high = static_cast<std::uint64_t>(v >> 64);
  return high != 0 ? 64 + std::bit_width(high) : std::bit_width(static_cast<std::uint64_t>(v));
}

/// v / 2^shift rounded half to even; `sticky`: something nonzero was already cut off below v.
U128 round_shift(U128 v, int shift, bool sticky) {
  if (shift <= 0) return v << -shift;
  const U128 quotient = v >> shift;
  const U128 rest = v - (quotient << shift);
  const U128 half = U128{1} << (shift - 1);
  const bool up = rest > half || (rest == half && (sticky || (quotient & 1) != 0));
  return quotient + (up ? 1 : 0);
}

/// v * 2^exponent as the nearest double. \pre the result is a normal number
double to_double(U128 v, int exponent, bool sticky) {
  const int shift = bit_width(v) - 53;
  if (shift <= 0) return std::ldexp(static_cast<double>(static_cast<std::uint64_t>(v)), exponent);
  const auto mantissa = static_cast<std::uint64_t>(round_shift(v, shift, sticky));
  return std::ldexp(static_cast<double>(mantissa), exponent + shift);
}

/// digits * 10^exponent, correctly rounded, when 128 bits suffice. \return false otherwise.
bool decimal_to_double(std::uint64_t digits, int exponent, double& value) {
  if (digits == 0) {
    value = 0.0;
    return true;
  }
  if (exponent < -kMaxFive || exponent > kMaxFive) return false;
  if (exponent >= 0) {
    value = to_double(static_cast<U128>(digits) * kFives[exponent], exponent, false);
    return true;
  }
  // Powers of ten to 10^22 are exact doubles, so one division rounds once.
  if (digits <= kMaxMantissa && exponent >= -22) {
    static constexpr double tens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    value = static_cast<double>(digits) / tens[-exponent];
    return true;
  }
  const int zeros = std::countl_zero(digits);
  const U128 numerator = static_cast<U128>(digits << zeros) << 64;
  const std::uint64_t divisor = kFives[-exponent];
  const U128 quotient = numerator / divisor;  // at least 65 bits
  value = to_double(quotient, exponent - zeros - 64, numerator % divisor != 0);
  return true;
}

/// |value| as n significant digits, rounded half to even: digits * 10^(exponent - n + 1).
void round_decimal(double value, int n, std::uint64_t& digits, int& exponent) {
  int binary = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(value, &binary), 53));
  binary -= 53;
  const std::uint64_t low = kTens[n - 1], high = low * 10;
  exponent = static_cast<int>(std::floor((binary + 52) * 0.30102999566398120));
  for (;;) {
    const int p = n - 1 - exponent;
    const int shift = -(binary + p);
    if (p < 0 || p > 32 || shift > 127 || shift < -40) break;  // beyond 128 bits
    U128 product = static_cast<U128>(mantissa) * kFives[p < kMaxFive ? p : kMaxFive];
    if (p > kMaxFive) product *= kFives[p - kMaxFive];
    digits = static_cast<std::uint64_t>(round_shift(product, shift, false));
    if (digits >= high) {
      ++exponent;
    } else if (digits < low) {
      --exponent;
    } else {
      return;
    }
  }
  // Very large or very small: the C library is exact here, and of its text only digits are used (no locale).
  char text[48];
  std::snprintf(text, sizeof text, "%.*e", n - 1, value);
  digits = 0;
  const char* c = text;
  for (; *c != 'e' && *c != '\0'; ++c)
    if (*c >= '0' && *c <= '9') digits = digits * 10 + static_cast<std::uint64_t>(*c - '0');
  exponent = *c == 'e' ? std::atoi(c + 1) : 0;
}

/// digits * 10^exponent by the C library, through a text without a decimal point: no locale changes its meaning.
double library_double(const char* digits, int length, std::int64_t exponent) {
  char text[840];
  std::memcpy(text, digits, static_cast<std::size_t>(length));
  std::snprintf(text + length, sizeof text - static_cast<std::size_t>(length), "e%lld",
                static_cast<long long>(exponent));
  return std::strtod(text, nullptr);
}

bool same_word(std::string_view text, std::string_view lower) {
  if (text.size() != lower.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((text[i] | 0x20) != lower[i]) return false;
  return true;
}

}  // namespace

bool parse_double(std::string_view text, double& value) {
  const char* c = text.data();
  const char* const end = c + text.size();
  bool negative = false;
  if (c != end && (*c == '-' || *c == '+')) negative = *c++ == '-';
  const std::string_view body(c, static_cast<std::size_t>(end - c));
  if (same_word(body, "nan")) {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  if (same_word(body, "inf") || same_word(body, "infinity")) {
    value = negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    return true;
  }
  std::uint64_t digits = 0;
  int kept = 0;  // significant digits in `digits`
  std::int64_t exponent = 0;
  bool any = false, point = false, cut = false;
  const char* const first = c;
  for (; c != end; ++c) {
    if (*c == '.' && !point) {
      point = true;
      continue;
    }
    if (*c < '0' || *c > '9') break;
    any = true;
    if (kept < 19) {
      digits = digits * 10 + static_cast<std::uint64_t>(*c - '0');
      if (digits != 0) ++kept;
      if (point) --exponent;
    } else {
      cut = cut || *c != '0';
      if (!point) ++exponent;
    }
  }
  if (!any) return false;
  const char* const last = c;
  std::int64_t stated = 0;
  if (c != end) {
    if ((*c | 0x20) != 'e' && (*c | 0x20) != 'd') return false;
    ++c;
    bool minus = false;
    if (c != end && (*c == '-' || *c == '+')) minus = *c++ == '-';
    if (c == end) return false;
    for (; c != end; ++c) {
      if (*c < '0' || *c > '9') return false;
      if (stated < 100000) stated = stated * 10 + (*c - '0');
    }
    if (minus) stated = -stated;
  }
  exponent += stated;
  if (exponent < -100000) exponent = -100000;
  if (exponent > 100000) exponent = 100000;
  double magnitude = 0.0;
  if (cut || !decimal_to_double(digits, static_cast<int>(exponent), magnitude)) {
    // Digits past the 768th cannot change the rounding except by being nonzero.
    char copy[800];
    int length = 0;
    std::int64_t scale = stated;
    bool after_point = false, more = false;
    for (const char* d = first; d != last; ++d) {
      if (*d == '.') {
        after_point = true;
      } else if (length < 780) {
        if (*d != '0' || length > 0) copy[length++] = *d;
        if (after_point) --scale;
      } else {
        more = more || *d != '0';
        if (!after_point) ++scale;
      }
    }
    if (more) {
      copy[length++] = '1';
      --scale;
    }
    magnitude = length == 0 ? 0.0 : library_double(copy, length, scale);
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
  char* o = out;
  if (std::isnan(value)) {
    std::memcpy(o, "nan", 3);
    return 3;
  }
  if (std::signbit(value)) *o++ = '-';
  const double magnitude = std::fabs(value);
  if (std::isinf(magnitude)) {
    std::memcpy(o, "inf", 3);
    return static_cast<int>(o - out) + 3;
  }
  if (magnitude < 1e15 && magnitude == std::floor(magnitude))
    return static_cast<int>(o - out) + format_integer(static_cast<std::int64_t>(magnitude), o);

  std::uint64_t digits = 0;
  int exponent = 0, n = 15;
  for (;; ++n) {
    round_decimal(magnitude, n, digits, exponent);
    if (n == 17) break;
    char text[kNumberLength];
    double back = 0.0;
    const int length = format_integer(static_cast<std::int64_t>(digits), text);
    if (!decimal_to_double(digits, exponent - n + 1, back)) back = library_double(text, length, exponent - n + 1);
    if (back == magnitude) break;
  }
  while (digits % 10 == 0) {
    digits /= 10;
    --n;
  }
  char text[kNumberLength];
  format_integer(static_cast<std::int64_t>(digits), text);
  const auto copy = [&](int from, int count) {
    std::memcpy(o, text + from, static_cast<std::size_t>(count));
    o += count;
  };
  if (exponent < -5 || exponent > 16) {  // d.ddde-xx
    copy(0, 1);
    if (n > 1) {
      *o++ = '.';
      copy(1, n - 1);
    }
    *o++ = 'e';
    o += format_integer(exponent, o);
  } else if (exponent < 0) {  // 0.00ddd
    *o++ = '0';
    *o++ = '.';
    for (int i = -1; i > exponent; --i) *o++ = '0';
    copy(0, n);
  } else if (n <= exponent + 1) {  // ddd00
    copy(0, n);
    for (int i = n; i <= exponent; ++i) *o++ = '0';
  } else {  // d.ddd
    copy(0, exponent + 1);
    *o++ = '.';
    copy(exponent + 1, n - exponent - 1);
  }
  return static_cast<int>(o - out);
}

}  // namespace pillowmesh
