// A user's whole program: refine a grid to a formula and count its cells.
#include <pillowmesh/adapt/adapter.h>
#include <pillowmesh/mesh/primitives.h>

#include <cstdio>

int main() {
  const auto field = pillowmesh::MetricField<2>::from_formula("h = 0.1 + 0.2*x");
  if (!field) return 2;
  pillowmesh::Adapter<2> adapter(pillowmesh::make_grid<2>({4, 4}, {0, 0}, {1, 1}), *field, {});
  if (!adapter.run().ok()) return 1;
  std::printf("%d quads\n", adapter.mesh().cell_count());
}
