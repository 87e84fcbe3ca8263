#include "pillowmesh/adapt/transfer.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "../catch.h"
#include "checks.h"
#include "io_meshes.h"
#include "meshes.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/io/file_mesh.h"
#include "pillowmesh/io/io.h"
#include "pillowmesh/io/sink.h"
#include "pillowmesh/io/solution_file.h"

namespace transfer_test {

using namespace pillowmesh;

namespace {

template <int Dim>
Mesh<Dim> adapted(Mesh<Dim> mesh, const char* formula) {
  AdaptOptions options;
  options.effort = Effort::fast;
  Adapter<Dim> adapter(std::move(mesh), *MetricField<Dim>::from_formula(formula), options);
  (void)adapter.run();
  return adapter.mesh();
}

/// A function at the points of a mesh, one component.
template <int Dim>
Solution<Dim> sampled(const Mesh<Dim>& mesh, const std::function<double(const Point<Dim>&)>& f) {
  auto out = solution_on(mesh);
  FieldArray array{"f", false, false, 1, {}};
  for (const auto& p : out.points) array.values.push_back(f(p));
  out.fields.push_back(array);
  return out;
}

template <int Dim>
double error(const Solution<Dim>& from, const Mesh<Dim>& to, const std::function<double(const Point<Dim>&)>& f) {
  const auto carried = carry(from, to);
  REQUIRE(carried.ok());
  const auto on = solution_on(to);
  REQUIRE(carried->size() == 1);
  REQUIRE((*carried)[0].values.size() == on.points.size());
  double most = 0.0;
  for (std::size_t i = 0; i < on.points.size(); ++i)
    most = std::max(most, std::abs((*carried)[0].values[i] - f(on.points[i])));
  return most;
}

template <int Dim>
double volume(const Solution<Dim>& s, std::size_t c) {
  const auto& k = s.cells[c];
  static_assert(Dim == 2);
  return 0.5 * cross(s.points[k[3]] - s.points[k[0]], s.points[k[2]] - s.points[k[1]]);
}

}  // namespace

TEST_CASE("linear functions are carried exactly between any two meshes of a domain") {
  const auto plane = [](const Point<2>& p) { return 1 + 2 * p[0] - 3 * p[1]; };
  const auto old = corpus::shaken(make_grid<2>({9, 7}, Point<2>(0, 0), Point<2>(1, 1)), 0.11, 0.3, 5);
  CHECK(error<2>(sampled<2>(old, plane), adapted(old, "h = .02 + .2*abs(x-.4)"), plane) < 1e-13);
  const auto solid = [](const Point<3>& p) { return 1 + 2 * p[0] - 3 * p[1] + p[2]; };
  const auto hexes = corpus::shaken(make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)), 0.25, 0.25, 7);
  CHECK(error<3>(sampled<3>(hexes, solid), make_grid<3>({7, 6, 5}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)), solid) <
        1e-12);
}

TEST_CASE("bilinear and trilinear functions are carried exactly from boxes, where triangles would not do") {
  const auto saddle = [](const Point<2>& p) { return p[0] * p[1] + p[0]; };
  const auto old = make_grid<2>({5, 4}, Point<2>(0, 0), Point<2>(1, 1));
  CHECK(error<2>(sampled<2>(old, saddle), adapted(old, "h = .06"), saddle) < 1e-13);
  const auto cube = [](const Point<3>& p) { return p[0] * p[1] * p[2] - p[1]; };
  const auto hexes = make_grid<3>({3, 2, 4}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  CHECK(error<3>(sampled<3>(hexes, cube), make_grid<3>({5, 7, 3}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)), cube) < 1e-13);
}

TEST_CASE("a smooth function is carried with an error of the second order, below its bound") {
  const auto wave = [](const Point<2>& p) { return std::sin(3 * p[0]) * std::cos(2 * p[1]); };
  double coarse = 0.0;
  for (const int n : {8, 16}) {
    const auto old = make_grid<2>({n, n}, Point<2>(0, 0), Point<2>(1, 1));
    const double e = error<2>(sampled<2>(old, wave), make_grid<2>({37, 41}, Point<2>(0, 0), Point<2>(1, 1)), wave);
    CHECK(e < (9 + 4) / 8.0 / (n * n));
    if (n == 16) CHECK(e < 0.3 * coarse);
    coarse = e;
  }
}

TEST_CASE("old vertices keep their values, whatever those are; points outside take the nearest place's") {
  const auto old = corpus::shaken(make_grid<2>({6, 6}, Point<2>(0, 0), Point<2>(1, 1)), 0.16, 0.3, 3);
  const auto noise = [](const Point<2>& p) { return std::fmod(1e6 * p[0] + 3e5 * p[1], 1.0); };
  CHECK(error<2>(sampled<2>(old, noise), old, noise) < 1e-9);
  auto wider = make_grid<2>({3, 3}, Point<2>(-1, -1), Point<2>(2, 2));
  const auto x = sampled<2>(old, [](const Point<2>& p) { return p[0]; });
  const auto carried = *carry(x, wider);
  const auto on = solution_on(wider);
  for (std::size_t i = 0; i < on.points.size(); ++i)
    CHECK(carried[0].values[i] == Approx(std::min(1.0, std::max(0.0, on.points[i][0]))).margin(1e-12));
}

TEST_CASE("values of cells keep their integral nearly, and constants exactly; whole numbers stay whole") {
  const auto old = make_grid<2>({12, 12}, Point<2>(0, 0), Point<2>(1, 1));
  auto from = solution_on(old);
  FieldArray density{"density", true, false, 2, {}}, material{"material", true, true, 1, {}};
  double integral = 0.0;
  for (std::size_t c = 0; c < from.cells.size(); ++c) {
    const double v = 1 + std::sin(0.3 * static_cast<double>(c % 12));
    density.values.insert(density.values.end(), {v, 7.0});
    material.values.push_back(c % 12 < 6 ? 3 : 5);
    integral += v * volume(from, c);
  }
  from.fields = {density, material};
  const auto to = adapted(old, "h = .03 + .1*y");
  const auto carried = *carry(from, to);
  REQUIRE(carried.size() == 2);
  const auto on = solution_on(to);
  REQUIRE(carried[0].values.size() == 2 * on.cells.size());
  double sum = 0.0;
  for (std::size_t c = 0; c < on.cells.size(); ++c) {
    sum += carried[0].values[2 * c] * volume(on, c);
    CHECK(carried[0].values[2 * c + 1] == Approx(7).epsilon(1e-14));
    const double m = carried[1].values[c];
    CHECK((m == 3.0 || m == 5.0));
  }
  CHECK(sum == Approx(integral).epsilon(2e-3));
}

TEST_CASE("an array of the wrong length is refused by name") {
  auto from = sampled<2>(make_grid<2>({2, 2}, Point<2>(0, 0), Point<2>(1, 1)), [](const Point<2>& p) { return p[0]; });
  from.fields[0].values.pop_back();
  const auto carried = carry(from, make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(1, 1)));
  CHECK(carried.status().code == StatusCode::bad_input);
  CHECK(carried.status().message == "the array 'f' has 8 values, not 1 for each of the 9 points");
}

TEST_CASE("fields are written to VTK files and read back, groups apart") {
  for (const char* name : {"a.vtk", "a.vtu"})
    for (const bool binary : {false, true}) {
      INFO(name << binary);
      const auto mesh = make_grid<2>({3, 2}, Point<2>(0, 0), Point<2>(3, 2));
      const std::vector<FieldArray> fields{
          {"velocity", false, false, 3, {}}, {"id", true, true, 1, {}}, {"t<1", false, false, 1, {}}};
      auto with_values = fields;
      for (int i = 0; i < 36; ++i) with_values[0].values.push_back(0.1 * i - 1e-300);
      for (int i = 0; i < 6; ++i) with_values[1].values.push_back(i - 3);
      for (int i = 0; i < 12; ++i) with_values[2].values.push_back(-i / 3.0);
      Sink sink;
      REQUIRE(write_mesh_to(sink, mesh, name, {.binary = binary}, with_values).ok());
      const std::string bytes = sink.take();
      REQUIRE(read_mesh(name, bytes).ok());
      const auto back = read_solution(name, bytes);
      REQUIRE(back.ok());
      const auto& s = std::get<Solution<2>>(*back);
      CHECK(s.points == mesh.points);
      CHECK(s.cells == mesh.cells);
      REQUIRE(s.fields.size() == 3);
      for (const FieldArray& f : s.fields)
        for (const FieldArray& g : with_values)
          if (f.name == g.name) {
            CHECK(f.values == g.values);
            CHECK(f.of_cells == g.of_cells);
            CHECK(f.whole == g.whole);
            CHECK(f.components == g.components);
          }
    }
}

TEST_CASE("boundary facets have the values of their cells in VTK files") {
  const auto check = [](const auto& mesh, const auto& facets_of, std::size_t facets) {
    for (const char* name : {"a.vtk", "a.vtu"}) {
      std::vector<FieldArray> fields{{"q", true, false, 2, {}}, {"id", true, true, 1, {}}};
      const auto cells = static_cast<std::size_t>(mesh.cell_count());
      for (std::size_t c = 0; c < cells; ++c) {
        fields[0].values.insert(fields[0].values.end(), {0.5 + static_cast<double>(c), -1.0});
        fields[1].values.push_back(static_cast<double>(10 + c));
      }
      Sink sink;
      REQUIRE(write_mesh_to(sink, mesh, name, {}, fields).ok());
      const auto file = read_file_mesh(name, sink.take(), true);
      REQUIRE(file.ok());
      const auto& listed = facets_of(*file);
      REQUIRE(listed.place.size() == facets);
      for (std::size_t i = 0; i < facets; ++i) {
        const auto row = static_cast<std::size_t>(listed.place[i]);
        const auto cell = static_cast<std::size_t>(file->fields[1].values.at(row) - 10);
        REQUIRE(cell < cells);
        for (const Index v : listed.vertices[i]) {
          const auto& corners = mesh.cells[cell];
          CHECK(std::find(corners.begin(), corners.end(), v) != corners.end());
        }
        CHECK(file->fields[0].values.at(2 * row) == 0.5 + static_cast<double>(cell));
        CHECK(file->fields[0].values.at(2 * row + 1) == -1.0);
      }
    }
  };
  check(make_grid<2>({3, 2}, Point<2>(0, 0), Point<2>(3, 2)), [](const FileMesh& f) -> const auto& { return f.lines; }, 10);
  check(make_grid<3>({2, 1, 2}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)),
        [](const FileMesh& f) -> const auto& { return f.quads; }, 16);
}

TEST_CASE("arrays of a file that another program wrote are found: attributes, and data of cells of other kinds") {
  const std::string text =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
      "CELLS 2 8\n2 0 1\n4 0 1 2 3\nCELL_TYPES 2\n3\n9\n"
      "CELL_DATA 2\nSCALARS p double 1\nLOOKUP_TABLE default\n4 5\n"
      "POINT_DATA 4\nVECTORS u float\n1 2 3 4 5 6 7 8 9 10 11 12\n";
  const auto solution = read_solution("a.vtk", text);
  REQUIRE(solution.ok());
  const auto& s = std::get<Solution<2>>(*solution);
  REQUIRE(s.fields.size() == 2);
  CHECK(s.fields[0].name == "p");
  CHECK(s.fields[0].values == std::vector<double>{5});
  CHECK(s.fields[1].name == "u");
  CHECK(s.fields[1].components == 3);
  CHECK(s.fields[1].values.size() == 12);
}

}  // namespace transfer_test
