#include "pillowmesh/adapt/schedule.h"

#include <map>
#include <random>
#include <string>
#include <vector>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"

namespace schedule_test {

using namespace pillowmesh;

namespace {

struct Outcome {
  Mesh<2> mesh;
  std::vector<unsigned char> touched;
};

Outcome run(Mesh<2> mesh, Effort effort, const std::vector<VertexId>& mended) {
  AdaptOptions options;
  options.effort = effort;
  Background metric(*MetricField<2>::from_formula("h = 0.03 + 0.1*abs(x - 0.4)"), Point<2>(0, 0), Point<2>(1, 1));
  Recorder<2> recorder(false);
  std::map<std::string, std::int64_t> operations;
  Schedule schedule(mesh, metric, options, true, 0, mended, recorder, operations, 1);
  while (schedule.step()) {
  }
  return {mesh, schedule.touched()};
}

}  // namespace

TEST_CASE("effort fast moves vertices that layers have touched, and those of changes, and no others") {
  Mesh<2> given = make_grid<2>({16, 16}, Point<2>(0, 0), Point<2>(1, 1));
  const unsigned seed = 5;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (VertexId v = 0; v < given.vertex_count(); ++v)
    if (given.support[v].dim == 2)
      for (int d = 0; d < 2; ++d) given.points[v][d] += 0.03 * (random() / 4294967296.0 - 0.5);
  INFO(validate(given).message);
  REQUIRE(validate(given).ok());
  std::vector<VertexId> mended;
  for (VertexId v = 0; v < given.vertex_count(); ++v)
    if (given.points[v].norm() < 0.5) mended.push_back(v);
  const Outcome some = run(given, Effort::fast, mended);
  CHECK(validate(some.mesh).ok());
  REQUIRE(some.touched.size() == some.mesh.points.size());
  for (const VertexId v : mended) CHECK(some.touched[v] != 0);
  int left_alone = 0, moved = 0;
  for (VertexId v = 0; v < given.vertex_count(); ++v) {
    moved += some.mesh.points[v] != given.points[v];
    if (some.touched[v] != 0) continue;
    ++left_alone;
    CHECK(some.mesh.points[v] == given.points[v]);
  }
  CHECK(moved > 20);
  CHECK(left_alone > 50);

  CHECK(run(given, Effort::fast, {}).touched.empty());
  const Outcome normal = run(given, Effort::normal, mended);
  CHECK(normal.touched.empty());
  CHECK(corpus::identical(normal.mesh, run(given, Effort::normal, {}).mesh));
}

}  // namespace schedule_test
