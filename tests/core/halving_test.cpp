#include "pillowmesh/adapt/halving.h"

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/metric/length.h"

using namespace pillowmesh;

TEST_CASE("halving makes four valid cells of each, on the boundary, in any mesh and metric") {
  for (const auto& [name, initial] : corpus::meshes<2>())
    for (const char* text : {"h = 0.1", "h1 = 0.01 + 0.3*abs(x - 0.3); h2 = 0.2; theta = y", "h = if(x < 0.4, 0.001, 1)"}) {
      INFO(name << ", " << text);
      Mesh<2> mesh = initial;
      const auto field = *MetricField<2>::from_formula(text);
      REQUIRE(halve_sizes(mesh, field).ok());
      CHECK(mesh.cell_count() == 4 * initial.cell_count());
      CHECK(checks::euler(mesh) == checks::euler(initial));
      CHECK(checks::distance_from_geometry(mesh) < 1e-12);
      const Status valid = validate(mesh);
      INFO(valid.message);
      CHECK(valid.ok());
    }
}

TEST_CASE("halving divides edges where both parts have the same metric length") {
  // Sizes grow threefold along each cell: even halves would differ by a factor of 1.7.
  const auto field = *MetricField<2>::from_formula("h = 0.1*3^(4*x)");
  Mesh<2> mesh = make_grid<2>({4, 2}, Point<2>(0, 0), Point<2>(1, 1));
  REQUIRE(halve_sizes(mesh, field).ok());
  for (CellId c = 0; c < mesh.cell_count(); c += 4) {
    const VertexId a = mesh.cells[c][0], m = mesh.cells[c][1], b = mesh.cells[c + 1][1];
    const double first = edge_length(field, mesh.points[a], mesh.points[m]);
    const double second = edge_length(field, mesh.points[m], mesh.points[b]);
    CHECK(first == Approx(second).epsilon(0.05));
  }
}
