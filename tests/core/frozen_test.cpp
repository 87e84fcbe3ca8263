#include "pillowmesh/mesh/frozen.h"

#include <cmath>
#include <map>

#include "../catch.h"
#include "checks.h"
#include "io_meshes.h"
#include "meshes.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/io/io.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/quality/report.h"

namespace frozen_test {

using namespace pillowmesh;

namespace {

template <int Dim>
Mesh<Dim> primitive(const char* spec, std::vector<std::string> freeze) {
  auto mesh = parse_primitive(spec, freeze);
  INFO(mesh.status().message);
  REQUIRE(mesh.ok());
  return std::get<Mesh<Dim>>(*mesh);
}

template <int Dim>
Mesh<Dim> adapted(const Mesh<Dim>& mesh, const char* formula, Status* outcome = nullptr,
                  std::map<std::string, std::string> settings = {}) {
  AdaptOptions options;
  options.effort = Effort::fast;
  for (const auto& [name, value] : settings) REQUIRE(set_option(options, name, value).ok());
  Adapter<Dim> adapter(mesh, *MetricField<Dim>::from_formula(formula), options);
  const Status status = adapter.run();
  if (outcome != nullptr) *outcome = status;
  return adapter.mesh();
}

/// Every frozen thing of `before` is in `after`, bit for bit, and `after` is valid.
template <int Dim>
void check_kept(const Mesh<Dim>& before, const Mesh<Dim>& after) {
  CHECK(validate(after).ok());
  REQUIRE(before.frozen != nullptr);
  int frozen = 0, moved = 0;
  for (VertexId v = 0; v < before.vertex_count(); ++v) {
    if (!before.support[v].frozen()) continue;
    ++frozen;
    moved += after.vertex_cell[v] == kNone || before.points[v] != after.points[v] || !after.support[v].frozen();
  }
  CHECK(frozen > 0);
  CHECK(moved == 0);
  CHECK(frozen_remain(after, before.cells));
}

std::size_t edges_on(const Mesh<2>& mesh, const char* group) {
  std::size_t count = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; f < 4; ++f)
      count += mesh.alive(c) && mesh.on_boundary(c, f) && mesh.patch_groups[mesh.patch_of(c, f)].name == group;
  return count;
}

}  // namespace

TEST_CASE("a frozen side keeps its edges while the mesh beside it is refined or coarsened") {
  for (const char* formula : {"h = 0.04", "h = 0.5", "h1 = .04; h2 = .2; theta = .4", "h = .02 + .2*x"})
    for (const char* method : {"full", "paper"}) {
      INFO(formula << " " << method);
      const auto before = primitive<2>("grid:6,6:0,1,0,1", {"xmin"});
      const auto after = adapted(before, formula, nullptr, {{"method", method}});
      check_kept(before, after);
      CHECK(edges_on(after, "xmin") == 6);
      if (std::string(formula) == "h = 0.04") CHECK(edges_on(after, "xmax") > 12);
    }
}

TEST_CASE("the outcome tells of frozen edges that are too long, once all others are short") {
  Status outcome;
  const auto before = primitive<2>("grid:6,6:0,1,0,1", {"xmin"});
  (void)adapted(before, "h = 0.075", &outcome, {{"effort", "normal"}});
  CHECK(outcome.code == StatusCode::limit_not_met);
  CHECK(outcome.message == "6 edges are longer than the threshold, but frozen");
  (void)adapted(before, "h = 0.1", &outcome, {{"effort", "normal"}});
  CHECK(outcome.ok());
}

TEST_CASE("frozen cells in the middle of a mesh stay, with the same corners") {
  // 12 x 12 cells, those of the middle third a region of their own.
  auto input = to_input(make_grid<2>({12, 12}, Point<2>(0, 0), Point<2>(1, 1)));
  input.region_groups = {{1, "fluid"}, {2, "probe"}};
  input.cell_region.assign(144, 0);
  for (int j = 4; j < 8; ++j)
    for (int i = 4; i < 8; ++i) input.cell_region[j * 12 + i] = 1;
  BoundaryOptions options;
  options.freeze = {"probe"};
  const auto before = *make_mesh(input, options);
  CHECK(before.frozen->cells.size() == 16);
  for (const char* formula : {"h = 0.03", "h = 0.3", "h = .01 + .2*abs(x - .5)"}) {
    INFO(formula);
    const auto after = adapted(before, formula);
    check_kept(before, after);
    int probe = 0;
    for (CellId c = 0; c < after.cell_count(); ++c) probe += after.alive(c) && after.region[c] == 1;
    CHECK(probe == 16);
    CHECK(std::abs(checks::area(std::get<Mesh<2>>(*read_mesh("a.vtu", *write_mesh(after, "a.vtu")))) - 1) < 1e-12);
  }
}

TEST_CASE("a frozen curve inside the domain, by the number of its group, is written with its group") {
  auto input = to_input(make_grid<2>({8, 8}, Point<2>(0, 0), Point<2>(1, 1)));
  input.facet_groups.push_back({77, ""});
  for (int i = 0; i < 8; ++i)
    input.facets.push_back({{4 * 9 + i, 4 * 9 + i + 1}, static_cast<Index>(input.facet_groups.size()) - 1});
  BoundaryOptions options;
  options.freeze = {"77"};
  const auto before = *make_mesh(input, options);
  CHECK(before.frozen->edges.size() == 8);
  CHECK(before.frozen->inner_facets.size() == 8);
  const auto after = adapted(before, "h1 = .03; h2 = .1; theta = 0.3");
  check_kept(before, after);
  const auto out = to_input(after);
  int listed = 0;
  for (const auto& f : out.facets)
    if (out.facet_groups[f.group].tag == 77) {
      ++listed;
      CHECK(out.points[f.vertices[0]][1] == 0.5);
      CHECK(out.points[f.vertices[1]][1] == 0.5);
    }
  CHECK(listed == 8);
}

TEST_CASE("required entities of a Medit file stay, and are required in what is written") {
  auto input = to_input(make_grid<2>({6, 6}, Point<2>(0, 0), Point<2>(1, 1)));
  input.required_vertices = {24};  // in the middle
  input.required_facets = {{0, 1}, {5, 6}};
  input.required_cells = {35};
  const auto before = *make_mesh(input);
  for (const char* name : {"a.mesh", "a.meshb"}) {
    const auto read = std::get<Mesh<2>>(*read_mesh(name, *write_mesh(before, name)));
    INFO(name);
    CHECK(read.frozen->edges == before.frozen->edges);
    CHECK(read.frozen->cells == before.frozen->cells);
    CHECK(read.support[24].frozen());
    CHECK(!read.support[25].frozen());
  }
  const auto after = adapted(before, "h = .07 + .1*y");
  check_kept(before, after);
  const auto again = std::get<Mesh<2>>(*read_mesh("b.mesh", *write_mesh(after, "b.mesh")));
  CHECK(again.frozen->edges.size() == before.frozen->edges.size());
  CHECK(again.frozen->cells.size() == 1);
}

TEST_CASE("a patch of a hex mesh, and hexahedra, stay while others are refined") {
  const auto face = primitive<3>("grid:3,3,3:0,1,0,1,0,1", {"zmax"});
  CHECK(face.frozen->facets.size() == 9);
  CHECK(face.frozen->edges.size() == 24);
  for (const char* formula : {"h = .16", "h1 = .15; h2 = .15; h3 = .4", "h = .14 + .2*z"}) {
    INFO(formula);
    const auto after = adapted(face, formula);
    check_kept(face, after);
    CHECK(after.cell_count() > 27);
  }
  auto input = to_input(make_grid<3>({3, 3, 3}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)));
  input.required_cells = {13};  // in the middle
  input.required_facets = {{0, 1, 4, 5}};
  const auto hexes = *make_mesh(input);
  CHECK(hexes.frozen->facets.size() == 7);
  const auto after = adapted(hexes, "h = .15");
  check_kept(hexes, after);
  CHECK(after.cell_count() > 60);
}

TEST_CASE("what is asked to be frozen has to be there") {
  const auto refusal = [](const BoundaryOptions& options, auto change) {
    auto input = to_input(make_grid<2>({2, 2}, Point<2>(0, 0), Point<2>(1, 1)));
    change(input);
    return make_mesh(input, options).status();
  };
  BoundaryOptions inlet;
  inlet.freeze = {"inlet"};
  const Status s = refusal(inlet, [](auto&) {});
  CHECK(s.code == StatusCode::usage);
  CHECK(s.message == "--freeze inlet: there is no such group; the mesh has xmin, ymin, xmax, ymax");
  const Status t = refusal({}, [](auto& input) { input.required_facets = {{0, 8}}; });
  CHECK(t.code == StatusCode::bad_input);
  CHECK(t.message == "the edge between vertices 0 and 8 is to be frozen, but no cell has it");
  Status outcome;
  (void)adapted(primitive<2>("grid:2,2:0,1,0,1", {"xmin"}), "h = .1", &outcome, {{"dice", "2"}});
  CHECK(outcome.code == StatusCode::usage);
}

TEST_CASE("a physical point of a Gmsh file stays where it is, also inside") {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n0 5 \"gauge\"\n$EndPhysicalNames\n$Nodes\n9\n"
      "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1.1 .9 0\n6 2 1 0\n7 0 2 0\n8 1 2 0\n9 2 2 0\n$EndNodes\n$Elements\n5\n"
      "1 15 2 5 1 5\n2 3 2 0 1 1 2 5 4\n3 3 2 0 1 2 3 6 5\n4 3 2 0 1 4 5 8 7\n5 3 2 0 1 5 6 9 8\n$EndElements\n";
  BoundaryOptions options;
  options.freeze = {"gauge"};
  const auto mesh = read_mesh("a.msh", text, options);
  REQUIRE(mesh.ok());
  const auto& before = std::get<Mesh<2>>(*mesh);
  CHECK(before.support[4].frozen());
  const auto after = adapted(before, "h = .13");
  check_kept(before, after);
  CHECK(after.cell_count() > 100);
}

}  // namespace frozen_test
