#include "pillowmesh/quality/statistics.h"

#include <cmath>
#include <limits>
#include <vector>

#include "../catch.h"

namespace statistics_test {

using namespace pillowmesh;

TEST_CASE("cv is the population standard deviation over the mean") {
  // Mean 3, squared deviations 4 1 0 1 4: standard deviation sqrt 2.
  const Statistics s = statistics(std::vector<double>{5, 1, 3, 2, 4});
  CHECK(s.count == 5);
  CHECK(s.min == 1.0);
  CHECK(s.max == 5.0);
  CHECK(s.mean == 3.0);
  CHECK(s.cv == Approx(std::sqrt(2.0) / 3.0));
}

TEST_CASE("the range is [1/sqrt 2, sqrt 2]") {
  CHECK(statistics(std::vector<double>{0.70, 0.71, 1.0, 1.41, 1.42}).share_in_range == Approx(0.6));
}

TEST_CASE("no values give zeros, equal values no variation") {
  CHECK(statistics({}).count == 0);
  CHECK(statistics({}).mean == 0.0);
  CHECK(statistics(std::vector<double>{2, 2, 2}).cv == 0.0);
  CHECK(statistics(std::vector<double>{0, 0}).cv == 0.0);
}

TEST_CASE("a value that is not a number is not passed over") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(statistics(std::vector<double>{1, nan, 2}).mean));
}

}  // namespace statistics_test
