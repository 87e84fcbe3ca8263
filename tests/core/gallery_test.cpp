#include "pillowmesh/metric/gallery.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <set>
#include <string>
#include <variant>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/field.h"
#include "pillowmesh/metric/volume.h"

namespace gallery_test {

using namespace pillowmesh;

TEST_CASE("every case has a mesh on which its metric can be used") {
  for (const Case& c : gallery()) {
    CAPTURE(std::string(c.name));
    const Expected<AnyMesh> mesh = parse_primitive(c.mesh);
    REQUIRE(mesh);
    const auto check = [&]<int Dim>(const Mesh<Dim>& m) {
      CHECK(c.dim == Dim);
      const Expected<MetricField<Dim>> field = MetricField<Dim>::from_formula(c.formula);
      INFO(field.status().message);
      REQUIRE(field);
      const Status status = field->check(m.points);
      INFO(status.message);
      CHECK(status.ok());
    };
    std::visit(check, *mesh);
  }
}

TEST_CASE("names are unique and found") {
  std::set<std::string_view> names;
  for (const Case& c : gallery()) {
    CHECK(names.insert(c.name).second);
    CHECK(find_case(c.name) == &c);
    CHECK_FALSE(c.title.empty());
    CHECK_FALSE(c.source.empty());
  }
  for (const char* name : {"iso2d", "aniso2d", "circle2d", "linear3d", "sphere3d-paper", "sphere3d"})
    CHECK(find_case(name));
  CHECK(find_case("nothing") == nullptr);
  CHECK(find_case("") == nullptr);
}

TEST_CASE("iso2d is continuous where its pieces meet") {
  const auto field = *MetricField<2>::from_formula(find_case("iso2d")->formula);
  for (const double y : {2.0, 4.5, 7.0}) {
    const double below = field.evaluate(Point<2>(1, y - 1e-12)).m[0];
    CHECK(field.evaluate(Point<2>(1, y + 1e-12)).m[0] == Approx(below).epsilon(1e-9));
  }
}

TEST_CASE("the circle's metric is finest on the circle and thin along the radius") {
  const auto field = *MetricField<2>::from_formula(find_case("circle2d")->formula);
  const Point<2> outward(0.3, 0.4);
  const SymTensor<2> M = field.evaluate(outward);
  // r = 0.5: h1 = 1/240 along the radius, h2 = 1/60 across.
  CHECK(dot(M, outward, outward) == Approx(120.0 * 120.0));
  const Point<2> across(-0.4, 0.3);
  CHECK(dot(M, across, across) == Approx(30.0 * 30.0));
}

TEST_CASE("the shock's metric is the mean of the limited Hessians of its function at nine points, by their logarithms") {
  const auto field = *MetricField<2>::from_formula(find_case("shock2d")->formula);
  const auto mean_of_nine = [](double x, double y) {
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        const double X = x + 0.01 * i, Y = y + 0.01 * j, t = std::tanh(20 * (X - 0.5 * std::sin(3 * Y)));
        const double first = 20 * (1 - t * t), second = -800 * t * (1 - t * t), slope = -1.5 * std::cos(3 * Y);
        Eigen::Matrix2d H;
        H << second, second * slope, second * slope, second * slope * slope + first * 4.5 * std::sin(3 * Y);
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> s(H / 0.02);
        const Eigen::Vector2d limited = s.eigenvalues().cwiseAbs().cwiseMax(1 / 0.0225).cwiseMin(1 / 9e-6);
        const double weight = (2.0 - std::abs(i)) * (2.0 - std::abs(j)) / 16;
        sum += weight * (s.eigenvectors() * limited.array().log().matrix().asDiagonal() * s.eigenvectors().transpose());
      }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> s(sum);
    return Eigen::Matrix2d(s.eigenvectors() * s.eigenvalues().array().exp().matrix().asDiagonal() * s.eigenvectors().transpose());
  };
  for (int i = -20; i <= 20; ++i)
    for (int j = -20; j <= 20; ++j) {
      const double y = 0.05 * j + 0.003, x = 0.5 * std::sin(3 * y) + 0.013 * i + 0.001;
      CAPTURE(x, y);
      const Eigen::Matrix2d M = mean_of_nine(x, y);
      const SymTensor<2> found = field.evaluate(Point<2>(x, y));
      CHECK(found.m[0] == Approx(M(0, 0)).epsilon(1e-9));
      CHECK(found.m[1] == Approx(M(0, 1)).margin(1e-9 * M.trace()));
      CHECK(found.m[2] == Approx(M(1, 1)).epsilon(1e-9));
    }
  for (const double x : {-1e3, 1e3}) CHECK(field.evaluate(Point<2>(x, 0.3)).m[0] == Approx(1 / 0.0225));
}

TEST_CASE("sphere3d is thin along the radius, sphere3d-paper is not") {
  const Point<3> p = Point<3>(1, 2, 2) / 6.0;  // r = 0.5
  const double thin = 40.0 * 40.0;             // (r / h1)^2
  CHECK(dot((*MetricField<3>::from_formula(find_case("sphere3d")->formula)).evaluate(p), p, p) == Approx(thin));
  CHECK(dot((*MetricField<3>::from_formula(find_case("sphere3d-paper")->formula)).evaluate(p), p, p) < 0.9 * thin);
}

TEST_CASE("sphere3d-paper rotates in the order that the paper prints") {
  const Point<3> p(0.3, 0.5, 0.2);
  const double r = p.norm();
  const double t = std::atan2(p[1], p[0]);
  const double f = std::acos(p[2] / r) - std::acos(0.0);
  Eigen::Matrix3d rt;
  rt << std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1;
  Eigen::Matrix3d rp;
  rp << std::cos(f), 0, std::sin(f), 0, 1, 0, -std::sin(f), 0, std::cos(f);
  const double h1 = r / 40 + 3 * std::fabs(0.5 - r) / 2;
  const double h2 = r / 10 + 3 * std::fabs(0.5 - r) / 2;
  const Eigen::Matrix3d d = Eigen::Vector3d(1 / (h1 * h1), 1 / (h2 * h2), 1 / (h2 * h2)).asDiagonal();
  const Eigen::Matrix3d wanted = rp * rt * d * rt.transpose() * rp.transpose();
  const SymTensor<3> M = (*MetricField<3>::from_formula(find_case("sphere3d-paper")->formula)).evaluate(p);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) CHECK(M(i, j) == Approx(wanted(i, j)).margin(1e-9));
  }
}

TEST_CASE("the polar cases are thin along the radius of the hole, on the hole") {
  const Point<3> p(0.3, 0.4, 0.7), outward(0.6, 0.8, 0), around(-0.8, 0.6, 0), up(0, 0, 1);
  for (const char* name : {"polar-1", "polar-2"}) {
    const SymTensor<3> M = (*MetricField<3>::from_formula(find_case(name)->formula)).evaluate(p);
    CHECK(dot(M, outward, outward) == Approx(1e6));
    CHECK(dot(M, up, up) == Approx(100.0));
    CHECK(dot(M, outward, around) == Approx(0.0).margin(1e-6));
    CHECK(dot(M, around, around) == Approx(name[6] == '1' ? 100.0 : 1600.0));  // h_t = 0.1, or 1/40 on the hole
  }
}

TEST_CASE("the ideal number of hexahedra of the cases is that of their formulas") {
  // cube-linear: the integral of 100 / h_z, 100 ln(100) / 0.099 = 4651.7. polar-1 and polar-2: midpoint rule in
  // log h_r over the square minus the quarter disk; the mesh's arc is a polygon up to
  // 0.001 inside it: about half a layer of the thinnest cells more.
  const double h0 = 0.001, slope = 0.198, pi = 3.14159265358979;
  const auto polar = [&](bool second) {
    double sum = 0.0;
    const int n = 100, m = 400;
    for (int i = 0; i < n; ++i) {
      const double angle = (i + 0.5) / n * pi / 2;
      const double across = std::log((h0 + slope * (1 / std::max(std::cos(angle), std::sin(angle)) - 0.5)) / h0);
      for (int j = 0; j < m; ++j) {
        const double r = 0.5 + h0 * (std::exp((j + 0.5) / m * across) - 1) / slope;
        const double ht = second && r < 0.6 ? 0.25 * (0.6 - r) + 0.1 * (1 - 10 * (0.6 - r)) : 0.1;
        sum += r / (0.1 * ht * slope) * across / m * pi / 2 / n;
      }
    }
    return sum;
  };
  const auto measured = [](const char* name) {
    const Case& c = *find_case(name);
    return complexity(std::get<Mesh<3>>(*parse_primitive(c.mesh)), *MetricField<3>::from_formula(c.formula),
                      VolumeOptions{.tolerance = 1e-3, .panel = 0.02});
  };
  CHECK(measured("cube-linear") == Approx(100 * std::log(100.0) / 0.099).epsilon(0.01));
  CHECK(measured("polar-1") == Approx(1.04 * polar(false)).epsilon(0.04));
  CHECK(measured("polar-2") == Approx(1.04 * polar(true)).epsilon(0.04));
}

}  // namespace gallery_test
