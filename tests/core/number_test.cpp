#include "pillowmesh/mesh/number.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "../catch.h"

namespace number_test {

using namespace pillowmesh;

namespace {

double parsed(std::string_view text) {
  double value = -1.0;
  return parse_double(text, value) ? value : std::nan("");
}

/// A double of any exponent: subnormal, normal or infinite.
double any_double(std::mt19937_64& random) {
  const std::uint64_t bits = random() >> 1;
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return std::isnan(value) ? 5e-324 : value;
}

}  // namespace

TEST_CASE("a number at the start of a text is read as the C library reads it") {
  for (const char* text :
       {"0", "1", "12.5", ".5", "3.", "1e3", "1.5e-3", "0.1", "123456789012345678", "1e22", "1e-22", "6.02214076e23",
        "1.7976931348623157e308", "2.2250738585072014e-308", "0.30000000000000004"}) {
    double value = -1.0;
    CHECK(read_number(text, value) == std::string(text).size());
    CHECK(value == std::strtod(text, nullptr));
  }
}

TEST_CASE("a number ends where its text ends") {
  double value = 0.0;
  CHECK(read_number("2e", value) == 1);
  CHECK(read_number("2e+", value) == 1);
  CHECK(read_number("2d3", value) == 1);
  CHECK(read_number("1.2.3", value) == 3);
  CHECK(value == 1.2);
  CHECK(read_number("x", value) == 0);
  CHECK(read_number(".", value) == 0);
  CHECK(read_number("-1", value) == 0);
  CHECK(read_number("", value) == 0);
}

TEST_CASE("decimals of any length and exponent are read as the nearest double") {
  std::mt19937_64 random(11);
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int n = 1 + static_cast<int>(random() % (i % 50 == 0 ? 900 : 40)); n > 0; --n)
      text += static_cast<char>('0' + random() % 10);
    if (random() % 2 == 0) text.insert(random() % (text.size() + 1), ".");
    text += "e" + std::to_string(static_cast<int>(random() % 720) - 370);
    if (parsed(text) != std::strtod(text.c_str(), nullptr)) FAIL(text);
  }
  SUCCEED();
}

TEST_CASE("a decimal halfway between two doubles goes to the even one, and the least more goes up") {
  std::mt19937_64 random(12);
  for (int i = 0; i < 3000; ++i) {
    const double low = i == 0 ? 0.0 : i == 1 ? std::numeric_limits<double>::denorm_min() : any_double(random);
    if (!(low < std::numeric_limits<double>::max())) continue;
    char half[1500];  // exact: a double that long double holds, and half a unit of it
    std::snprintf(half, sizeof half, "%.1100Lf",
                  (static_cast<long double>(low) + std::nextafter(low, HUGE_VAL)) / 2.0L);
    if (parsed(half) != std::strtod(half, nullptr)) FAIL(half);
    std::strcat(half, "1");
    if (parsed(half) != std::strtod(half, nullptr)) FAIL(half);
  }
  SUCCEED();
}

TEST_CASE("numbers rounded for people are those of printf") {
  std::mt19937_64 random(13);
  for (int i = 0; i < 20000; ++i) {
    const double value = i % 2 == 0 ? any_double(random) : std::ldexp(static_cast<double>(random() % 100000), -8);
    const int digits = 1 + static_cast<int>(random() % 15);
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (parsed(rounded_text(value, digits)) != std::strtod(text, nullptr)) FAIL(text << " " << digits);
  }
  CHECK(rounded_text(-1234.5678, 6) == "-1234.57");
  CHECK(rounded_text(0.0, 6) == "0");
  CHECK(rounded_text(9.9999999, 6) == "10");
  CHECK(rounded_text(-HUGE_VAL, 6) == "-inf");
}

TEST_CASE("written numbers read back exactly") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double value = any_double(random) * (i % 2 == 0 ? 1 : -1);
    const std::string text = number_text(value);
    if (std::strtod(text.c_str(), nullptr) != value || text.size() >= kNumberLength) FAIL(text);
  }
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(-2.5) == "-2.5");
  CHECK(number_text(std::numeric_limits<double>::quiet_NaN()) == "nan");
}

}  // namespace number_test
