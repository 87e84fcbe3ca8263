// Adapts a grid to a size given as a formula and writes the mesh: the shortest useful program.
#include <pillowmesh/adapt/adapter.h>
#include <pillowmesh/io/io.h>
#include <pillowmesh/mesh/primitives.h>

#include <cstdio>

using namespace pillowmesh;

int main() {
  const auto field = MetricField<2>::from_formula("h = 0.02 + 0.15*abs(x - 2*y)");
  if (!field) return std::fprintf(stderr, "%s\n", field.status().message.c_str()), 2;

  Adapter<2> adapter(make_grid<2>({8, 8}, Point<2>(0, 0), Point<2>(2, 1)), *field, AdaptOptions{});
  Status status = adapter.run();
  if (status.ok()) status = write_mesh_file(adapter.mesh(), "adapted.vtu");
  if (!status.ok()) return std::fprintf(stderr, "%s\n", status.message.c_str()), 1;
  std::printf("adapted.vtu: %d quads\n", adapter.mesh().cell_count());
}
