#include "pillowmesh/adapt/trial.h"

#include <algorithm>
#include <limits>
#include <random>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/adapt/local_search.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/reconnect/rotate.h"

namespace trial_test {

using namespace pillowmesh;

namespace {

constexpr const char* kMetric = "h1 = 0.2 + 0.1*abs(x - 0.4); h2 = 0.3; theta = 0.3*y";

Background background(const Mesh<2>& mesh) {
  Point<2> low = mesh.points[0], high = low;
  for (const auto& p : mesh.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return {*MetricField<2>::from_formula(kMetric), low, high};
}

/// Moves each interior vertex somewhere inside the box of its neighbours, where that leaves the mesh valid.
void crumple(Mesh<2>& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<CellCorner> star;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.support[v].dim != 2) continue;
    vertex_star(mesh, v, star);
    Point<2> low = mesh.points[v], high = low;
    for (const CellCorner& c : star)
      for (int k = 0; k < 4; ++k) {
        low = low.cwiseMin(mesh.points[mesh.cells[c.cell][k]]);
        high = high.cwiseMax(mesh.points[mesh.cells[c.cell][k]]);
      }
    const Point<2> old = mesh.points[v];
    for (int d = 0; d < 2; ++d) mesh.points[v][d] = low[d] + (high[d] - low[d]) * (random() / 4294967296.0);
    if (!validate(mesh).ok()) mesh.points[v] = old;
  }
}

double energy_anew(Trial& trial) {
  trial.relocator.measure_all(trial.relocator.weights());
  return trial.relocator.total_energy();
}

}  // namespace

TEST_CASE("shapes are mended where they are poor, and energies know of it") {
  std::size_t before = 0, after = 0;
  for (const unsigned seed : {1u, 2u, 3u})
    for (const auto& [name, given] : corpus::meshes<2>()) {
      INFO(name << ", seed " << seed);
      Mesh<2> mesh = given;
      crumple(mesh, seed);
      Background sizes = background(mesh);
      Trial trial(mesh, sizes, {});
      before += trial.relocator.cells_below(0.5).size();
      trial.mend_shapes(0.5);
      after += trial.relocator.cells_below(0.5).size();
      CHECK(validate(mesh).ok());
      const double energy = trial.relocator.total_energy();
      CHECK(energy_anew(trial) == Approx(energy));
      CHECK(trial.relocator.weights().shape == 0.0);
    }
  CHECK(before > 100);
  CHECK(3 * after < before);
}

TEST_CASE("shapes are left as they are where an edge would become too long") {
  for (const auto& [name, given] : corpus::meshes<2>()) {
    INFO(name);
    Mesh<2> mesh = given;
    crumple(mesh, 1);
    Background sizes = background(mesh);
    Trial trial(mesh, sizes, {});
    const Mesh<2> crumpled = mesh;
    const double energy = trial.relocator.total_energy();
    trial.longest_allowed = 0.0;
    trial.mend_shapes(0.5);
    CHECK(corpus::identical(mesh, crumpled));
    CHECK(trial.relocator.total_energy() == energy);
  }
}

TEST_CASE("sweeps and mending leave alone what is not touched, and say what they and changes have moved") {
  for (const auto& [name, given] : corpus::meshes<2>()) {
    INFO(name);
    Mesh<2> mesh = given;
    crumple(mesh, 2);
    const Mesh<2> crumpled = mesh;
    Background sizes = background(mesh);
    Trial trial(mesh, sizes, {});
    std::vector<VertexId> some;
    for (VertexId v = 0; v < mesh.vertex_count(); v += 3) some.push_back(v);
    trial.touch_only(some);
    trial.begin_sweep();
    trial.sweep(0, mesh.cell_count());
    int moved = 0;
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      CHECK(trial.touched(v) == (v % 3 == 0));
      if (v % 3 != 0) CHECK(mesh.points[v] == crumpled.points[v]);
      moved += mesh.points[v] != crumpled.points[v];
    }
    CHECK((moved > 0 || mesh.vertex_count() < 30));
    trial.touch_only({});
    const Mesh<2> swept = mesh;
    trial.mend_shapes(0.9);
    trial.begin_sweep();
    CHECK(trial.sweep(0, mesh.cell_count()) == 0.0);
    CHECK(corpus::identical(mesh, swept));
    const auto moved_are_touched = [&] {
      for (VertexId v = 0; v < static_cast<VertexId>(swept.points.size()); ++v)
        if (mesh.points[v] != swept.points[v]) CHECK(trial.touched(v));
    };
    trial.touch_only(std::vector<VertexId>{some[some.size() / 2]});
    trial.mend_shapes(0.9);
    moved_are_touched();
    LocalSearch search(mesh, trial, 1);
    for (search.begin_pass(0.2); search.continue_pass(1000);) {}
    moved_are_touched();
    trial.touch_all();
    CHECK(trial.touched(1));
  }
}

TEST_CASE("vertices that are not touched have their valences all the same") {
  Mesh<2> mesh = make_grid<2>({6, 6}, Point<2>(0, 0), Point<2>(1, 1));
  Background sizes = background(mesh);
  Trial trial(mesh, sizes, {});
  trial.touch_only({});
  Outlook outlook(mesh, trial);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) CHECK(outlook.valence(v) == trial.ideal(v));
}

TEST_CASE("no change is kept that leaves a longer edge than is allowed") {
  Mesh<2> mesh = make_grid<2>({12, 12}, Point<2>(0, 0), Point<2>(1, 1));
  const Mesh<2> given = mesh;
  Background sizes = background(mesh);
  const auto kept = [&](double longest) {
    Trial trial(mesh, sizes, {});
    LocalSearch search(mesh, trial, 1);
    trial.longest_allowed = longest;
    for (int pass = 0; pass < 3; ++pass)
      for (search.begin_pass(0.0); search.continue_pass(1000);) {}
    std::int64_t count = 0;
    for (const Trial::Count& c : trial.counts) count += c.kept;
    CHECK(validate(mesh).ok());
    return count;
  };
  CHECK(kept(0.1) == 0);
  CHECK(corpus::identical(mesh, given));
  double longest = 0.0;
  {
    Trial trial(mesh, sizes, {});
    for (CellId c = 0; c < mesh.cell_count(); ++c)
      for (int side = 0; side < 4; ++side) longest = std::max(longest, trial.relocator.edge(c, side).l);
  }
  CHECK(kept(1.5 * longest) > 0);
  Trial after(mesh, sizes, {});
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int side = 0; mesh.alive(c) && side < 4; ++side) CHECK(after.relocator.edge(c, side).l < 1.5 * longest * 1.02);
  mesh = given;
  CHECK(kept(std::numeric_limits<double>::infinity()) > 10);
}

TEST_CASE("a pass over the cells with much energy tries nothing where there are none") {
  const auto tried = [](double above) {
    Mesh<2> mesh = make_grid<2>({12, 12}, Point<2>(0, 0), Point<2>(1, 1));
    Background sizes = background(mesh);
    Trial trial(mesh, sizes, {});
    LocalSearch search(mesh, trial, 1);
    double largest = 0.0;
    for (CellId c = 0; c < mesh.cell_count(); ++c) largest = std::max(largest, trial.relocator.energy(c));
    for (search.begin_pass(0.0, above * largest); search.continue_pass(1000);) {}
    std::int64_t count = 0;
    for (const Trial::Count& c : trial.counts) count += c.tried;
    return count;
  };
  CHECK(tried(1.001) == 0);
  CHECK(tried(0.9) > 0);
}

TEST_CASE("in hot passes crowded cells are only collapsed, in cold ones everything is tried") {
  struct Tries {
    std::int64_t all, collapses;
  };
  const auto tries = [](double crowded, double temperature) -> Tries {
    Mesh<2> mesh = make_grid<2>({24, 24}, Point<2>(0, 0), Point<2>(1, 1));  // areas of .02 to .04
    Background sizes = background(mesh);
    Trial trial(mesh, sizes, {});
    LocalSearch search(mesh, trial, 1);
    search.crowded_area = crowded;
    search.begin_pass(temperature);
    search.continue_pass(200);
    Tries t{0, 0};
    for (const Trial::Count& c : trial.counts) t.all += c.tried;
    for (const Operator op : {Operator::collapse, Operator::boundary_collapse, Operator::partial_chord_collapse})
      t.collapses += trial.counts[static_cast<int>(op)].tried;
    return t;
  };
  const Tries some = tries(0.5, 0.2), all = tries(0.0, 0.2), cold = tries(0.5, 0.0);
  CHECK(some.all > 5);
  CHECK(some.collapses == some.all);
  CHECK(all.collapses < all.all);
  CHECK(cold.all == tries(0.0, 0.0).all);
}

TEST_CASE("a change that may be kept at once is relaxed as often as it has to be, and no more") {
  const auto moves = [](int least_sweeps) {
    Mesh<2> mesh = make_grid<2>({12, 12}, Point<2>(0, 0), Point<2>(1, 1));
    Background sizes = background(mesh);
    Trial trial(mesh, sizes, {});
    trial.least_sweeps = least_sweeps;
    REQUIRE(plan_rotation(mesh, 60, 1, 0, trial.cavity));
    CHECK(trial.attempt(Operator::rotate, 100.0));  // whatever it costs
    CHECK(validate(mesh).ok());
    return trial.moves;
  };
  CHECK(moves(1) < moves(2));
  CHECK(moves(2) < moves(3));
}

}  // namespace trial_test
