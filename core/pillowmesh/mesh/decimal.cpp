#include "pillowmesh/mesh/decimal.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace pillowmesh {
namespace {

// GCC and Clang (also for wasm) have 128-bit integers; __extension__ keeps -Wpedantic quiet.
__extension__ using U128 = unsigned __int128;

/// 5^27 is the largest power of five below 2^63.
constexpr int kMaxFive = 27;
/// Digits past the 768th cannot change the rounding except by being nonzero.
constexpr int kMostDigits = 770;

template <int Base, int Count>
constexpr std::array<std::uint64_t, Count> powers() {
  std::array<std::uint64_t, Count> p{1};
  for (int i = 1; i < Count; ++i) p[i] = p[i - 1] * Base;
  return p;
}
constexpr auto kFives = powers<5, kMaxFive + 1>();
constexpr auto kTens = powers<10, 19>();

int bit_width(U128 v) {
  const auto high = static_cast<std::uint64_t>(v >> 64);
  return static_cast<int>(high != 0 ? 64 + std::bit_width(high) : std::bit_width(static_cast<std::uint64_t>(v)));
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

/// A natural number below 2^4096: room for kMostDigits digits, and for the powers of ten that scale them to a double.
class Natural {
 public:
  explicit Natural(std::uint64_t value) {
    limbs_[0] = static_cast<std::uint32_t>(value);
    limbs_[1] = static_cast<std::uint32_t>(value >> 32);
    size_ = limbs_[1] != 0 ? 2 : limbs_[0] != 0 ? 1 : 0;
  }

  void multiply_add(std::uint32_t factor, std::uint32_t carry) {
    for (int i = 0; i < size_; ++i) {
      const std::uint64_t product = std::uint64_t{limbs_[i]} * factor + carry;
      limbs_[i] = static_cast<std::uint32_t>(product);
      carry = static_cast<std::uint32_t>(product >> 32);
    }
    if (carry != 0) limbs_[size_++] = carry;
  }
  void multiply_by_power_of_ten(int power) {
    for (; power > 0; power -= 9) multiply_add(static_cast<std::uint32_t>(kTens[power < 9 ? power : 9]), 0);
  }
  void shift_left(int bits) {
    for (; bits > 0; bits -= 31) multiply_add(1u << (bits < 31 ? bits : 31), 0);
  }
  /// \pre other <= *this
  void subtract(const Natural& other) {
    std::int64_t borrow = 0;
    for (int i = 0; i < size_; ++i) {
      borrow += std::int64_t{limbs_[i]} - (i < other.size_ ? other.limbs_[i] : 0);
      limbs_[i] = static_cast<std::uint32_t>(borrow);
      borrow >>= 32;
    }
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
  }
  /// Negative, zero or positive, as *this is less than, equal to or greater than `other`.
  [[nodiscard]] int compare(const Natural& other) const {
    if (size_ != other.size_) return size_ - other.size_;
    for (int i = size_ - 1; i >= 0; --i)
      if (limbs_[i] != other.limbs_[i]) return limbs_[i] < other.limbs_[i] ? -1 : 1;
    return 0;
  }
  [[nodiscard]] int bits() const {
    return size_ == 0 ? 0 : 32 * size_ - std::countl_zero(limbs_[size_ - 1]);
  }

 private:
  std::array<std::uint32_t, 128> limbs_{};
  int size_ = 0;
};

/// over / under as the nearest double: binary long division, which stops at the last bit that the double has.
double nearest_quotient(Natural over, Natural under) {
  int exponent = over.bits() - under.bits();
  over.shift_left(-exponent);
  under.shift_left(exponent);
  if (over.compare(under) < 0) {
    over.shift_left(1);
    --exponent;
  }
  const int bits = exponent >= -1022 ? 53 : exponent + 1075;  // fewer for a subnormal
  if (bits < 0) return 0.0;
  std::uint64_t quotient = 0;
  for (int i = 0; i < bits; ++i) {
    quotient *= 2;
    if (over.compare(under) >= 0) {
      over.subtract(under);
      ++quotient;
    }
    over.shift_left(1);
  }
  const int rest = over.compare(under);  // against half of the last bit
  if (rest > 0 || (rest == 0 && quotient % 2 != 0)) ++quotient;
  return std::ldexp(static_cast<double>(quotient), exponent - bits + 1);
}

/// digits * 10^exponent, where digits < 10^count.
double scaled(Natural digits, int count, std::int64_t exponent) {
  if (digits.bits() == 0 || count + exponent < -330) return 0.0;
  if (exponent > 310) return std::numeric_limits<double>::infinity();
  Natural under(1);
  digits.multiply_by_power_of_ten(static_cast<int>(exponent));
  under.multiply_by_power_of_ten(static_cast<int>(-exponent));
  return nearest_quotient(digits, under);
}

}  // namespace

double nearest_double(Decimal decimal) {
  const auto [digits, exponent] = decimal;
  if (digits == 0) return 0.0;
  if (exponent < -kMaxFive || exponent > kMaxFive) return scaled(Natural(digits), 20, exponent);
  const int power = static_cast<int>(exponent);
  if (power >= 0) return to_double(static_cast<U128>(digits) * kFives[power], power, false);
  // Powers of ten to 10^22 are exact doubles, so one division rounds once.
  if (digits <= std::uint64_t{1} << 53 && power >= -22) {
    static constexpr double tens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    return static_cast<double>(digits) / tens[-power];
  }
  const int zeros = std::countl_zero(digits);
  const U128 numerator = static_cast<U128>(digits << zeros) << 64;
  const std::uint64_t divisor = kFives[-power];
  const U128 quotient = numerator / divisor;  // at least 65 bits
  return to_double(quotient, power - zeros - 64, numerator % divisor != 0);
}

double nearest_double(std::string_view text, std::int64_t exponent) {
  Natural digits(0);
  int count = 0;
  bool after_point = false, more = false;
  for (const char c : text) {
    if (c == '.') {
      after_point = true;
    } else if (count < kMostDigits) {
      digits.multiply_add(10, static_cast<std::uint32_t>(c - '0'));
      if (digits.bits() != 0) ++count;
      if (after_point) --exponent;
    } else {
      more = more || c != '0';
      if (!after_point) ++exponent;
    }
  }
  if (more) {
    digits.multiply_add(10, 1);
    ++count;
    --exponent;
  }
  return scaled(digits, count, exponent);
}

Decimal round_to_digits(double value, int n) {
  int binary = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(value, &binary), 53));
  binary -= 53;
  const std::uint64_t low = kTens[n - 1], high = low * 10;
  // The decimal exponent of the first digit, or one less.
  int exponent = static_cast<int>(std::floor((binary + 52) * 0.30102999566398120));
  for (;;) {
    const int p = n - 1 - exponent;
    const int shift = -(binary + p);
    if (p < 0 || p > 32 || shift > 127 || shift < -40) break;  // beyond 128 bits
    U128 product = static_cast<U128>(mantissa) * kFives[p < kMaxFive ? p : kMaxFive];
    if (p > kMaxFive) product *= kFives[p - kMaxFive];
    const auto digits = static_cast<std::uint64_t>(round_shift(product, shift, false));
    if (digits >= high) {
      ++exponent;
    } else if (digits < low) {
      --exponent;
    } else {
      return {digits, -p};
    }
  }

  Natural over(mantissa), under(1);
  over.shift_left(binary);
  under.shift_left(-binary);
  over.multiply_by_power_of_ten(-exponent);
  under.multiply_by_power_of_ten(exponent);
  for (Natural next = under;; ++exponent) {
    next.multiply_add(10, 0);
    if (over.compare(next) < 0) break;
    under = next;
  }
  std::uint64_t digits = 0;
  for (int i = 0; i < n; ++i) {
    digits *= 10;
    for (; over.compare(under) >= 0; ++digits) over.subtract(under);
    over.multiply_add(10, 0);
  }
  under.multiply_add(5, 0);
  const int rest = over.compare(under);  // against half of the last digit
  if (rest > 0 || (rest == 0 && digits % 2 != 0)) ++digits;
  return {digits, exponent - n + 1};  // 10^n is a right answer too
}

}  // namespace pillowmesh
