#include "pillowmesh/metric/number.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "../catch.h"

using namespace pillowmesh;

TEST_CASE("numbers are read as the C library reads them") {
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
  CHECK(read_number("1.2.3", value) == 3);
  CHECK(value == 1.2);
  CHECK(read_number("x", value) == 0);
  CHECK(read_number(".", value) == 0);
  CHECK(read_number("-1", value) == 0);
  CHECK(read_number("", value) == 0);
}

TEST_CASE("written numbers read back exactly") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 5000; ++i) {
    const double value =
        std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 400) - 250) * (i % 2 == 0 ? 1 : -1);
    CHECK(std::strtod(write_number(value).c_str(), nullptr) == value);
  }
}

TEST_CASE("written numbers are short where they can be, and never NaN or infinite") {
  CHECK(write_number(0.1) == "0.1");
  CHECK(write_number(-2.5) == "-2.5");
  CHECK(write_number(std::numeric_limits<double>::quiet_NaN()) == "null");
  CHECK(write_number(-std::numeric_limits<double>::infinity()) == "null");
}
