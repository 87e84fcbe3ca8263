#include "pillowmesh/metric/portrait.h"

#include <algorithm>

#include "../catch.h"

namespace portrait_test {

using namespace pillowmesh;

TEST_CASE("the portrait is a light face in dark hair, beard and coat, the same at every size") {
  for (const int n : {64, 256}) {
    const GrayImage image = portrait(4 * n, 5 * n);
    const auto at = [&](double x, double y) {  // -0.8 to 0.8, -1 to 1 upward
      return image.values[static_cast<std::size_t>((1.0 - y) / 2.0 * image.height) * image.width +
                          static_cast<std::size_t>((x + 0.8) / 1.6 * image.width)];
    };
    CHECK(std::all_of(image.values.begin(), image.values.end(), [](float v) { return v >= 0.0F && v <= 1.0F; }));
    const float forehead = at(0.0, 0.4), hair = at(-0.35, 0.5), beard = at(0.0, -0.5), coat = at(0.4, -0.9);
    CHECK(forehead > 0.6F);
    CHECK(hair < 0.3F);
    CHECK(beard < 0.3F);
    CHECK(coat < 0.3F);
    CHECK(at(-0.165, 0.117) < 0.2F);  // pupils
    CHECK(at(0.169, 0.117) < 0.2F);
  }
}

}  // namespace portrait_test
