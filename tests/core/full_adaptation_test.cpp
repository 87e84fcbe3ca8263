#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/io/io.h"
#include "pillowmesh/mesh/compact.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/quality/report.h"
#include "shared_data.h"

namespace full_adaptation_test {

using namespace pillowmesh;

namespace {

MetricField<2> formula(const std::string& text) { return *MetricField<2>::from_formula(text); }

AdaptOptions with(Effort effort) {
  AdaptOptions options;
  options.effort = effort;
  return options;
}

Mesh<2> adapted(const Mesh<2>& mesh, const MetricField<2>& field, const AdaptOptions& options) {
  Adapter<2> adapter(mesh, field, options);
  const Status outcome = adapter.run();
  INFO(outcome.message);
  CHECK(outcome.ok());
  Mesh<2> out = adapter.mesh();
  compact(out);
  return out;
}

Report run_case(const char* name, const AdaptOptions& options) {
  const Case* c = find_case(name);
  const auto field = formula(std::string(c->formula));
  return measure(adapted(std::get<Mesh<2>>(*parse_primitive(c->mesh)), field, options), field);
}

}  // namespace

TEST_CASE("every mesh of full adaptation is valid, on its boundary, and its groups keep their length") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    const auto field = formula("h1 = 0.08 + 0.2*abs(x - 0.3); h2 = 0.2; theta = 0.5*y");
    Adapter<2> adapter(mesh, field, with(Effort::fast));
    const Index euler = checks::euler(mesh);
    for (bool more = true; more;) {
      more = adapter.step();
      const Status valid = validate(adapter.mesh());
      INFO(valid.message);
      REQUIRE(valid.ok());
    }
    Mesh<2> result = adapter.mesh();
    compact(result);
    CHECK(checks::euler(result) == euler);
    CHECK(checks::distance_from_geometry(result) < 1e-12);
  }
}

TEST_CASE("full adaptation with effort normal meets sizes and shapes that refinement alone cannot") {
  // Gates of docs/results.md with some room; the paper's refinement has l cv .279, .029, .321 and shapes .79, .99, .74.
  const Report iso = run_case("iso2d", with(Effort::normal));
  CHECK(iso.valid);
  CHECK(iso.edge_length.cv < 0.11);
  CHECK(iso.shape.mean > 0.86);
  CHECK(iso.shape.min > 0.4);
  CHECK(iso.cells < 1.08 * iso.complexity);
  const Report aniso = run_case("aniso2d", with(Effort::normal));
  CHECK(aniso.edge_length.cv < 0.10);
  CHECK(aniso.shape.mean > 0.96);
  CHECK(aniso.irregular_vertices == 0);
  CHECK(aniso.cells == Approx(aniso.complexity).epsilon(0.05));
  const Report circle = run_case("circle2d", with(Effort::normal));
  CHECK(circle.edge_length.cv < 0.125);
  CHECK(circle.shape.mean > 0.845);
  CHECK(circle.shape.min > 0.4);
  CHECK(circle.edge_length.share_in_range > 0.98);
  CHECK(circle.misalignment < 0.22);
}

TEST_CASE("full adaptation with effort fast leaves no cell out of shape, and no edge too long") {
  for (const char* name : {"iso2d", "circle2d"})
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
      INFO(name << ", seed " << seed);
      AdaptOptions options = with(Effort::fast);
      options.seed = seed;
      const Report r = run_case(name, options);
      CHECK(r.shape.min > 0.3);  // without mending 0.1 and less in iso2d
      CHECK(r.shape.mean > 0.8);
      CHECK(r.edge_length.cv < 0.2);
      CHECK(r.edge_length.max < 1.01 * options.threshold);
    }
}

TEST_CASE("where the metric kinks, passes take longer, and there are fewer of them") {
  const auto moves_of_each_cell = [](const char* name) {
    const Case* c = find_case(name);
    Adapter<2> adapter(std::get<Mesh<2>>(*parse_primitive(c->mesh)), formula(std::string(c->formula)), with(Effort::best));
    CHECK(adapter.run().ok());
    Mesh<2> out = adapter.mesh();
    compact(out);
    return static_cast<double>(adapter.operations().at("relocations")) / out.cell_count();
  };
  CHECK(moves_of_each_cell("shock2d") < 900.0);
  CHECK(moves_of_each_cell("aniso2d") < 600.0);  // here passes come to an end before moves do
}

TEST_CASE("a coarse mesh is adapted to larger sizes first and diced; one that fits the metric is not") {
  const auto field = formula("h = 0.03 + 0.02*abs(x)");
  const auto dices = [&](Effort effort, const Mesh<2>& mesh, Mesh<2>& result) {
    AdaptOptions options = with(effort);
    options.record = true;
    Adapter<2> adapter(mesh, field, options);
    CHECK(adapter.run().ok());
    int count = 0;
    for (const auto& event : adapter.take_events()) count += event.kind == EventKind::dice;
    result = adapter.mesh();
    compact(result);
    return count;
  };
  Mesh<2> fine, finer;
  const Mesh<2> coarse = make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(1, 1));
  // Edges of .25 for sizes of about .04: 6 of them, and twice halved they are still too long.
  CHECK(dices(Effort::normal, coarse, fine) == 2);
  CHECK(dices(Effort::normal, fine, finer) == 0);
  // 640 cells for 16, and twice a quarter of them is still more than twice as many.
  CHECK(dices(Effort::fast, coarse, fine) == 3);
  CHECK(dices(Effort::fast, fine, finer) == 0);
}

TEST_CASE("effort normal inserts no more layers into a coarse mesh that has enough cells") {
  const auto layers = [](const char* name, Effort effort) {
    const Case* c = find_case(name);
    Adapter<2> adapter(std::get<Mesh<2>>(*parse_primitive(c->mesh)), formula(std::string(c->formula)), with(effort));
    CHECK(adapter.run().ok());
    return adapter.operations().at("layers");
  };
  // shock2d: 371 cells of 383 after the first layers, 1 750 after all of them; aniso2d: 195, then 255 of 236.
  CHECK(3 * layers("shock2d", Effort::normal) < layers("shock2d", Effort::best));
  CHECK(layers("aniso2d", Effort::normal) == layers("aniso2d", Effort::best));
}

TEST_CASE("a coarse mesh that has lost too many cells is mended before it is diced") {
  const Case* c = find_case("circle2d");
  for (const std::uint64_t seed : {1, 14, 25, 37}) {
    INFO("seed " << seed);
    AdaptOptions options = with(Effort::fast);
    options.seed = seed;  // with 25 some 60 moves for each cell if the finest mesh is mended alone
    Adapter<2> adapter(std::get<Mesh<2>>(*parse_primitive(c->mesh)), formula(std::string(c->formula)), options);
    CHECK(adapter.run().ok());
    Mesh<2> out = adapter.mesh();
    compact(out);
    CHECK(adapter.operations().at("relocations") < 30 * out.cell_count());
  }
}

TEST_CASE("rows are added that the whole mesh has to make room for") {
  // 27 x 27 cells; dicing makes even numbers of rows alone.
  const auto field = formula("h = 1/27");
  const Mesh<2> mesh = adapted(make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(1, 1)), field, with(Effort::best));
  const Report report = measure(mesh, field);
  CHECK(report.irregular_vertices == 0);
  CHECK(report.edge_length.cv < 0.001);
  CHECK(report.cells == Approx(729).epsilon(0.08));
}

TEST_CASE("alignment turns edges to the metric's directions") {
  AdaptOptions free = with(Effort::normal), aligned = free;
  free.align = 0.0;
  CHECK(run_case("circle2d", aligned).misalignment < 0.6 * run_case("circle2d", free).misalignment);
}

TEST_CASE("the same seed gives the same bits, recorded or not; another seed another mesh") {
  const Mesh<2> mesh = corpus::star(5, 3);
  const auto field = formula("h = 0.05 + 0.1*abs(x)");
  AdaptOptions options = with(Effort::fast);
  options.effort = Effort::normal;
  const Mesh<2> first = adapted(mesh, field, options);
  options.record = true;
  const Mesh<2> second = adapted(mesh, field, options);
  CHECK(first.points == second.points);
  CHECK(first.cells == second.cells);
  options.seed = 2;
  CHECK_FALSE(adapted(mesh, field, options).points == first.points);
}

TEST_CASE("events of full adaptation play forwards and backwards") {
  const Mesh<2> mesh = corpus::ring(8, 2, true);
  AdaptOptions options = with(Effort::normal);
  options.record = true;
  Adapter<2> adapter(mesh, formula("h1 = 0.1 + 0.2*abs(x - 0.5); h2 = 0.25"), options);
  (void)adapter.run();
  const auto events = adapter.take_events();
  struct Picture {
    std::vector<Point<2>> points;
    std::vector<Corners<2>> cells;
  };
  // Where dead vertices lie does not show.
  const auto shows_the_same = [](const Picture& a, const Picture& b) {
    if (a.cells != b.cells) return false;
    for (const auto& cell : a.cells)
      for (const VertexId v : cell)
        if (v != kNone && a.points[v] != b.points[v]) return false;
    return true;
  };
  Picture picture{mesh.points, mesh.cells};
  std::vector<Picture> before;
  bool changed = false;
  for (const auto& e : events) {
    REQUIRE(e.delta.vertices_before == static_cast<Index>(picture.points.size()));
    REQUIRE(e.delta.cells_before == static_cast<Index>(picture.cells.size()));
    for (const CellId c : e.cells) REQUIRE(c < e.delta.cells_after);
    before.push_back(picture);
    apply(e.delta, picture.points, picture.cells);
    changed = changed || e.kind == EventKind::rotate || e.kind == EventKind::collapse;
  }
  CHECK(changed);
  CHECK(shows_the_same(picture, {adapter.mesh().points, adapter.mesh().cells}));
  for (std::size_t i = events.size(); i-- > 0;) {
    revert(events[i].delta, picture.points, picture.cells);
    REQUIRE(shows_the_same(picture, before[i]));
  }
}

TEST_CASE("cancelling full adaptation at any moment leaves a valid mesh") {
  const Mesh<2> mesh = corpus::star(3, 3);
  for (int steps = 1; steps < 200; steps += 13) {
    int left = steps;
    Context context;
    context.cancelled = [&] { return left-- == 0; };
    Adapter<2> adapter(mesh, formula("h = 0.04 + 0.2*abs(y)"), with(Effort::normal), context);
    (void)adapter.run();
    CHECK(validate(adapter.mesh()).ok());
  }
}

TEST_CASE("an adapted mesh is input like any other: a front that moves keeps shapes and the number of cells") {
  Mesh<2> mesh = make_grid<2>({8, 8}, Point<2>(0, 0), Point<2>(1, 1));
  Index fewest = 1 << 30, most = 0;
  for (int i = 0; i <= 10; ++i) {
    const auto field = formula("d = abs(x - 0.3*y - " + std::to_string(0.2 + 0.04 * i) + "); h1 = 0.02 + 0.25*d; h2 = 0.1 + 0.25*d; theta = -0.29");
    mesh = adapted(mesh, field, with(Effort::normal));
    const Report r = measure(mesh, field);
    CHECK(r.valid);
    CHECK(r.edge_length.cv < 0.15);
    CHECK(r.shape.mean > 0.86);
    fewest = std::min(fewest, r.cells);
    most = std::max(most, r.cells);
  }
  CHECK(most < 1.25 * fewest);
}

TEST_CASE("meshes of others are adapted in full to a boundary layer: valid, groups kept") {
  for (const char* name : {"plate_hole_v4.msh", "lshape_v2.msh"}) {
    const std::string path = shared_data::path(name);
    if (path.empty()) return;
    INFO(name);
    const Mesh<2> mesh = std::get<Mesh<2>>(*read_mesh_file(path));
    const auto field = formula("h1 = 0.1; h2 = min(0.1, 0.01 + 0.3*abs(y))");
    Adapter<2> adapter(mesh, field, with(Effort::normal));
    (void)adapter.run();
    Mesh<2> result = adapter.mesh();
    compact(result);
    const Report r = measure(result, field);
    INFO(r.defect);
    CHECK(r.valid);
    CHECK(r.edge_length.cv < 0.2);
    CHECK(checks::distance_from_geometry(result) < 1e-12);
    const auto before = checks::boundary_by_group(mesh), after = checks::boundary_by_group(result);
    REQUIRE(before.size() == after.size());
    for (const auto& [group, length] : before) CHECK(after.at(group) == Approx(length).epsilon(0.02));  // chords of the hole's polygon
  }
}

}  // namespace full_adaptation_test
