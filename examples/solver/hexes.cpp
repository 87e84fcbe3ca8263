// The same solver on hexahedra: the error of Poisson's equation on meshes of 4 x 4 x 4, 8 x 8 x 8 and 16 x 16 x 16
// cells, and where streamline upwinding keeps a boundary layer free of wiggles.
#include <pillowmesh/mesh/primitives.h>

#include <cmath>
#include <cstdio>

#include "q1.h"

using namespace pillowmesh;

int main() {
  solver::Problem<3> wave;
  const auto exact = [](const Point<3>& p) { return std::sin(2 * p[0]) * std::cos(p[1]) * std::exp(p[2]); };
  wave.boundary = exact;
  wave.source = [&](const Point<3>& p) { return 4 * exact(p); };  // -Lap = (4 + 1 - 1) u
  double before = 0.0;
  bool second_order = true;
  for (const int n : {4, 8, 16}) {
    const auto mesh = make_grid<3>({n, n, n}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
    const double error = solver::l2_error<3>(mesh, solver::solve(mesh, wave), exact);
    std::printf("%5d hexahedra: L2 error %.3e\n", n * n * n, error);
    if (before > 0) second_order = second_order && error < before / 3.5;
    before = error;
  }
  solver::Problem<3> flow;
  flow.diffusion = 1e-3;
  flow.velocity = [](const Point<3>&) { return Point<3>(1, 0, 0); };
  flow.source = [](const Point<3>&) { return 1.0; };
  flow.boundary = [](const Point<3>& p) { return p[0] < 1 ? p[0] : 0.0; };
  const auto mesh = make_grid<3>({10, 4, 4}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  double most = 0.0;
  for (const double u : solver::solve(mesh, flow)) most = std::max(most, u);
  std::printf("layer thinner than a cell: largest value %.3f, without wiggles at most 1\n", most);
  return second_order && most < 1.02 ? 0 : 1;
}
