// Hex meshes that others made (../shared/data): read, measured, written and read again, adapted, refused.
#include "shared_data.h"

#include <cmath>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/io/io.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/quality/jacobian.h"
#include "pillowmesh/quality/report.h"

namespace shared_data_test {

using namespace pillowmesh;

namespace {

double least_scaled_jacobian(const Mesh<3>& mesh) {
  double least = 1.0;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    if (mesh.alive(c)) least = std::min(least, scaled_jacobian(mesh, c));
  return least;
}

/// Number of different patches that boundary facets lie on, and of boundary facets.
std::array<int, 2> patches_and_facets(const Mesh<3>& mesh) {
  std::vector<char> seen(mesh.patch_groups.size(), 0);
  int facets = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; f < 6; ++f)
      if (mesh.on_boundary(c, f)) {
        seen[mesh.patch_of(c, f)] = 1;
        ++facets;
      }
  return {static_cast<int>(std::count(seen.begin(), seen.end(), 1)), facets};
}

/// The largest distance of a boundary vertex from the surface of the input.
double distance_from_surface(const Mesh<3>& mesh) {
  double largest = 0.0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const VertexSupport s = mesh.support[v];
    if (mesh.vertex_cell[v] == kNone || s.dim == 3 || s.dim == 0) continue;
    Index anchor = mesh.anchor[v];
    largest = std::max(largest, (slide(*mesh.geometry, s, anchor, mesh.points[v]) - mesh.points[v]).norm());
  }
  return largest;
}

Mesh<3> load(const std::string& file) {
  auto mesh = read_mesh_file(file);
  INFO(mesh.status().message);
  REQUIRE(mesh.ok());
  return std::get<Mesh<3>>(std::move(*mesh));
}

struct Adapted {
  Mesh<3> mesh;
  double least_jacobian = 1.0;  ///< of all the meshes on the way
  Status outcome;
};

/// Runs the paper's method and validates every fifth mesh that a layer made, every fifth sweep's, and the last.
Adapted adapt(const Mesh<3>& mesh, const char* formula, const char* smooth = "end", const char* sweeps = "10") {
  AdaptOptions options;
  options.method = Method::paper;
  REQUIRE(set_option(options, "smooth", smooth).ok());
  REQUIRE(set_option(options, "max-sweeps", sweeps).ok());
  Adapter<3> adapter(mesh, *MetricField<3>::from_formula(formula), options);
  Adapted out;
  int steps = 0;
  for (bool more = true; more;) {
    more = adapter.step();
    if (more && ++steps % 5 != 0) continue;
    const Status valid = validate(adapter.mesh());
    INFO(valid.message);
    REQUIRE(valid.ok());
    out.least_jacobian = std::min(out.least_jacobian, least_scaled_jacobian(adapter.mesh()));
  }
  out.mesh = adapter.mesh();
  out.outcome = adapter.outcome();
  return out;
}

}  // namespace

TEST_CASE("the hex meshes of others are read with the counts of their files, valid, and come back from a file") {
  struct Known {
    const char* name;
    int cells, vertices;
    double scaled_jacobian;  // rounded down in the third digit
  };
  // Numbers of the files; scaled Jacobians as measured, CAD3's as ../shared/data/README.md says it.
  for (const Known& known :
       {Known{"ellipsoid_hex", 6816, 7293, .573}, Known{"hexbox/val3", 3, 14, .803}, Known{"hexbox/val5", 5, 22, .880},
        Known{"hexbox/val11", 11, 46, .281}, Known{"hexbox/twisting", 64, 153, .571},
        Known{"hexbox/Torus", 192, 360, .082}, Known{"hexbox/CAD3", 186, 328, .016}}) {
    INFO(known.name);
    const std::string file = shared_data::path(std::string(known.name) + ".mesh");
    if (file.empty()) continue;
    const Mesh<3> mesh = load(file);
    CHECK(mesh.cell_count() == known.cells);
    CHECK(mesh.vertex_count() == known.vertices);
    CHECK(validate(mesh).message == "");
    CHECK(find_inside_defects(mesh).empty());
    CHECK(least_scaled_jacobian(mesh) >= known.scaled_jacobian);
    CHECK(least_scaled_jacobian(mesh) < known.scaled_jacobian + 1e-3);
    const Report report = measure(mesh, *MetricField<3>::from_formula("h = 1"));
    CHECK(report.valid);
    CHECK(report.complexity > 0.0);
    for (const char* ending : {"a.mesh", "a.msh", "a.vtk", "a.vtu"}) {
      INFO(ending);
      const auto bytes = write_mesh(mesh, ending);
      REQUIRE(bytes.ok());
      const auto again = read_mesh(ending, *bytes);
      REQUIRE(again.ok());
      const Mesh<3>& back = std::get<Mesh<3>>(*again);
      CHECK(back.cells == mesh.cells);
      CHECK(back.points == mesh.points);
      CHECK(patches_and_facets(back) == patches_and_facets(mesh));
    }
  }
}

TEST_CASE("a mesh with 48 degenerate hexes is refused with the cells named") {
  const std::string file = shared_data::path("hexbox/CAD10.mesh");
  if (file.empty()) return;
  const auto mesh = read_mesh_file(file);
  REQUIRE_FALSE(mesh.ok());
  CHECK(mesh.status().code == StatusCode::bad_input);
  const std::string text = mesh.status().message;
  INFO(text);
  CHECK(text.find("hex 418 is inverted or degenerate") != std::string::npos);
  CHECK(text.find("shares two facets with hex 419") != std::string::npos);
  CHECK(text.find("line 2113") != std::string::npos);
  CHECK(text.find("47 more defects, in hexes 419, 435, 436, 462") != std::string::npos);
}

TEST_CASE("a hex mesh of others is adapted to a band, on its own surface") {
  const std::string file = shared_data::path("ellipsoid_hex.mesh");
  if (file.empty()) return;
  const Mesh<3> initial = load(file);
  const char* band = "h = 0.02 + 0.2*abs(x - 0.05)";
  const Adapted adapted = adapt(initial, band);
  const auto field = *MetricField<3>::from_formula(band);
  const Report before = measure(initial, field), after = measure(adapted.mesh, field);
  CHECK(after.valid);
  CHECK(distance_from_surface(adapted.mesh) < 1e-9);
  CHECK(find_inside_defects(adapted.mesh).empty());
  CHECK(before.edge_length.max > 3.0);
  CHECK(after.edge_length.max < 2.0);
  CHECK(after.scaled_jacobian_min > 0.1);
}

TEST_CASE("small hex meshes with irregular edges are refined and stay on their surfaces") {
  struct Run {
    const char* name;
    const char* formula;
  };
  for (const Run& run : {Run{"val3", "h = 0.3 + 0.2*abs(x - 1)"}, Run{"val5", "h = 0.3 + 0.2*abs(x - 1)"},
                         Run{"val11", "h = 0.4 + 0.2*abs(x)"}, Run{"twisting", "h = 0.2 + 0.2*abs(y - 1)"},
                         Run{"Torus", "h = 0.15 + 0.2*abs(x)"}}) {
    INFO(run.name);
    const std::string file = shared_data::path("hexbox/" + std::string(run.name) + ".mesh");
    if (file.empty()) continue;
    const Mesh<3> initial = load(file);
    const Adapted adapted = adapt(initial, run.formula);
    CHECK(adapted.mesh.cell_count() > initial.cell_count());
    CHECK(distance_from_surface(adapted.mesh) < 1e-9);
  }
}

TEST_CASE("a hard mesh never gets worse than it came") {
  const std::string file = shared_data::path("hexbox/CAD3.mesh");
  if (file.empty()) return;
  const Mesh<3> initial = load(file);
  for (const char* smooth : {"none", "end", "between"})
    for (const char* band : {"h = 0.12 + 0.2*abs(x)", "h = 0.2 + 0.2*abs(y)", "h = 0.5"}) {
      INFO(smooth << ", " << band);
      CHECK(adapt(initial, band, smooth).least_jacobian >= least_scaled_jacobian(initial) * (1 - 1e-12));
    }
}

}  // namespace shared_data_test
