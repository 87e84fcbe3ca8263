#include "pillowmesh/adapt/outlook.h"

#include <random>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/coarsen/diagonal_collapse.h"
#include "pillowmesh/coarsen/partial_chord_collapse.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/reconnect/open.h"
#include "pillowmesh/reconnect/partial_chord_split.h"
#include "pillowmesh/reconnect/rotate.h"

namespace outlook_test {

using namespace pillowmesh;

namespace {

/// Changes tried and kept, with better odds than one in ten and with worse.
struct Tally {
  int tried[2] = {0, 0}, kept[2] = {0, 0};
  void add(double odds, bool change_kept) {
    const int poor = odds < -2.2 ? 1 : 0;
    ++tried[poor];
    kept[poor] += change_kept ? 1 : 0;
  }
  [[nodiscard]] double share(int poor) const { return static_cast<double>(kept[poor]) / std::max(tried[poor], 1); }
};

}  // namespace

TEST_CASE("changes with poor odds are hardly ever kept, and most changes have poor odds") {
  auto mesh = make_grid<2>({14, 14}, Point<2>(0, 0), Point<2>(1, 1));
  Background metric(*MetricField<2>::from_formula("h1 = 0.05 + 0.1*x; h2 = 0.06 + 0.05*y; theta = y"), Point<2>(0, 0),
                    Point<2>(1, 1));
  Trial trial(mesh, metric, {.alignment = 0.3});
  Outlook outlook(mesh, trial);
  std::mt19937 random(3);
  Tally rotations, collapses, openings, parts;
  for (int i = 0; i < 50'000; ++i) {
    const CellId c = static_cast<CellId>(random() % mesh.cells.size());
    if (!mesh.alive(c)) continue;
    const int side = static_cast<int>(random() % 4), way = static_cast<int>(random() % 2);
    const double allowed = 0.3 * (random() / 4294967296.0);
    if (i % 1000 == 0) outlook.forget();
    const int kind = i % 4;
    if (kind == 0) {
      const HalfFacetId twin = twin_of_side(mesh, c, side);
      if (twin < 0) continue;
      const CellId n = mesh.cell_of(twin);
      const int j = kFacetSide[mesh.facet_of(twin)];
      const VertexId a = around(mesh, c, side), b = around(mesh, c, side + 1);
      const VertexId p = around(mesh, c, side + 2 + way), r = around(mesh, n, j + 2 + way);
      const int excess = outlook.excess(a, -1) + outlook.excess(b, -1) + outlook.excess(p, 1) + outlook.excess(r, 1);
      const double odds = outlook.rotation(c, side, n, j, way, excess, allowed);
      if (plan_rotation(mesh, c, side, way, trial.cavity)) rotations.add(odds, trial.attempt(Operator::rotate, allowed));
    } else if (kind == 1) {
      const VertexId drop = around(mesh, c, side), keep = around(mesh, c, side + 2);
      const int after = outlook.valence(drop) + outlook.valence(keep) - 2 - trial.ideal(keep);
      const int excess = after * after + outlook.excess(around(mesh, c, side + 1), -1) + outlook.excess(around(mesh, c, side + 3), -1);
      const double odds = outlook.collapse(c, side, excess, allowed);
      if (plan_diagonal_collapse(mesh, c, side, trial.cavity)) collapses.add(odds, trial.attempt(Operator::collapse, allowed));
    } else if (kind == 2) {
      const HalfFacetId ahead = twin_of_side(mesh, c, side + 2);
      if (ahead < 0) continue;
      const CellId n = mesh.cell_of(ahead);
      const int j = kFacetSide[mesh.facet_of(ahead)];
      const auto& r = trial.relocator;
      const int excess = 2 + outlook.excess(around(mesh, c, side + way), -1) + outlook.excess(around(mesh, n, j + 2 + way), -1);
      const double rung = r.edge(n, j).l;
      const double sides = 0.25 * (r.edge(c, side + 1).l + r.edge(c, side + 3).l + r.edge(n, j + 1).l + r.edge(n, j + 3).l);
      const double odds = Outlook::partial_collapse(2, excess, allowed, rung, sides);
      if (plan_partial_chord_collapse(mesh, {{c, side}, {n, j}}, way, trial.cavity))
        parts.add(odds, trial.attempt(Operator::partial_chord_collapse, allowed));
    } else {
      const VertexId v = around(mesh, c, side);
      OrderedStar star;
      if (mesh.support[v].dim != 2 || !find_star(mesh, v, star) || star.count < 4) continue;
      const int first = static_cast<int>(random() % star.count), last = first + 2;
      const int excess = 2 + (star.count - 5) * (star.count - 5);
      const double odds = outlook.opening(star, first, last, excess, allowed);
      if (plan_opening(mesh, v, star, first, last, trial.cavity)) openings.add(odds, trial.attempt(Operator::open, allowed));
    }
  }
  REQUIRE(validate(mesh).ok());
  for (const Tally& tally : {rotations, collapses, openings, parts}) {
    INFO(tally.tried[0] << " tried and " << tally.kept[0] << " kept; of those with poor odds " << tally.tried[1] << " and "
                        << tally.kept[1]);
    CHECK(tally.tried[1] > 2 * tally.tried[0]);
    CHECK(tally.share(1) < 0.03);
    CHECK(tally.share(0) > 5.0 * tally.share(1));
  }
}

TEST_CASE("the outlook counts the cells at a vertex anew where a change was kept") {
  auto mesh = make_grid<2>({6, 6}, Point<2>(0, 0), Point<2>(1, 1));
  Background metric(*MetricField<2>::from_formula("h = 1/6"), Point<2>(0, 0), Point<2>(1, 1));
  Trial trial(mesh, metric, {});
  Outlook outlook(mesh, trial);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) CHECK(outlook.excess(v, 0) == 0);
  REQUIRE(plan_rotation(mesh, 14, 0, 0, trial.cavity));
  const auto around_it = trial.cavity.around;
  REQUIRE(trial.attempt(Operator::rotate, 100.0));
  int irregular = 0;
  for (const VertexId v : around_it) irregular += outlook.valence(v) != 4;
  CHECK(irregular == 4);
}

TEST_CASE("part of a row is put in where cells are wide, taken out where they are narrow, and left alone between") {
  // Cells twelve to the unit; what their height is in the metric.
  for (const double height : {1.5, 1.0, 0.5}) {
    INFO("height " << height);
    auto mesh = make_grid<2>({12, 12}, Point<2>(0, 0), Point<2>(1, 1));
    Background metric(*MetricField<2>::from_formula("h1 = 1/12; h2 = 1/12/" + std::to_string(height)), Point<2>(0, 0),
                      Point<2>(1, 1));
    Trial trial(mesh, metric, {});
    const int row = 6 * 12;
    const VertexId first = 6 * 13 + 4;
    const std::vector<VertexId> path{first, first + 1, first + 2, first + 3};
    REQUIRE(plan_partial_chord_split(mesh, path, 0, trial.cavity));
    CHECK(trial.attempt(Operator::partial_chord_split, 0.0) == (height > 1.2));
    CHECK((Outlook::partial_split(3, 2, 0.0, height, 1.0) > -2.2) == (height > 1.2));
    if (height > 1.2) continue;
    REQUIRE(plan_partial_chord_collapse(mesh, {{row + 4, 3}, {row + 5, 3}, {row + 6, 3}}, 1, trial.cavity));
    CHECK(trial.attempt(Operator::partial_chord_collapse, 0.0) == (height < 0.8));
    CHECK((Outlook::partial_collapse(3, 2, 0.0, height, 1.0) > -2.2) == (height < 0.8));
    CHECK(validate(mesh).ok() == true);
  }
}

}  // namespace outlook_test
