#include "pillowmesh/metric/background.h"

#include <random>

#include "../catch.h"
#include "pillowmesh/metric/gallery.h"

namespace background_test {

using namespace pillowmesh;

namespace {

MetricField<2> formula(std::string_view text) { return *MetricField<2>::from_formula(text); }

/// |H^-1 (K - H)|_F
double difference(const SizeTensor& H, const SizeTensor& K) {
  const double det = H.a * H.c - H.b * H.b, a = K.a - H.a, b = K.b - H.b, c = K.c - H.c;
  const double p = (H.c * a - H.b * b) / det, q = (H.c * b - H.b * c) / det, r = (H.a * b - H.b * a) / det,
               s = (H.a * c - H.b * b) / det;
  return std::sqrt(p * p + q * q + r * r + s * s);
}

}  // namespace

TEST_CASE("the size tensor is the inverse square root of the metric") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.1, 5.0);
  for (int i = 0; i < 100; ++i) {
    SymTensor<2> M;
    M.m = {any(random), 0.0, any(random)};
    M.m[1] = 0.9 * std::sqrt(M.m[0] * M.m[2]) * (any(random) / 2.5 - 1.0);
    const SizeTensor H = size_tensor(M);
    // H M H = I
    const double x = M.m[0] * H.a + M.m[1] * H.b, y = M.m[0] * H.b + M.m[1] * H.c, z = M.m[1] * H.a + M.m[2] * H.b,
                 w = M.m[1] * H.b + M.m[2] * H.c;
    CHECK(H.a * x + H.b * z == Approx(1.0));
    CHECK(H.a * y + H.b * w == Approx(0.0).margin(1e-12));
    CHECK(H.b * y + H.c * w == Approx(1.0));
  }
}

TEST_CASE("lookups are within the stated error of the metric where it is smooth") {
  const Point<2> low(-1, -1), high(1, 2);
  std::mt19937 random(7);
  for (const char* text : {"h = 0.1 + 0.05*x^2", "h1 = 0.02 + 0.1*y^2; h2 = 0.3; theta = x + y",
                           "theta = atan2(y, x + 3); h1 = 0.01*exp(y); h2 = 0.2"}) {
    INFO(text);
    const auto field = formula(text);
    Background background(field, low, high);
    for (int i = 0; i < 2000; ++i) {
      const Point<2> p(low[0] + 2.0 * random() / 4294967296.0, low[1] + 3.0 * random() / 4294967296.0);
      REQUIRE(difference(size_tensor(field.evaluate(p)), background.at(p)) < 6e-3);
    }
  }
}

TEST_CASE("with its sizes halved a background has the bits of one that was made for them") {
  const Point<2> low(-1, -1), high(1, 1);
  for (const char* name : {"circle2d", "shock2d"}) {
    INFO(name);
    const auto field = formula(find_case(name)->formula);
    Background halved(field.scaled(4.0), low, high), fresh(field, low, high);
    std::mt19937 random(13);
    const auto any = [&] { return Point<2>(2.0 * random() / 4294967296.0 - 1.0, 2.0 * random() / 4294967296.0 - 1.0); };
    const auto jet_at = [](Background& background, const Point<2>& p) {
      const SizeJet j = background.jet(p);
      return std::array<double, 9>{j.H.a, j.H.b, j.H.c, j.dx.a, j.dx.b, j.dx.c, j.dy.a, j.dy.b, j.dy.c};
    };
    for (const double coarser : {2.0, 1.0}) {
      for (int i = 0; i < 2000; ++i) jet_at(halved, any());
      const std::size_t before = halved.leaves();
      halved.halve_sizes(field.scaled(coarser));
      CHECK(halved.leaves() == before);
    }
    const std::size_t before = halved.leaves();
    for (int i = 0; i < 4000; ++i) {
      const Point<2> p = any();
      REQUIRE(jet_at(halved, p) == jet_at(fresh, p));
    }
    CHECK(halved.leaves() > before);        // kinks are divided further than coarse sizes needed
    CHECK(before > fresh.leaves() / 3);  // and much of it was there
  }
}

TEST_CASE("a lookup has the same bits whatever was asked before, with and without derivatives") {
  const auto field = formula(find_case("circle2d")->formula);
  const Point<2> low(-1, -1), high(1, 1);
  std::mt19937 random(11);
  std::vector<Point<2>> points;
  for (int i = 0; i < 3000; ++i) points.emplace_back(2.0 * random() / 4294967296.0 - 1.0, 2.0 * random() / 4294967296.0 - 1.0);
  Background forwards(field, low, high), backwards(field, low, high);
  std::vector<SizeTensor> seen;
  for (const auto& p : points) seen.push_back(forwards.at(p));
  for (std::size_t i = points.size(); i-- > 0;) {
    const SizeTensor H = backwards.at(points[i]), J = backwards.jet(points[i]).H;
    REQUIRE((H.a == seen[i].a && H.b == seen[i].b && H.c == seen[i].c));
    REQUIRE((J.a == H.a && J.b == H.b && J.c == H.c));
  }
  Index near = kNone, far = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point<2> p = 0.01 * points[i] + 0.99 * points[i / 50];  // fifty at a time lie together
    const SizeTensor H = forwards.at(p), found = backwards.at(p, near);
    REQUIRE((found.a == H.a && found.b == H.b && found.c == H.c));
    const SizeTensor J = backwards.jet(points[i], far).H;
    REQUIRE((J.a == seen[i].a && J.b == seen[i].b && J.c == seen[i].c));
  }
}

TEST_CASE("derivatives are those of what is looked up") {
  const auto field = formula("h1 = 0.05 + 0.1*y^2; h2 = 0.3 + 0.1*x; theta = x + y");
  Background background(field, Point<2>(0, 0), Point<2>(1, 1));
  const Point<2> p(0.31, 0.62);
  const SizeJet jet = background.jet(p);
  const double h = 1e-6;
  const SizeTensor right = background.at(p + Point<2>(h, 0)), left = background.at(p - Point<2>(h, 0));
  const SizeTensor up = background.at(p + Point<2>(0, h)), down = background.at(p - Point<2>(0, h));
  CHECK(jet.dx.a == Approx((right.a - left.a) / (2 * h)).epsilon(1e-5));
  CHECK(jet.dx.b == Approx((right.b - left.b) / (2 * h)).epsilon(1e-5));
  CHECK(jet.dy.c == Approx((up.c - down.c) / (2 * h)).epsilon(1e-5));
}

TEST_CASE("sizes stay positive where the metric jumps, and points outside of the box have those of its border") {
  const auto field = formula("h = if(x < 0.3, 1, 0.001)");
  Background background(field, Point<2>(0, 0), Point<2>(1, 1));
  for (int i = 0; i <= 10000; ++i) {
    const SizeTensor H = background.at(Point<2>(0.29 + 2e-6 * i, 0.5));
    REQUIRE(H.a > 0);
    REQUIRE(H.a * H.c - H.b * H.b > 0);
  }
  CHECK(background.at(Point<2>(7, 0.5)).a == background.at(Point<2>(1, 0.5)).a);
}

}  // namespace background_test
