#include "pillowmesh/adapt/trace.h"

#include <set>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/adapt/adapter.h"

namespace trace_test {

using namespace pillowmesh;

namespace {

/// A viewer's copy of a mesh.
template <int Dim>
struct Picture {
  std::vector<Point<Dim>> points;
  std::vector<Corners<Dim>> cells;

  explicit Picture(const Mesh<Dim>& mesh) : points(mesh.points), cells(mesh.cells) {}
  friend bool operator==(const Picture&, const Picture&) = default;
};

template <int Dim>
AdaptOptions recorded(Smoothing smoothing, int dice) {
  AdaptOptions options;
  options.method = Method::paper;
  options.smoothing = smoothing;
  options.dice = dice;
  options.max_sweeps = 4;
  options.max_iterations = Dim == 2 ? 30 : 3;
  options.record = true;
  return options;
}

/// Plays a run as it happens, then backwards and forwards again.
template <int Dim>
void check_replay(const Mesh<Dim>& mesh, const char* metric, const AdaptOptions& options) {
  Adapter<Dim> adapter(mesh, *MetricField<Dim>::from_formula(metric), options);
  Picture<Dim> picture(mesh);
  std::vector<Event<Dim>> events;
  std::vector<Picture<Dim>> before;
  for (bool more = true; more;) {
    more = adapter.step();
    for (auto& event : adapter.take_events()) {
      REQUIRE(event.delta.vertices_before == static_cast<Index>(picture.points.size()));
      REQUIRE(event.delta.cells_before == static_cast<Index>(picture.cells.size()));
      for (const auto& e : event.edges)
        for (const VertexId v : e) REQUIRE(v < event.delta.vertices_before);
      before.push_back(picture);
      apply(event.delta, picture.points, picture.cells);
      events.push_back(std::move(event));
    }
    REQUIRE(picture.points == adapter.mesh().points);
    REQUIRE(picture.cells == adapter.mesh().cells);
  }
  REQUIRE(events.size() > 4);
  for (std::size_t i = events.size(); i-- > 0;) {
    revert(events[i].delta, picture.points, picture.cells);
    REQUIRE(picture == before[i]);
  }
  CHECK(picture == Picture<Dim>(mesh));
  for (const auto& event : events) apply(event.delta, picture.points, picture.cells);
  CHECK(picture.points == adapter.mesh().points);
  CHECK(picture.cells == adapter.mesh().cells);
}

}  // namespace

TEST_CASE("a run can be played forwards and backwards to the last bit") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    check_replay<2>(mesh, "h = 0.05 + 0.3*abs(x - 0.4)", recorded<2>(Smoothing::end, 1));
    check_replay<2>(mesh, "h = 0.05 + 0.3*abs(x - 0.4)", recorded<2>(Smoothing::between, 1));
    check_replay<2>(mesh, "h1 = 0.06; h2 = 0.1 + 0.1*y^2", recorded<2>(Smoothing::end, 2));
  }
  check_replay<3>(make_grid<3>({3, 3, 3}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)), "h = 0.15 + 0.2*z",
                  recorded<3>(Smoothing::end, 1));
}

TEST_CASE("events of one layer come as layer, shrink and connect, and agree with each other") {
  const auto mesh = corpus::star(5, 3);
  Adapter<2> adapter(mesh, *MetricField<2>::from_formula("h = 0.05 + 0.2*abs(x)"), recorded<2>(Smoothing::none, 1));
  (void)adapter.run();
  const auto events = adapter.take_events();
  CHECK(adapter.take_events().empty());
  int iteration = 0;
  std::int64_t layers = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto& e = events[i];
    CHECK(e.iteration >= iteration);
    iteration = e.iteration;
    if (e.kind == EventKind::tags) CHECK_FALSE(e.edges.empty());
    if (e.kind != EventKind::layer) continue;
    ++layers;
    REQUIRE(i + 2 < events.size());
    const auto &shrink = events[i + 1], &connect = events[i + 2];
    REQUIRE(shrink.kind == EventKind::shrink);
    REQUIRE(connect.kind == EventKind::connect);
    CHECK_FALSE(e.edges.empty());
    CHECK_FALSE(e.cells.empty());
    CHECK(connect.cells.size() == e.hull.size());  // one new cell per hull facet
    CHECK(connect.delta.cells_after - connect.delta.cells_before == static_cast<Index>(e.hull.size()));
    CHECK(shrink.delta.cells_after == shrink.delta.cells_before);
    CHECK(connect.delta.vertices_after == connect.delta.vertices_before);
    // New vertices leave vertices of the hull.
    std::set<VertexId> hull;
    for (const auto& f : e.hull) hull.insert(f.begin(), f.end());
    CHECK(shrink.delta.vertices_after - shrink.delta.vertices_before >= static_cast<Index>(hull.size()) - 2);
    for (const CellId c : e.cells) CHECK(c < shrink.delta.cells_before);
  }
  CHECK(layers == adapter.operations().at("layers"));
}

TEST_CASE("nothing is recorded unless asked for") {
  AdaptOptions options = recorded<2>(Smoothing::end, 1);
  options.record = false;
  Adapter<2> adapter(corpus::ell(4), *MetricField<2>::from_formula("h = 0.1"), options);
  (void)adapter.run();
  CHECK(adapter.take_events().empty());
}

TEST_CASE("a delta that moves a vertex and adds a cell can be undone") {
  std::vector<Point<2>> points{Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1), Point<2>(1, 1)};
  std::vector<Corners<2>> cells{{0, 1, 2, 3}};
  const auto old_points = points;
  const auto old_cells = cells;
  MeshDelta<2> delta;
  delta.vertices_before = 4;
  delta.vertices_after = 5;
  delta.cells_before = 1;
  delta.cells_after = 2;
  delta.vertices = {1, 4};
  delta.old_points = {Point<2>(1, 0), Point<2>(1, 1)};
  delta.new_points = {Point<2>(2, 0), Point<2>(2, 2)};
  delta.cells = {1};
  delta.old_corners = {{kNone, kNone, kNone, kNone}};
  delta.new_corners = {{1, 4, 3, 2}};
  apply(delta, points, cells);
  REQUIRE(points.size() == 5);
  CHECK(points[1] == Point<2>(2, 0));
  CHECK(points[4] == Point<2>(2, 2));
  REQUIRE(cells.size() == 2);
  CHECK(cells[1][1] == 4);
  revert(delta, points, cells);
  CHECK(points == old_points);
  CHECK(cells == old_cells);
}

TEST_CASE("every kind of event has a name of its own") {
  std::set<std::string_view> names;
  for (const EventKind kind : {EventKind::tags, EventKind::layer, EventKind::shrink, EventKind::connect,
                               EventKind::dice, EventKind::relocation, EventKind::iteration})
    names.insert(to_string(kind));
  CHECK(names.size() == 7);
  CHECK(names.count("") == 0);
}

}  // namespace trace_test
