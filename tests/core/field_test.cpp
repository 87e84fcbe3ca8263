#include "pillowmesh/metric/field.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "../catch.h"

namespace field_test {

using namespace pillowmesh;

namespace {

template <int Dim>
MetricField<Dim> field(std::string_view text) {
  Expected<MetricField<Dim>> f = MetricField<Dim>::from_formula(text);
  INFO(text << ": " << f.status().message);
  REQUIRE(f);
  return *f;
}

template <int Dim>
std::string error_of(std::string_view text) {
  const Expected<MetricField<Dim>> f = MetricField<Dim>::from_formula(text);
  if (f) return "";
  CHECK(f.status().code == StatusCode::usage);
  return f.status().message;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Eigen::Matrix3d full(const SymTensor<3>& M) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = M(i, j);
  }
  return m;
}

}  // namespace

TEST_CASE("one size prescribes the same length in every direction") {
  CHECK(field<2>("h = 0.5 + x").evaluate(Point<2>(0.5, 9)).m == std::array<double, 3>{1, 0, 1});
  CHECK(field<3>("h = z").evaluate(Point<3>(0, 0, 0.5)).m == std::array<double, 6>{4, 0, 4, 0, 0, 4});
}

TEST_CASE("sizes without an angle lie along the axes") {
  CHECK(field<2>("h1 = 1; h2 = 0.5").evaluate(Point<2>(0, 0)).m == std::array<double, 3>{1, 0, 4});
  CHECK(field<3>("h1 = 1; h2 = 0.5; h3 = 0.25").evaluate(Point<3>(0, 0, 0)).m ==
        std::array<double, 6>{1, 0, 4, 0, 0, 16});
}

TEST_CASE("theta is the angle of the h1 direction") {
  const double angle = 0.4;
  const SymTensor<2> M = field<2>("theta = 0.4; h1 = 0.1; h2 = 2").evaluate(Point<2>(0, 0));
  const Point<2> along(0.1 * std::cos(angle), 0.1 * std::sin(angle));
  const Point<2> across(-2 * std::sin(angle), 2 * std::cos(angle));
  CHECK(dot(M, along, along) == Approx(1.0));
  CHECK(dot(M, across, across) == Approx(1.0));
  CHECK(dot(M, along, across) == Approx(0.0).margin(1e-12));
}

TEST_CASE("an angle that depends on the point rotates the metric with it") {
  const MetricField<2> f = field<2>("theta = atan2(y, x); h1 = 0.1; h2 = 1");
  for (const double a : {0.0, 0.7, 2.0, -3.0, -1.2}) {
    const Point<2> outward(0.1 * std::cos(a), 0.1 * std::sin(a));
    CHECK(dot(f.evaluate(Point<2>(5 * outward)), outward, outward) == Approx(1.0));
  }
}

TEST_CASE("theta and phi rotate as the paper's Eqs. (10) and (11), in the order R_theta R_phi") {
  const double t = 0.6;
  const double p = -0.35;
  Eigen::Matrix3d rt;
  rt << std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1;
  Eigen::Matrix3d rp;
  rp << std::cos(p), 0, std::sin(p), 0, 1, 0, -std::sin(p), 0, std::cos(p);
  const Eigen::Matrix3d d = Eigen::Vector3d(1.0, 4.0, 16.0).asDiagonal();
  const Eigen::Matrix3d wanted = rt * rp * d * rp.transpose() * rt.transpose();
  const std::string sizes = "h1 = 1; h2 = 0.5; h3 = 0.25;";
  CHECK(full(field<3>(sizes + "theta = 0.6; phi = -0.35").evaluate(Point<3>(1, 2, 3))).isApprox(wanted, 1e-14));
  CHECK(full(field<3>(sizes + "theta = 0.6").evaluate(Point<3>(1, 2, 3))).isApprox(rt * d * rt.transpose(), 1e-14));
  CHECK(full(field<3>(sizes + "phi = -0.35").evaluate(Point<3>(1, 2, 3))).isApprox(rp * d * rp.transpose(), 1e-14));
}

TEST_CASE("two equal sizes give the tensor that two names of the same size give") {
  const std::string angles = "; theta = 0.3 + x; phi = y - 0.2", a = "0.1 + x", b = "2 + z", same = "2 + z + 0*x";
  const std::pair<std::string, std::string> texts[] = {
      {"h1 = " + a + "; h2 = " + b + "; h3 = " + b, "h1 = " + a + "; h2 = " + b + "; h3 = " + same},
      {"h2 = " + a + "; h3 = " + b + "; h1 = " + b, "h2 = " + a + "; h3 = " + b + "; h1 = " + same},
      {"h3 = " + a + "; h1 = " + b + "; h2 = " + b, "h3 = " + a + "; h1 = " + b + "; h2 = " + same}};
  for (const auto& [short_text, long_text] : texts)
    for (const Point<3>& p : {Point<3>(0, 0, 0), Point<3>(0.4, -1, 3), Point<3>(2, 5, -1)})
      CHECK(full(field<3>(short_text + angles).evaluate(p)).isApprox(full(field<3>(long_text + angles).evaluate(p)), 1e-14));
}

TEST_CASE("sine and cosine of an arc are quotients, and those of no angle at the origin") {
  const MetricField<2> f = field<2>("t = atan2(y, x); m11 = 2 + cos(t); m12 = 0; m22 = 2 + sin(t)");
  CHECK(f.evaluate(Point<2>(3, 4)).m == std::array<double, 3>{2.6, 0, 2.8});
  CHECK(f.evaluate(Point<2>(0, 0)).m == std::array<double, 3>{3, 0, 2});
  CHECK(f.evaluate(Point<2>(-2, 0)).m == std::array<double, 3>{1, 0, 2});
}

TEST_CASE("the tensor can be given by its entries") {
  CHECK(field<2>("m11 = 4; m12 = x; m22 = 2").evaluate(Point<2>(0.5, 0)).m == std::array<double, 3>{4, 0.5, 2});
  CHECK(field<3>("m11=1;m12=2;m22=3;m13=4;m23=5;m33=6").evaluate(Point<3>(0, 0, 0)).m ==
        std::array<double, 6>{1, 2, 3, 4, 5, 6});
}

TEST_CASE("scaled multiplies the sizes") {
  const MetricField<2> f = field<2>("h = 1 + x");
  CHECK(f.scaled(0.5).evaluate(Point<2>(1, 0)).m[0] == 1.0);
  CHECK(f.scaled(0.5).scaled(4.0).evaluate(Point<2>(0, 0)).m[0] == 0.25);
  CHECK(MetricField<3>::uniform(SymTensor<3>::isotropic(1.0)).scaled(2.0).evaluate(Point<3>(0, 0, 0)) ==
        SymTensor<3>::isotropic(2.0));
}

TEST_CASE("many points at once give the bits of one at a time") {
  const MetricField<3> f =
      field<3>("theta = x*y; phi = z; h1 = 0.1 + exp(x); h2 = 1 + if(y > 0.3, sin(z), z^3); h3 = 2");
  std::vector<Point<3>> points;
  for (int i = 0; i < 150; ++i) points.emplace_back(i * 0.01, (i % 13) * 0.1, (i % 7) * 0.05);
  std::vector<SymTensor<3>> tensors(points.size());
  f.evaluate(points, tensors);
  for (std::size_t i = 0; i < points.size(); ++i) CHECK(f.evaluate(points[i]) == tensors[i]);
}

TEST_CASE("check names the first point where the metric cannot be used") {
  const std::vector<Point<2>> points{{0.5, 0}, {1.5, 0.25}, {2, 0}};
  CHECK(field<2>("h = 3 - x").check(points).ok());
  const Status negative = field<2>("h = 1 - x").check(points);
  CHECK(negative.code == StatusCode::bad_input);
  CHECK(contains(negative.message, "(1.5, 0.25)"));
  CHECK(contains(field<2>("h = x - 2").check(points).message, "(0.5, 0)"));
  CHECK_FALSE(field<2>("h = log(0 - x)").check(points).ok());
  CHECK_FALSE(field<2>("h = 1/0").check(points).ok());
  CHECK_FALSE(field<2>("m11 = 1; m12 = 2; m22 = 1").check(points).ok());
  CHECK_FALSE(field<3>("m11=1;m12=0;m22=1;m13=0;m23=0;m33=-1").check(std::vector<Point<3>>{{0, 0, 0}}).ok());
  CHECK_FALSE(field<2>("theta = 0.5; h1 = -1; h2 = 1").check(points).ok());
}

TEST_CASE("results that are missing or do not go together are named") {
  CHECK(contains(error_of<2>("s = 1"), "assigns no metric; it must assign h, or h1 and h2"));
  CHECK(contains(error_of<2>("h1 = 1"), "does not assign 'h2'"));
  CHECK(contains(error_of<3>("h1 = 1; h2 = 1"), "does not assign 'h3'"));
  CHECK(contains(error_of<2>("m11 = 1; m22 = 1"), "does not assign 'm12'"));
  CHECK(contains(error_of<3>("m11 = 1; m12 = 0; m22 = 1"), "does not assign 'm13'"));
  CHECK(contains(error_of<2>("h = 1; h1 = 1; h2 = 1"), "assigns h, h1, h2, which do not go together"));
  CHECK(contains(error_of<2>("h = 1; m11 = 1"), "h, m11, which do not go together"));
  CHECK(contains(error_of<2>("h1=1; h2=1; h3=1"), "column 13: 'h3' has no meaning in two dimensions"));
  CHECK(contains(error_of<2>("m11=1;m12=0;m22=1;m33=1"), "column 19: 'm33' has no meaning"));
  CHECK(contains(error_of<2>("h = z"), "'z' is not available"));
}

TEST_CASE("a floor on sizes keeps the directions and gives the root of the sum of squares") {
  const auto plane = field<2>("h1 = 0.1; h2 = 2; theta = 0.3").floored(0.5);
  const auto wanted = field<2>("h1 = sqrt(0.1^2 + 0.25); h2 = sqrt(4.25); theta = 0.3");
  const auto solid = field<3>("h1 = 0.001; h2 = 0.1; h3 = 3; theta = 0.7; phi = 1.1").scaled(2).floored(0.2);
  const auto same = field<3>("h1 = sqrt(0.002^2 + 0.04); h2 = sqrt(0.08); h3 = sqrt(36.04); theta = 0.7; phi = 1.1");
  const SymTensor<2> a = plane.evaluate({1, 2}), b = wanted.evaluate({1, 2});
  const SymTensor<3> c = solid.evaluate({1, 2, 3}), d = same.evaluate({1, 2, 3});
  for (int k = 0; k < 3; ++k) CHECK(a.m[k] == Approx(b.m[k]).epsilon(1e-12));
  for (int k = 0; k < 6; ++k) CHECK(c.m[k] == Approx(d.m[k]).epsilon(1e-7));
  CHECK(field<2>("h = x + 1").floored(0).evaluate({1, 2}) == field<2>("h = x + 1").evaluate({1, 2}));
  // A floor is a size: it is scaled with the others.
  CHECK(field<2>("h = 3").floored(4).scaled(2).evaluate({0, 0}).m[0] == Approx(0.01));
}

}  // namespace field_test
