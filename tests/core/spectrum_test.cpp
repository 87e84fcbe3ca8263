#include "pillowmesh/metric/spectrum.h"

#include <cmath>
#include <limits>
#include <random>

#include "../catch.h"

namespace spectrum_test {

using namespace pillowmesh;

namespace {

template <int Dim>
SymTensor<Dim> random_tensor(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> any(-size, size);
  SymTensor<Dim> t;
  for (double& m : t.m) m = any(random);
  return t;
}

template <int Dim>
double largest_difference(const SymTensor<Dim>& a, const SymTensor<Dim>& b) {
  double worst = 0.0;
  for (int k = 0; k < SymTensor<Dim>::size; ++k) worst = std::max(worst, std::fabs(a.m[k] - b.m[k]));
  return worst;
}

template <int Dim>
void check_spectrum() {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const SymTensor<Dim> M = random_tensor<Dim>(random, 10.0);
    const Spectrum<Dim> s = spectrum(M);
    for (int a = 0; a < Dim; ++a) {
      if (a > 0) CHECK(s.value[a - 1] <= s.value[a]);
      for (int b = 0; b < Dim; ++b)
        CHECK(s.vector[a].dot(s.vector[b]) == Approx(a == b ? 1.0 : 0.0).margin(1e-14));
    }
    CHECK(largest_difference(compose(s), M) < 1e-13);
  }
}

}  // namespace

TEST_CASE("a spectrum is sorted, orthonormal, and composes to its tensor") {
  check_spectrum<2>();
  check_spectrum<3>();
}

TEST_CASE("eigenvalues that are equal or nearly so do no harm") {
  SymTensor<3> M = SymTensor<3>::isotropic(0.5);
  CHECK(compose(spectrum(M)) == M);
  M.m[1] = 1e-15;
  M.m[4] = -1e-15;
  CHECK(largest_difference(compose(spectrum(M)), M) < 4e-15);
}

TEST_CASE("logarithms of tensors are undone by exponentials and known for diagonal ones") {
  SymTensor<3> D;
  D(0, 0) = 1.0, D(1, 1) = std::exp(2.0), D(2, 2) = std::exp(-3.0);
  const SymTensor<3> L = log_tensor(D);
  CHECK(L(0, 0) == 0.0);
  CHECK(L(1, 1) == Approx(2.0));
  CHECK(L(2, 2) == Approx(-3.0));
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const SymTensor<3> any = random_tensor<3>(random, 3.0);
    CHECK(largest_difference(log_tensor(exp_tensor(any)), any) < 1e-9);
    const SymTensor<2> flat = random_tensor<2>(random, 3.0);
    CHECK(largest_difference(log_tensor(exp_tensor(flat)), flat) < 1e-9);
  }
}

TEST_CASE("only finite tensors with positive eigenvalues are positive definite") {
  SymTensor<3> M = SymTensor<3>::isotropic(2.0);
  CHECK(positive_definite(M));
  M(0, 1) = 0.2499;
  CHECK(positive_definite(M));
  M(0, 1) = 0.2501;
  CHECK_FALSE(positive_definite(M));
  M(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(positive_definite(M));
  CHECK_FALSE(positive_definite(SymTensor<2>{{1.0, 1.01, 1.0}}));  // just beyond
  CHECK(positive_definite(SymTensor<2>{{1.0, 0.99, 1.0}}));
  CHECK_FALSE(positive_definite(SymTensor<2>{}));
  CHECK_FALSE(positive_definite(SymTensor<2>{{std::numeric_limits<double>::infinity(), 0.0, 1.0}}));
}

}  // namespace spectrum_test
