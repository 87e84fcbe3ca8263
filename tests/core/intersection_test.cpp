#include "pillowmesh/metric/intersection.h"

#include <cmath>
#include <random>

#include "../catch.h"
#include "pillowmesh/metric/spectrum.h"

namespace intersection_test {

using namespace pillowmesh;

namespace {

template <int Dim>
SymTensor<Dim> random_metric(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  SymTensor<Dim> t;
  for (double& m : t.m) m = any(random);
  return exp_tensor(t);
}

template <int Dim>
void check_bounds_both() {
  std::mt19937 random(11);
  for (int i = 0; i < 300; ++i) {
    const auto A = random_metric<Dim>(random), B = random_metric<Dim>(random);
    const auto C = intersect(A, B), D = intersect(B, A);
    CHECK(dominated(A, (1.0 + 1e-6) * C));
    CHECK(dominated(B, (1.0 + 1e-6) * C));
    for (int k = 0; k < SymTensor<Dim>::size; ++k) CHECK(C.m[k] == Approx(D.m[k]).margin(1e-9));
    // Along each axis of the common basis the larger of the two counts: det C = det A * product of max(1, mu).
    Eigen::Matrix<double, Dim, Dim> a, b;
    for (int r = 0; r < Dim; ++r)
      for (int c = 0; c < Dim; ++c) a(r, c) = A(r, c), b(r, c) = B(r, c);
    const Spectrum<Dim> whole = spectrum(A);
    CHECK(whole.value[0] > 0.0);
    double expected = determinant(A);
    Eigen::Matrix<double, Dim, Dim> root = Eigen::Matrix<double, Dim, Dim>::Zero();
    for (int k = 0; k < Dim; ++k) root += whole.vector[k] * whole.vector[k].transpose() / std::sqrt(whole.value[k]);
    const Eigen::Matrix<double, Dim, Dim> n = root * b * root;
    SymTensor<Dim> N;
    for (int c = 0; c < Dim; ++c)
      for (int r = 0; r <= c; ++r) N(r, c) = n(r, c);
    for (const double mu : spectrum(N).value) expected *= std::max(1.0, mu);
    CHECK(determinant(C) == Approx(expected));
  }
}

}  // namespace

TEST_CASE("an intersection is at least both metrics, symmetric in them, and no more than simultaneous reduction says") {
  check_bounds_both<2>();
  check_bounds_both<3>();
}

TEST_CASE("the intersection of metrics that share their axes takes the smaller size along each") {
  const SymTensor<2> A{{100.0, 0.0, 1.0}}, B{{4.0, 0.0, 25.0}};
  const auto C = intersect(A, B);
  CHECK(C.m[0] == Approx(100.0));
  CHECK(C.m[1] == Approx(0.0).margin(1e-12));
  CHECK(C.m[2] == Approx(25.0));
  const SymTensor<3> M{{9.0, 1.0, 8.0, 0.5, 0.25, 7.0}};
  for (int k = 0; k < 6; ++k) CHECK(intersect(M, M).m[k] == Approx(M.m[k]));
  CHECK(intersect(M, 4.0 * M) == 4.0 * M);
}

TEST_CASE("one metric is dominated by another where no direction is shorter") {
  const SymTensor<2> A{{2.0, 0.5, 1.0}};
  CHECK(dominated(A, A));
  CHECK(dominated(A, SymTensor<2>{{3.0, 0.5, 1.0}}));
  CHECK_FALSE(dominated(A, SymTensor<2>{{3.0, 0.5, 0.9}}));
  CHECK_FALSE(dominated(A, SymTensor<2>{{2.1, 1.5, 1.1}}));  // longer along both axes, shorter in between
}

TEST_CASE("bounds cut sizes and anisotropy and keep directions") {
  // Sizes 0.01 and 10 along 30 degrees.
  const double c = std::sqrt(3.0) / 2, s = 0.5, a = 1e4, b = 1e-2;
  const SymTensor<2> M{{a * c * c + b * s * s, (a - b) * c * s, a * s * s + b * c * c}};
  const auto sizes = [&](const SizeBounds& bounds) {
    const Spectrum<2> cut = spectrum(bound_sizes(M, bounds));
    CHECK(std::fabs(cut.vector[1].dot(Point<2>(c, s))) == Approx(1.0));
    return std::array<double, 2>{1.0 / std::sqrt(cut.value[1]), 1.0 / std::sqrt(cut.value[0])};
  };
  CHECK(sizes({})[0] == Approx(0.01));
  CHECK(sizes({})[1] == Approx(10.0).epsilon(1e-6));
  CHECK(sizes({.smallest = 0.1})[0] == Approx(0.1));
  CHECK(sizes({.largest = 2.0})[1] == Approx(2.0));
  CHECK(sizes({.anisotropy = 50.0})[1] == Approx(0.5));
  CHECK(sizes({.anisotropy = 50.0})[0] == Approx(0.01));
}

}  // namespace intersection_test
