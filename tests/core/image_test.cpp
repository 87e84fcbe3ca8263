#include "pillowmesh/metric/image.h"

#include <cmath>
#include <limits>

#include "../catch.h"
#include "pillowmesh/metric/portrait.h"
#include "pillowmesh/metric/spectrum.h"

namespace image_test {

using namespace pillowmesh;

namespace {

template <class F>
GrayImage draw(int width, int height, F f) {
  GrayImage image{width, height, {}};
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      image.values.push_back(static_cast<float>(f((i + 0.5) / width, 1.0 - (j + 0.5) / height)));
  return image;
}

std::string refusal(const GrayImage& image) {
  const auto metric = image_metric(image, {0.0, 0.0}, {1.0, 1.0});
  return metric ? "" : metric.status().message;
}
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("cells are thin across an edge of an image and long along it") {
  // An edge along y = x: the metric's short direction is (1, -1).
  const auto metric =
      image_metric(draw(200, 200, [](double x, double y) { return x > y ? 1.0 : 0.0; }), {0.0, 0.0}, {1.0, 1.0});
  REQUIRE(metric);
  const auto field = *look_up(*metric);
  const Spectrum<2> at_edge = spectrum(field.evaluate(Point<2>(0.5, 0.5))),
                    away = spectrum(field.evaluate(Point<2>(0.8, 0.2)));
  CHECK(std::fabs(at_edge.vector[1].dot(Point<2>(1.0, -1.0).normalized())) > 0.99);
  CHECK(at_edge.value[1] > 10.0 * at_edge.value[0]);
  // With curvatures c = 1 and f (the floor) there, f and f away: (c f)^(-1/4) c / (f^2)^(-1/4) / f = f^(-3/4) = 18.8 where c is largest.
  CHECK(at_edge.value[1] > 10.0 * away.value[1]);
  CHECK(at_edge.value[1] < 19.0 * away.value[1]);
}

TEST_CASE("a quadratic image has the metric of its Hessian away from the rim") {
  ImageOptions options;
  options.hessian.norm = 1e300;  // M = |H|
  options.hessian.floor = 1e-6;
  const auto metric = image_metric(draw(120, 120, [](double x, double y) { return 3.0 * x * x + 0.5 * y * y - x * y; }),
                                   {0.0, 0.0}, {1.0, 1.0}, options);
  REQUIRE(metric);
  const auto M = (*look_up(*metric)).evaluate(Point<2>(0.5, 0.5));
  // Pixels lie half a pixel inside of the image, but its rim is put on that of the box.
  CHECK(M.m[0] == Approx(6.0).epsilon(0.03));
  CHECK(M.m[1] == Approx(-1.0).epsilon(0.03));
  CHECK(M.m[2] == Approx(1.0).epsilon(0.03));
}

TEST_CASE("the image is upright: its first row is at the top of the box") {
  const auto metric =
      image_metric(draw(64, 64, [](double x, double y) { return std::hypot(x - 0.3, y - 0.8) < 0.1 ? 1.0 : 0.0; }),
                   {10.0, 20.0}, {11.0, 22.0});
  REQUIRE(metric);
  const auto field = *look_up(*metric);
  CHECK(determinant(field.evaluate(Point<2>(10.3, 21.8))) > 10.0 * determinant(field.evaluate(Point<2>(10.3, 20.4))));
  CHECK(determinant(field.evaluate(Point<2>(10.3, 21.8))) > 10.0 * determinant(field.evaluate(Point<2>(10.7, 21.6))));
}

TEST_CASE("large images are brought down to a background of bearable size") {
  const auto metric = image_metric(portrait(1000, 1250), {0.0, 0.0}, {0.8, 1.0});
  REQUIRE(metric);
  CHECK(metric->points.size() == 256 * 320);
}

TEST_CASE("images in which there is nothing to follow are refused with what to do") {
  CHECK(contains(refusal(draw(50, 50, [](double, double) { return 0.7; })), "one colour"));
  CHECK(contains(refusal(draw(3, 50, [](double x, double) { return x; })), "3 x 50"));
  GrayImage broken = draw(10, 10, [](double x, double) { return x * x; });
  broken.values[23] = std::numeric_limits<float>::quiet_NaN();
  CHECK(contains(refusal(broken), "pixel (3, 2)"));
  broken.values.pop_back();
  CHECK(contains(refusal(broken), "10 x 10 values, not 99"));
}

}  // namespace image_test
