#include "pillowmesh/adapt/adapter.h"

#include <cstdio>

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/io/io.h"
#include "pillowmesh/mesh/validate.h"

namespace adapter_test {

using namespace pillowmesh;

namespace {

template <int Dim>
MetricField<Dim> formula(const std::string& text) {
  auto field = MetricField<Dim>::from_formula(text);
  INFO(field.status().message);
  REQUIRE(field.ok());
  return *field;
}

struct NamedField {
  std::string name;
  MetricField<2> field;
};

/// Metrics that ask a mesh of the corpus for a few hundred cells: fine along a line, stretched and turning, a tensor.
std::vector<NamedField> metrics(const Mesh<2>& mesh) {
  Point<2> low = mesh.points[0], high = low;
  for (const auto& p : mesh.points)
    for (int d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  char setup[256];
  const double size = std::max(high[0] - low[0], high[1] - low[1]);
  std::snprintf(setup, sizeof setup, "s = %.17g; u = (x - %.17g)/s; v = (y - %.17g)/s; ", size, low[0], low[1]);
  const std::string start = setup;
  return {{"isotropic, fine along a line", formula<2>(start + "h = s*(0.02 + 0.25*abs(u - 0.4))")},
          {"anisotropic, turning", formula<2>(start + "h1 = 0.04*s; h2 = s*(0.05 + 0.2*v); theta = 3*u + v")},
          {"tensor", formula<2>(start + "m11 = 200*(1 + v)/s^2; m12 = 90*u/s^2; m22 = 120/s^2")}};
}

AdaptOptions unsmoothed() {
  AdaptOptions options;
  options.method = Method::paper;
  options.smoothing = Smoothing::none;
  return options;
}

template <class Check>
void for_each_problem(Check&& check) {
  for (const auto& [mesh_name, mesh] : corpus::meshes<2>())
    for (const auto& [metric_name, field] : metrics(mesh)) {
      INFO(mesh_name << "; " << metric_name);
      check(mesh, field);
    }
}

}  // namespace

TEST_CASE("every mesh of every run is valid, and refinement ends with all lengths below the threshold") {
  for_each_problem([](const Mesh<2>& mesh, const MetricField<2>& field) {
    for (const int thickness : {1, 2}) {
      AdaptOptions options = unsmoothed();
      options.thickness = thickness;
      Adapter<2> adapter(mesh, field, options);
      for (bool more = true; more;) {
        more = adapter.step();
        const Status valid = validate(adapter.mesh());
        INFO("thickness " << thickness << ": " << valid.message);
        REQUIRE(valid.ok());
      }
      INFO("thickness " << thickness << ": " << adapter.outcome().message);
      CHECK(adapter.outcome().ok());
      CHECK(adapter.mesh().cell_count() > mesh.cell_count());
      CHECK(adapter.mesh().cell_count() < 20000);
      CHECK(checks::longest_edge(adapter.mesh(), field) <= 2.0 * (1 + checks::kTagging));
      CHECK(checks::euler(adapter.mesh()) == checks::euler(mesh));
    }
  });
}

TEST_CASE("a run whose last smoothing leaves no edge too long has met its limit, though layers were refused") {
  const auto read = read_mesh_file(PILLOWMESH_TEST_DATA "/lshape_v2.msh");
  REQUIRE(read.ok());
  const auto& mesh = std::get<Mesh<2>>(*read);
  for (const char* text : {"h1 = 0.4*(0.0268 + 0.3085*abs(y - 0.9027)); h2 = 0.4*0.1653; theta = 1.149 - 1.8958*x",
                           "d = sqrt((x - 0.6428)^2 + (y - 0.5231)^2); h1 = 0.4*(0.0425 + abs(d - 0.3319)*0.3651);"
                           "h2 = 0.4*(0.0519 + abs(d - .3)*0.1208); theta = atan2(y, x)"}) {
    INFO(text);
    const auto field = formula<2>(text);
    AdaptOptions options;
    options.method = Method::paper;
    Adapter<2> adapter(mesh, field, options);
    CHECK(adapter.run().message == "");
    CHECK(adapter.operations().at("refused_layers") > 0);
    CHECK(checks::longest_edge(adapter.mesh(), field) <= 2.0 * (1 + checks::kTagging));
    CHECK(validate(adapter.mesh()).ok());
  }
}

TEST_CASE("patches and groups survive, and boundary vertices stay on the domain's boundary") {
  for_each_problem([](const Mesh<2>& mesh, const MetricField<2>& field) {
    AdaptOptions options;
    options.method = Method::paper;
    options.max_sweeps = 10;
    Adapter<2> adapter(mesh, field, options);
    (void)adapter.run();
    const Mesh<2>& out = adapter.mesh();
    CHECK(validate(out).message == "");
    CHECK(checks::distance_from_geometry(out) < 1e-12);
    CHECK(out.geometry == mesh.geometry);
    const auto before = checks::boundary_by_group(mesh), after = checks::boundary_by_group(out);
    REQUIRE(after.size() == before.size());
    for (const auto& [group, length] : before) {
      REQUIRE(after.count(group) == 1);
      CHECK(after.at(group) <= length * (1 + 1e-12));  // chords of a bent side are no longer than the side
    }
    // Corners are still there, exactly.
    for (VertexId v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.support[v].dim == 0) CHECK(out.points[v] == mesh.points[v]);
  });
}

TEST_CASE("a domain with straight sides keeps its area, and each group its length") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    if (name != "grid 5x4" && name != "one row of 6" && name != "L" && name != "shaken grid") continue;
    for (const auto& [metric, field] : metrics(mesh)) {
      INFO(name << "; " << metric);
      AdaptOptions options;
      options.method = Method::paper;
      options.max_sweeps = 10;
      Adapter<2> adapter(mesh, field, options);
      (void)adapter.run();
      CHECK(checks::area(adapter.mesh()) == Approx(checks::area(mesh)));
      const auto before = checks::boundary_by_group(mesh), after = checks::boundary_by_group(adapter.mesh());
      for (const auto& [group, length] : before) CHECK(after.at(group) == Approx(length));
    }
  }
}

TEST_CASE("the same run gives the same bits, recorded or not, at once or step by step among others") {
  for_each_problem([](const Mesh<2>& mesh, const MetricField<2>& field) {
    AdaptOptions options;
    options.method = Method::paper;
    options.smoothing = Smoothing::between;
    options.max_sweeps = 3;
    Adapter<2> once(mesh, field, options);
    (void)once.run();

    options.record = true;
    Adapter<2> recorded(mesh, field, options), moved_from(mesh, field, options);
    for (int i = 0; i < 5; ++i) moved_from.step();
    Adapter<2> stepped = std::move(moved_from);
    while (recorded.step()) {
      stepped.step();
      if (recorded.operations().at("layers") % 3 == 0) (void)stepped.take_events();
    }
    (void)stepped.run();
    CHECK(corpus::identical(once.mesh(), recorded.mesh()));
    CHECK(corpus::identical(once.mesh(), stepped.mesh()));
    CHECK(once.operations() == stepped.operations());
    CHECK(stepped.outcome().code == once.outcome().code);
    CHECK_FALSE(stepped.step());
    CHECK(corpus::identical(once.mesh(), stepped.mesh()));
  });
}

TEST_CASE("a run that is cancelled stops with a valid mesh and says so") {
  const auto mesh = corpus::ring(16, 3, true);
  const auto field = metrics(mesh)[0].field;
  Index last = 0;
  for (const int steps : {0, 1, 2, 7, 20, 40}) {
    int polls = 0;
    Context context;
    context.cancelled = [&] { return polls++ == steps; };
    Adapter<2> adapter(mesh, field, {}, context);
    const Status status = adapter.run();
    INFO(steps << " steps: " << status.message);
    CHECK(status.code == StatusCode::cancelled);
    CHECK(polls == steps + 1);
    CHECK(validate(adapter.mesh()).ok());
    CHECK(adapter.mesh().cell_count() >= last);
    last = adapter.mesh().cell_count();
    CHECK_FALSE(adapter.step());
  }
  CHECK(last > mesh.cell_count());
}

TEST_CASE("progress begins near 0, never passes 1, and ends with 1") {
  const auto mesh = corpus::ell(6);
  std::vector<double> shares;
  Context context;
  context.progress = [&](double share, std::string_view activity) {
    CHECK_FALSE(activity.empty());
    shares.push_back(share);
  };
  AdaptOptions options;
  options.method = Method::paper;
  options.max_sweeps = 20;
  Adapter<2> adapter(mesh, metrics(mesh)[0].field, options, context);
  REQUIRE(adapter.run().ok());
  REQUIRE(shares.size() > 5);
  CHECK(shares.front() < 0.1);
  CHECK(shares.back() == 1.0);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
}

TEST_CASE("a run stops before it would pass the cells allowed") {
  for_each_problem([](const Mesh<2>& mesh, const MetricField<2>& field) {
    for (const std::int64_t most : {std::int64_t{1}, std::int64_t{mesh.cell_count() + 8}}) {
      AdaptOptions options = unsmoothed();
      options.max_cells = most;
      Adapter<2> adapter(mesh, field, options);
      const Status status = adapter.run();
      CHECK(status.code == StatusCode::limit_not_met);
      CHECK(status.message.find(std::to_string(most)) != std::string::npos);
      CHECK(adapter.mesh().cell_count() <= std::max<std::int64_t>(most, mesh.cell_count()));
      CHECK(validate(adapter.mesh()).ok());
    }
  });
}

TEST_CASE("a run of one iteration that is not enough says that edges are too long still") {
  const auto mesh = make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(1, 1));
  AdaptOptions options = unsmoothed();
  options.max_iterations = 1;
  Adapter<2> adapter(mesh, formula<2>("h = 0.01"), options);
  CHECK(adapter.run().code == StatusCode::limit_not_met);
  CHECK(adapter.operations().at("iterations") == 1);
  CHECK(validate(adapter.mesh()).ok());
}

TEST_CASE("a metric that is not usable at a vertex is refused before anything is done") {
  const auto mesh = make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(1, 1));
  for (const char* text : {"h = x", "h = sqrt(x - 0.5)", "h = -1", "h = 1/0", "m11 = 1; m12 = 2; m22 = 1"}) {
    INFO(text);
    Adapter<2> adapter(mesh, formula<2>(text), {});
    CHECK_FALSE(adapter.step());
    CHECK(adapter.outcome().code == StatusCode::bad_input);
    CHECK(adapter.outcome().message.size() > 20);
    CHECK(corpus::identical(adapter.mesh(), mesh));
  }
}

TEST_CASE("a mesh that is fine enough is left alone by refinement") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    Adapter<2> adapter(mesh, formula<2>("h = 100"), unsmoothed());
    CHECK(adapter.run().ok());
    CHECK(corpus::identical(adapter.mesh(), mesh));
    CHECK(adapter.operations().at("layers") == 0);
  }
}

TEST_CASE("a row that is the whole mesh is split along the boundary that it lies on") {
  // Too wide, long enough: nothing but whole-mesh layers can refine one row across.
  const auto mesh = make_grid<2>({6, 1}, Point<2>(0, 0), Point<2>(6, 1));
  Adapter<2> adapter(mesh, formula<2>("h1 = 1; h2 = 0.3"), unsmoothed());
  CHECK(adapter.run().ok());
  CHECK(adapter.mesh().cell_count() == 12);  // l = 3.33, halved once
  CHECK(checks::area(adapter.mesh()) == Approx(6.0));
}

TEST_CASE("rows inside a winding layer, which touch no hull, are refined in the end") {
  // Turns 1 to 3 of 5 are too wide: one layer of three rows side by side. The outer two are halved, which is enough for
  // them; the middle one touches no hull, and has lost its tags.
  const auto mesh = corpus::snail(40, 5);
  const auto field = formula<2>(
      "d = sqrt(x^2 + y^2); theta = atan2(y, x); t = if(theta < 0, theta + 2*pi, theta)/(2*pi); turn = d - 2 - t;"
      "h1 = if(abs(turn - 2.5) < 1.501, 0.45, 9); h2 = 99");
  AdaptOptions options = unsmoothed();
  options.augment = 0;  // a ring more would end flat against the domain's re-entrant corner
  Adapter<2> adapter(mesh, field, options);
  CHECK(adapter.run().ok());
  CHECK(adapter.operations().at("iterations") == 2);
  CHECK(checks::longest_edge(adapter.mesh(), field) <= 2.0 * (1 + checks::kTagging));
  CHECK(validate(adapter.mesh()).message == "");
}

TEST_CASE("where no layer can be inserted the run says so and leaves a valid mesh") {
  // All of the snail is one layer. It has no hull, and its boundary ends at a re-entrant corner.
  const auto mesh = corpus::snail(12, 3);
  Adapter<2> adapter(mesh, formula<2>("theta = atan2(y, x); h1 = 0.3; h2 = 99"), unsmoothed());
  const Status status = adapter.run();
  CHECK(status.code == StatusCode::limit_not_met);
  CHECK(status.message.find("no layer can be inserted") != std::string::npos);
  CHECK(adapter.operations().at("refused_layers") == 1);
  CHECK(corpus::identical(adapter.mesh(), mesh));
}

TEST_CASE("dicing makes every cell n x n, after refinement to n times the size") {
  const auto mesh = corpus::ell(6);
  const auto field = metrics(mesh)[1].field;
  for (const int n : {2, 3}) {
    AdaptOptions options = unsmoothed();
    Adapter<2> coarse(mesh, field.scaled(n), options);
    REQUIRE(coarse.run().ok());
    options.dice = n;
    Adapter<2> diced(mesh, field, options);
    REQUIRE(diced.run().ok());
    CHECK(diced.mesh().cell_count() == n * n * coarse.mesh().cell_count());
    CHECK(validate(diced.mesh()).message == "");
    CHECK(checks::boundary_by_group(diced.mesh()).size() == checks::boundary_by_group(mesh).size());
    options.max_cells = n * n * coarse.mesh().cell_count() - 1;
    Adapter<2> limited(mesh, field, options);
    CHECK(limited.run().code == StatusCode::limit_not_met);
    CHECK(corpus::identical(limited.mesh(), coarse.mesh()));
  }
}

TEST_CASE("more augmentation and lower thresholds give more cells") {
  const auto mesh = make_grid<2>({8, 8}, Point<2>(0, 0), Point<2>(1, 1));
  const auto field = metrics(mesh)[0].field;
  const auto cells = [&](int augment, double threshold) {
    AdaptOptions options = unsmoothed();
    options.augment = augment;
    options.threshold = threshold;
    Adapter<2> adapter(mesh, field, options);
    CHECK(adapter.run().ok());
    CHECK(checks::longest_edge(adapter.mesh(), field) <= threshold * (1 + checks::kTagging));
    return adapter.mesh().cell_count();
  };
  const Index usual = cells(1, 2.0);
  CHECK(cells(0, 2.0) < usual);
  CHECK(cells(2, 2.0) > usual);
  CHECK(cells(1, 1.4) > usual);
}

TEST_CASE("hexahedra are refined by the same loop: valid after every step, on their boundary, groups kept") {
  const auto mesh = make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  for (const char* text : {"h1 = 0.3; h2 = 0.3; h3 = 0.05 + 0.2*z", "h = 0.12 + 0.15*z"}) {
    INFO(text);
    const auto field = formula<3>(text);
    AdaptOptions options;
    options.method = Method::paper;
    options.max_sweeps = 3;
    options.max_iterations = 4;
    Adapter<3> adapter(mesh, field, options);
    while (adapter.step()) {
      const Status valid = validate(adapter.mesh());
      INFO(valid.message);
      REQUIRE(valid.ok());
    }
    CHECK(adapter.mesh().cell_count() > mesh.cell_count());
    CHECK(checks::euler(adapter.mesh()) == 1);
    CHECK(checks::distance_from_geometry(adapter.mesh()) < 1e-12);
    const auto before = checks::boundary_by_group(mesh), after = checks::boundary_by_group(adapter.mesh());
    for (const auto& [group, size] : before) CHECK(after.at(group) == Approx(size));
  }
}

}  // namespace adapter_test
