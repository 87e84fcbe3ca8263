#include "pillowmesh/mesh/overlap.h"

#include <cmath>
#include <utility>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/mesh/smooth_geometry.h"
#include "pillowmesh/mesh/validate.h"

namespace overlap_test {

using namespace pillowmesh;

namespace {

/// Quads around a vertex, `count` of them, over `turns` turns; `closed`: the last is next to the first.
Expected<Mesh<2>> fan(int count, double turns, bool closed) {
  MeshInput<2> in;
  in.points.push_back(Point<2>(0, 0));
  // Further out with each: no two vertices are in one place.
  const auto at = [&](double k) {
    const double angle = 6.283185307179586 * turns * k / count, r = 1.0 + 0.1 * k;
    return Point<2>(r * std::cos(angle), r * std::sin(angle));
  };
  const int spokes = closed ? count : count + 1;
  for (int k = 0; k < spokes; ++k) in.points.push_back(at(k));
  for (int k = 0; k < count; ++k) in.points.push_back(1.4 * at(k + 0.5));
  for (int k = 0; k < count; ++k) in.cells.push_back({0, 1 + k, 1 + (k + 1) % spokes, 1 + spokes + k});
  return make_mesh(in);
}

}  // namespace

TEST_CASE("no mesh of ours lies over itself") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) CHECK_FALSE(folded_at(mesh, v));
    CHECK(find_overlaps<2>(mesh, 10).empty());
    Mesh<2> round = mesh;
    round.geometry = smooth_geometry(std::move(round.geometry));
    for (VertexId v = 0; v < round.vertex_count(); ++v) CHECK_FALSE(folded_at(round, v));
  }
}

TEST_CASE("cells that go around a vertex twice, or on the boundary farther than once, are refused with a sentence") {
  CHECK(fan(6, 1.0, true));
  CHECK(fan(7, 0.9, false));
  for (const auto& twice : {fan(6, 2.0, true), fan(7, 2.0, true), fan(7, 1.2, false)}) {
    REQUIRE_FALSE(twice);
    CHECK(twice.status().message.find("overlap") != std::string::npos);
  }
}

TEST_CASE("a boundary edge that goes back on the curve of its ends is found at both") {
  Mesh<2> ring = std::get<Mesh<2>>(*parse_primitive("ring:8,1:0.3,1"));
  VertexId v = 0;
  while (ring.support[v].dim != 1 || ring.points[v].norm() > 0.5) ++v;
  OrderedStar star;
  REQUIRE(find_star(ring, v, star));
  const VertexId next = around(ring, star.cell[0], star.place[0] + 1);
  CHECK_FALSE(goes_back(ring, v, star));
  // Past its neighbour.
  const Point<2> beyond = 1.5 * ring.points[next] - 0.5 * ring.points[v];
  ring.points[v] = slide(*ring.geometry, ring.support[v], ring.anchor[v], beyond);
  CHECK(goes_back(ring, v, star));
  CHECK(folded_at(ring, next));
}

TEST_CASE("where cells are as large as a hole, it stays a hole") {
  for (const std::uint64_t seed : {1, 2, 3, 19})
    for (const char* text : {"ring:8,3:0.3,1", "ring:5,2:0.2,1"})
      for (const char* formula : {"h = 0.049 + 0.266*abs(x - 0.551)", "h1 = 0.05 + 0.4*abs(y); h2 = 2*h1; theta = x"}) {
        INFO(text << ", " << formula << ", seed " << seed);
        AdaptOptions options;
        options.effort = Effort::fast;
        options.seed = seed;
        Adapter<2> adapter(std::get<Mesh<2>>(*parse_primitive(text)), *MetricField<2>::from_formula(formula), options);
        for (bool more = true; more;) {
          more = adapter.step();
          const Status valid = validate(adapter.mesh());
          INFO(valid.message);
          REQUIRE(valid.ok());
        }
      }
}

}  // namespace overlap_test
