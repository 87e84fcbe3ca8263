#include "pillowmesh/adapt/halving.h"

#include <string>

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/refine/dice.h"

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

namespace {

// A hole of eight facets with four vertices: one edge spans half of it. Made by effort fast from "ring:8,2:0.3,1".
Mesh<2> ring_with_coarse_hole() {
  struct Vertex {
    double x, y;
    Index curve, anchor;  // kNone inside
  };
  constexpr Vertex vertices[] = {{0.0271341, 0.28876069, 0, 1},         {-0.25349582, 0.11227102, 0, 3},
                                 {-0.25317892, -0.11303609, 0, 4},      {0.22757002, 0.17486145, 0, 0},
                                 {0.61929774, 0.04361637, kNone, kNone}, {0.42387108, 0.41191466, kNone, kNone},
                                 {-0.00239872, 0.56981387, kNone, kNone}, {-0.48997005, 0.27959615, kNone, kNone},
                                 {-0.60977993, -0.07886733, kNone, kNone}, {-0.52234208, -0.4015871, kNone, kNone},
                                 {-0.06706438, -0.5092084, kNone, kNone}, {0.381506878, -0.28212934, kNone, kNone},
                                 {1, 0, 1, 15},                         {0.70710678, 0.70710678, 1, 9},
                                 {0, 1, 1, 10},                         {-0.7451692, 0.61521597, 1, 11},
                                 {-1, 0, 1, 12},                        {-0.73240437, -0.64603299, 1, 12},
                                 {0, -1, 1, 14},                        {0.70775349, -0.70554549, 1, 15}};
  struct Quad {
    Corners<2> corners;
    int facet;  // on the boundary, or -1
  };
  constexpr int none = -1;
  const Quad quads[] = {{{6, 7, 0, 1}, 3},    {{5, 6, 3, 0}, 3},    {{3, 11, 5, 4}, none}, {{2, 8, 10, 9}, none},
                        {{2, 10, 3, 11}, 0},  {{1, 7, 2, 8}, 0},    {{4, 12, 5, 13}, 1},   {{5, 13, 6, 14}, 1},
                        {{6, 14, 7, 15}, 1},  {{7, 15, 8, 16}, 1},  {{8, 16, 9, 17}, 1},   {{9, 17, 10, 18}, 1},
                        {{10, 18, 11, 19}, 1}, {{11, 19, 4, 12}, 1}};
  Mesh<2> mesh = std::get<Mesh<2>>(*parse_primitive("ring:8,2:0.3,1"));
  mesh.points.clear(), mesh.support.clear(), mesh.anchor.clear(), mesh.cells.clear(), mesh.twins.clear();
  for (const Vertex& v : vertices) {
    mesh.support.push_back(v.curve == kNone ? VertexSupport{2, kNone} : VertexSupport{1, v.curve});
    mesh.anchor.push_back(v.anchor);
    Point<2> p(v.x, v.y);
    if (v.curve != kNone) p = slide(*mesh.geometry, mesh.support.back(), mesh.anchor.back(), p);
    mesh.points.push_back(p);
  }
  for (const Quad& q : quads) mesh.cells.push_back(q.corners);
  mesh.region.assign(mesh.cells.size(), 0);
  REQUIRE(connect_cells(mesh).ok());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (quads[c].facet != none) mesh.twins[c][quads[c].facet] = ~(c < 6 ? 0 : 1);
  return mesh;
}

}  // namespace

TEST_CASE("dicing and halving refuse a mesh that would lie over itself where an edge spans half of a hole") {
  const Mesh<2> given = ring_with_coarse_hole();
  REQUIRE(validate(given).ok());
  const auto field = *MetricField<2>::from_formula("h = 0.0191 + 0.15*(1 - exp(-((x + 0.542)/0.044)^2))");
  Mesh<2> halved = given, diced = given;
  const Status of_halving = halve_sizes(halved, field), of_dicing = dice(diced, 2);
  INFO(of_halving.message << " / " << of_dicing.message);
  CHECK(validate(halved).ok());
  CHECK(validate(diced).ok());
  CHECK((!of_dicing.ok() && corpus::identical(diced, given)));
  CHECK((!of_halving.ok() && corpus::identical(halved, given)));
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
