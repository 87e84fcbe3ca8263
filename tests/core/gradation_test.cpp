#include "pillowmesh/metric/gradation.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "../catch.h"
#include "pillowmesh/metric/intersection.h"
#include "pillowmesh/metric/spectrum.h"

namespace gradation_test {

using namespace pillowmesh;

namespace {

template <int Dim>
NodalMetric<Dim> grid(int n) {
  std::array<int, Dim> count;
  count.fill(n);
  return nodal_grid<Dim>(count, Point<Dim>::Zero(), Point<Dim>::Ones());
}

template <int Dim>
void check_random(int fields, int n) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> any(-4.0, 4.0), growth(1.05, 3.0);
  for (int i = 0; i < fields; ++i) {
    NodalMetric<Dim> m = grid<Dim>(n);
    for (auto& M : m.tensors) {
      for (double& entry : M.m) entry = any(random);
      for (int d = 0; d < Dim; ++d) M(d, d) += 5.0;
      M = exp_tensor(M);
    }
    const NodalMetric<Dim> before = m;
    const double g = growth(random);
    CHECK(limit_gradation(m, g) > 0);
    const auto once = m.tensors;
    const auto finest = [](const auto& tensors) {
      double most = 0.0;
      for (const auto& M : tensors) most = std::max(most, spectrum(M).value[Dim - 1]);
      return most;
    };
    CHECK(finest(once) <= (1.0 + 1e-9) * finest(before.tensors));
    CHECK(limit_gradation(m, g) == 0);
    CHECK(m.tensors == once);
    for (std::size_t v = 0; v < once.size(); ++v) {
      CHECK(positive_definite(once[v]));
      CHECK(dominated(before.tensors[v], (1.0 + 1e-6) * once[v] + 1e-9 * SymTensor<Dim>::isotropic(1.0)));
    }
  }
}

}  // namespace

TEST_CASE("gradation ends on random fields, leaves nothing to do, and makes no size larger") {
  check_random<2>(900, 5);
  check_random<3>(100, 2);
}

TEST_CASE("an isotropic spike spreads at the growth that is asked for") {
  // In one dimension of size: from h the next cell's size is h * growth, so h = h0 + ln(growth) * distance.
  NodalMetric<2> m = nodal_grid<2>({100, 1}, {0.0, 0.0}, {1.0, 0.01});
  for (auto& M : m.tensors) M = SymTensor<2>::isotropic(10.0);
  m.tensors[0] = SymTensor<2>::isotropic(0.01);
  limit_gradation(m, 1.3);
  for (int i = 0; i <= 100; ++i) {
    const double h = 1.0 / std::sqrt(m.tensors[i].m[0]);
    CHECK(h == Approx(0.01 + std::log(1.3) * i / 100.0).epsilon(0.03));
    CHECK(m.tensors[i].m[2] == Approx(m.tensors[i].m[0]).epsilon(0.03));
  }
}

TEST_CASE("a stretched pattern stays as stretched as it was") {
  // Cells 100 times as long as wide along x, in a strip around y = 1/2, that grow linearly in y alone.
  NodalMetric<2> m = grid<2>(64);
  const auto across = [](double y) { return 0.005 + 0.2 * std::fabs(y - 0.5); };
  for (std::size_t v = 0; v < m.points.size(); ++v) {
    const double h = across(m.points[v][1]);
    m.tensors[v] = {{1.0 / 0.25, 0.0, 1.0 / (h * h)}};
  }
  const auto before = m.tensors;
  limit_gradation(m, 1.25);  // ln 1.25 = 0.223: the field is graded as it is
  double worst = 0.0;
  for (std::size_t v = 0; v < before.size(); ++v)
    worst = std::max(worst, std::sqrt(m.tensors[v].m[0] / before[v].m[0]));  // by how much the long side shrank
  CHECK(worst < 1.05);
  // And where the strip ends abruptly, it is continued as a strip, not as a disc of small cells.
  for (std::size_t v = 0; v < m.points.size(); ++v)
    m.tensors[v] = m.points[v][0] < 0.5 ? before[v] : SymTensor<2>::isotropic(0.5);
  limit_gradation(m, 1.25);
  const auto& behind = m.tensors[32 * 65 + 34];  // (34/64, 1/2)
  CHECK(std::sqrt(behind.m[2] / behind.m[0]) > 10.0);
}

}  // namespace gradation_test
