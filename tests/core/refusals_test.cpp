#include "pillowmesh/adapt/refusals.h"

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/adapt/local_search.h"
#include "pillowmesh/mesh/compact.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/reconnect/rotate.h"

namespace refusals_test {

using namespace pillowmesh;

TEST_CASE("a change that was refused is expected to be refused again, but not where it may cost more") {
  Refusals refusals;
  refusals.make_room(100);
  const Refusals::Key key = 0x123456789abcdef0u;
  CHECK_FALSE(refusals.expected(key, -1e9));
  refusals.remember(key, 0.5);
  CHECK(refusals.expected(key, 0.1));
  CHECK_FALSE(refusals.expected(key, 0.5));
  CHECK_FALSE(refusals.expected(key ^ (Refusals::Key{1} << 40), 0.1));
  // What is between is not sure enough, whatever the sign.
  CHECK_FALSE(refusals.expected(key, 0.45));
  refusals.remember(key, -0.2);
  CHECK(refusals.expected(key, -0.3));
  CHECK_FALSE(refusals.expected(key, -0.22));
  refusals.remember(key, std::numeric_limits<double>::infinity());
  CHECK(refusals.expected(key, 1e300));
}

TEST_CASE("refusals take a place each, and no more places than there is room for") {
  Refusals refusals;
  refusals.make_room(50);
  const std::size_t room = refusals.size();
  CHECK(room >= 50);
  std::mt19937_64 random(5);
  std::vector<Refusals::Key> keys(20 * room);
  for (Refusals::Key& key : keys) refusals.remember(key = random(), 1.0);
  CHECK(refusals.size() == room);
  std::size_t remembered = 0;
  for (const Refusals::Key key : keys) remembered += refusals.expected(key, 0.0);
  CHECK(remembered <= room);
  CHECK(remembered > room * 9 / 10);
  refusals.make_room(51);  // not worth forgetting all of them
  CHECK(refusals.expected(keys.back(), 0.0));
  refusals.make_room(100);
  CHECK(refusals.size() >= 100);
  CHECK_FALSE(refusals.expected(keys.back(), 0.0));
  refusals.release();
  CHECK(refusals.size() == 0);
}

TEST_CASE("changes have keys of their own, by what they do and to which vertices") {
  const auto mesh = make_grid<2>({6, 6}, Point<2>(0, 0), Point<2>(1, 1));
  std::vector<Refusals::Key> keys;
  Cavity cavity;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int side = 0; side < 4; ++side) {
      const HalfFacetId twin = twin_of_side(mesh, c, side);
      if (twin < 0 || mesh.cell_of(twin) > c) continue;
      for (int way = 0; way < 2; ++way)
        if (plan_rotation(mesh, c, side, way, cavity)) {
          keys.push_back(Refusals::key(Operator::rotate, cavity));
          CHECK(Refusals::key(Operator::rotate, cavity) == keys.back());
          CHECK(Refusals::key(Operator::collapse, cavity) != keys.back());
        }
    }
  CHECK(keys.size() > 60);
  std::sort(keys.begin(), keys.end());
  CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
}

TEST_CASE("what is expected to be refused hardly ever would be kept, while the mesh around it changes") {
  auto mesh = make_grid<2>({16, 16}, Point<2>(0, 0), Point<2>(1, 1));
  Background metric(*MetricField<2>::from_formula("h1 = 0.05 + 0.08*x; h2 = 0.06 + 0.05*y; theta = y"), Point<2>(0, 0),
                    Point<2>(1, 1));
  Trial trial(mesh, metric, {.alignment = 0.3});
  Refusals refusals;
  refusals.make_room(mesh.cell_count());
  const unsigned seed = 17;
  CAPTURE(seed);
  std::mt19937 random(seed);
  int expected = 0, kept_all_the_same = 0, tried = 0, kept = 0;
  for (int i = 0; i < 30'000; ++i) {
    const CellId c = static_cast<CellId>(random() % mesh.cells.size());
    const int side = static_cast<int>(random() % 4), way = static_cast<int>(random() % 2);
    const double allowed = 0.4 * (random() / 4294967296.0);
    if (i % 2000 == 0) {
      trial.begin_sweep();
      trial.sweep(0, mesh.cell_count());
    }
    if (!mesh.alive(c) || twin_of_side(mesh, c, side) < 0 || !plan_rotation(mesh, c, side, way, trial.cavity)) continue;
    const Refusals::Key key = Refusals::key(Operator::rotate, trial.cavity);
    const bool doubted = refusals.expected(key, allowed), did = trial.attempt(Operator::rotate, allowed);
    if (!did) refusals.remember(key, trial.refused_growth);
    ++tried;
    kept += did;
    expected += doubted;
    kept_all_the_same += doubted && did;
  }
  CAPTURE(tried, kept, expected, kept_all_the_same);
  CHECK(find_defects(mesh).empty());
  CHECK(expected > tried / 5);
  CHECK(kept > 100);
  CHECK(kept_all_the_same < kept / 20);
}

TEST_CASE("hot passes that remember refusals try less than one that begins on the same mesh") {
  auto mesh = make_grid<2>({14, 14}, Point<2>(0, 0), Point<2>(1, 1));
  const auto field = *MetricField<2>::from_formula("h1 = 0.05 + 0.08*x; h2 = 0.06 + 0.05*y; theta = y");
  const auto tries_of_a_pass = [](Trial& trial, LocalSearch& search) {
    const auto tried = [&] {
      std::int64_t sum = 0;
      for (const Trial::Count& count : trial.counts) sum += count.tried;
      return sum;
    };
    const std::int64_t before = tried();
    search.begin_pass(0.1);
    while (search.continue_pass(1000)) {
    }
    return tried() - before;
  };
  Background metric(field, Point<2>(0, 0), Point<2>(1, 1));
  Trial trial(mesh, metric, {});
  LocalSearch search(mesh, trial, 1);
  for (int pass = 0; pass < 12; ++pass) tries_of_a_pass(trial, search);
  Mesh<2> copy = mesh;
  compact(copy);
  Background metric_of_copy(field, Point<2>(0, 0), Point<2>(1, 1));
  Trial trial_of_copy(copy, metric_of_copy, {});
  LocalSearch fresh(copy, trial_of_copy, 1);
  CHECK(tries_of_a_pass(trial, search) * 4 < tries_of_a_pass(trial_of_copy, fresh) * 3);
  CHECK(find_defects(mesh).empty());
}

}  // namespace refusals_test
