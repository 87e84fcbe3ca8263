#include "pillowmesh/mesh/portable_math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "../catch.h"
#include "pillowmesh/adapt/random.h"
#include "pillowmesh/metric/branchless.h"
#include "pillowmesh/metric/field.h"

namespace portable_math_test {

using namespace pillowmesh;

namespace {

// Distance in units of the last place of the reference.
double ulps(double value, double reference) {
  if (value == reference) return 0.0;
  const double ulp = std::fabs(std::nextafter(reference, std::numeric_limits<double>::infinity()) - reference);
  return std::fabs(value - reference) / ulp;
}

template <class F, class G>
double worst(F ours, G reference, double low, double high) {
  std::mt19937_64 random(7);
  double most = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double x = low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
    most = std::max(most, ulps(ours(x), reference(x)));
  }
  return most;
}

}  // namespace

TEST_CASE("portable functions agree with the system's within two units in the last place") {
  CHECK(worst(
            portable::exp, [](double x) { return std::exp(x); }, -700, 700) <= 2);
  CHECK(worst(
            portable::log, [](double x) { return std::log(x); }, 1e-9, 50) <= 2);
  CHECK(worst(
            portable::sin, [](double x) { return std::sin(x); }, -1e6, 1e6) <= 2);
  CHECK(worst(
            portable::cos, [](double x) { return std::cos(x); }, -30, 30) <= 2);
  CHECK(worst(
            portable::tan, [](double x) { return std::tan(x); }, -30, 30) <= 2);
  CHECK(worst(
            portable::atan, [](double x) { return std::atan(x); }, -30, 30) <= 2);
  CHECK(worst(
            portable::asin, [](double x) { return std::asin(x); }, -1, 1) <= 2);
  CHECK(worst(
            portable::acos, [](double x) { return std::acos(x); }, -1, 1) <= 2);
  CHECK(worst([](double x) { return portable::pow(x, 1.7); }, [](double x) { return std::pow(x, 1.7); }, 0, 9) <= 2);
  CHECK(worst([](double x) { return portable::atan2(x, -0.3); }, [](double x) { return std::atan2(x, -0.3); }, -2, 2) <=
        2);
  CHECK(worst(
            portable::floor, [](double x) { return std::floor(x); }, -1e3, 1e3) == 0);
}

TEST_CASE("functions without branches agree with the system's within two units in the last place, near 0 and 1 too") {
  const auto log = [](double x) { return std::log(x); };
  CHECK(worst(branchless::log, log, 0, 1e-9) <= 1);
  CHECK(worst(branchless::log, log, 1e-9, 50) <= 1);
  CHECK(worst(branchless::log, log, 0.999, 1.001) <= 1);
  CHECK(worst(branchless::log, log, 0, 1e-310) <= 1);
  CHECK(worst(branchless::log, log, 1e300, 1e308) <= 1);
  const auto tanh = [](double x) { return std::tanh(x); };
  CHECK(worst(branchless::tanh, tanh, -0.7, 0.7) <= 2);
  CHECK(worst(branchless::tanh, tanh, -25, 25) <= 2);
  CHECK(worst(branchless::tanh, tanh, -1e-300, 1e-300) <= 2);
}

TEST_CASE("sine and cosine without branches have the bits of those with them, or say that they may not") {
  const std::uint64_t seed = 20'261'128;
  CAPTURE(seed);
  Random random(seed);
  int same = 0, doubtful = 0;
  const auto compare = [&](double x) {
    const branchless::QuarterTurns turns = branchless::quarter_turns(x);
    if (turns.doubtful) {
      ++doubtful;
      return;
    }
    const auto bits = [](double y) { return std::bit_cast<std::uint64_t>(y); };
    same += bits(branchless::sin(turns)) == bits(portable::sin(x)) && bits(branchless::cos(turns)) == bits(portable::cos(x));
  };
  constexpr int n = 200'000;
  for (int i = 0; i < n; ++i) compare(100.0 * (2.0 * random.uniform() - 1.0));
  CHECK(doubtful < n / 500);
  CHECK(same + doubtful == n);
  same = doubtful = 0;
  // Of every size, and around the multiples of a quarter of pi.
  for (int i = 0; i < n; ++i) compare(portable::pow(2.0, 60.0 * random.uniform() - 40.0) * (2.0 * random.uniform() - 1.0));
  for (int i = -500; i <= 500; ++i)
    for (int j = -100; j <= 100; ++j) compare(i * 0.78539816339744831 + j * std::abs(j) * 1e-7);
  CHECK(same + doubtful == n + 1001 * 201);
  same = doubtful = 0;
  for (const double x : {0.0, -0.0}) compare(x);
  CHECK(same == 2);
  for (const double x : {std::numeric_limits<double>::infinity(), std::nan("")}) compare(x);
  CHECK(doubtful == 2);
}

TEST_CASE("formulas have exponentials with the bits that those have one by one") {
  const std::uint64_t seed = 20'261'129;
  CAPTURE(seed);
  Random random(seed);
  const MetricField<2> field = *MetricField<2>::from_formula("m11 = exp(x);\nm12 = 0;\nm22 = exp(y)");
  std::vector<Point<2>> points;
  for (int i = 0; i < 200'000; ++i) {
    // Where they are finite, and of every size.
    const double size = portable::pow(2.0, 80.0 * random.uniform() - 70.0);
    points.emplace_back(1440.0 * (random.uniform() - 0.5), random.uniform() < 0.5 ? size : -size);
  }
  for (const double x : {0x1p-54, 0x1.fffffffffffffp-55, 0x1.fffffffffffffp8, 512.0, 0.0, 709.0})
    points.emplace_back(x, -x);
  std::vector<SymTensor<2>> M(points.size());
  field.evaluate(points, M);
  std::size_t same = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    same += M[i].m[0] == portable::exp(points[i][0]) && M[i].m[2] == portable::exp(points[i][1]);
  CHECK(same == points.size());
}

TEST_CASE("formulas have exponentials one by one where they overflow among others") {
  const MetricField<2> field = *MetricField<2>::from_formula("m11 = 1 + exp(x);\nm12 = 0;\nm22 = 1 + exp(y)");
  std::vector<Point<2>> points;
  for (int i = 0; i < 64; ++i) points.emplace_back(i == 5 ? 600.0 : 0.3 * i, i == 37 ? 1e9 : (i == 50 ? 0.0 : -12.0 * i));
  std::vector<SymTensor<2>> M(points.size());
  field.evaluate(points, M);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CAPTURE(i);
    CHECK(M[i].m[0] == 1 + portable::exp(points[i][0]));
    CHECK(M[i].m[2] == 1 + portable::exp(points[i][1]));
  }
}

TEST_CASE("formulas have sines and cosines one by one where they are doubtful among others") {
  const MetricField<2> field = *MetricField<2>::from_formula("m11 = 3 + sin(x);\nm12 = 0;\nm22 = 3 + cos(y)");
  std::vector<Point<2>> points;
  for (int i = 0; i < 64; ++i) points.emplace_back(0.3 * i, i == 37 ? 1e9 : (i == 50 ? 1.5707963267948966 : -0.2 * i));
  std::vector<SymTensor<2>> M(points.size());
  field.evaluate(points, M);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CAPTURE(i);
    CHECK(M[i].m[0] == 3 + portable::sin(points[i][0]));
    CHECK(M[i].m[2] == 3 + portable::cos(points[i][1]));
  }
}

TEST_CASE("functions without branches treat the ends of their domains as IEEE 754 wants") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(branchless::log(1.0) == 0.0);
  CHECK(branchless::log(0.0) == -infinity);
  CHECK(branchless::log(-0.0) == -infinity);
  CHECK(branchless::log(infinity) == infinity);
  CHECK(std::isnan(branchless::log(-1.0)));
  CHECK(std::isnan(branchless::log(-infinity)));
  CHECK(std::isnan(branchless::log(std::nan(""))));
  CHECK(branchless::tanh(infinity) == 1.0);
  CHECK(branchless::tanh(-infinity) == -1.0);
  CHECK(std::isnan(branchless::tanh(std::nan(""))));
}

TEST_CASE("portable functions have these very bits, on every platform") {
  // A digest over many arguments. A change here means that meshes differ between builds.
  std::uint64_t digest = 1469598103934665603u;
  const auto add = [&](double value) { digest = (digest ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u; };
  for (int i = -400; i <= 400; ++i) {
    const double x = i * 0.01 + 0.001;
    for (const auto f : {portable::exp, portable::sin, portable::cos, portable::tan, portable::atan, portable::floor}) {
      add(f(x));
    }
    add(branchless::tanh(x));
    add(portable::log(std::fabs(x)));
    add(branchless::log(std::fabs(x)));
    add(portable::asin(x / 5));
    add(portable::acos(x / 5));
    add(portable::pow(std::fabs(x), 2.3));
    add(portable::atan2(x, 1.5 - x));
  }
  CHECK(digest == 0x2945c4f3b8d0dbb8u);
}

TEST_CASE("portable functions treat the ends of their domains as IEEE 754 wants") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(portable::exp(-infinity) == 0.0);
  CHECK(portable::exp(1e4) == infinity);
  CHECK(portable::log(0.0) == -infinity);
  CHECK(std::isnan(portable::log(-1.0)));
  CHECK(std::isnan(portable::asin(1.5)));
  CHECK(portable::pow(0.0, 0.0) == 1.0);
  CHECK(portable::atan2(0.0, 0.0) == 0.0);
  CHECK(portable::floor(-0.5) == -1.0);
}

}  // namespace portable_math_test
