#include "problems.h"

#include <cmath>

namespace solver {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::string square(int n) { return "grid:" + std::to_string(n) + "," + std::to_string(n) + ":0,1,0,1"; }
std::string ell(int n) { return "lprism:" + std::to_string(n) + "," + std::to_string(n / 2) + ":2,1"; }

Known shock() {
  constexpr double steep = 60.0, bend = 0.1;
  Known k{"shock", "Interior shock", {}, {}, square};
  const auto phase = [](const Point<2>& p) { return steep * (p[0] - 0.5 - bend * std::sin(2 * kPi * p[1])); };
  k.exact = [phase](const Point<2>& p) { return std::tanh(phase(p)); };
  k.problem.boundary = k.exact;
  k.problem.source = [phase](const Point<2>& p) {
    const double t = std::tanh(phase(p)), slope = 2 * kPi * bend * std::cos(2 * kPi * p[1]);
    const double gradient2 = steep * steep * (1 + slope * slope);
    const double laplacian = steep * 4 * kPi * kPi * bend * std::sin(2 * kPi * p[1]);
    return -(1 - t * t) * (laplacian - 2 * t * gradient2);
  };
  return k;
}

Known layer() {
  constexpr double eps = 0.01;
  Known k{"layer", "Boundary layer", {}, {}, square};
  // - eps g'' + g' = 1, g(0) = g(1) = 0
  const auto g = [](double s) {
    const double least = std::exp(-1 / eps);
    return s - (std::exp((s - 1) / eps) - least) / (1 - least);
  };
  k.exact = [g](const Point<2>& p) { return g(p[0]) * g(p[1]); };
  k.problem.diffusion = eps;
  k.problem.velocity = [](const Point<2>&) { return Point<2>(1, 1); };
  k.problem.source = [g](const Point<2>& p) { return g(p[0]) + g(p[1]); };
  k.problem.boundary = k.exact;
  return k;
}

Known corner() {
  Known k{"corner", "Singular corner", {}, {}, ell};
  k.exact = [](const Point<2>& p) {
    const double x = p[0] - 1, y = p[1] - 1, r = std::hypot(x, y);
    double angle = std::atan2(y, x) - kPi / 2;  // from the upper edge of the corner, counterclockwise
    if (angle < 0) angle += 2 * kPi;
    if (angle > 1.75 * kPi) angle = 0;  // rounding
    return std::pow(r, 2.0 / 3) * std::sin(2.0 / 3 * angle);
  };
  k.problem.boundary = k.exact;
  return k;
}

}  // namespace

std::vector<Known> known_problems() { return {shock(), layer(), corner()}; }

}  // namespace solver
