#include "pillowmesh/quality/report.h"

#include <cmath>
#include <limits>
#include <string>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/gallery.h"

namespace report_test {

using namespace pillowmesh;

namespace {

Report measure_case(const char* name) {
  const Case* c = find_case(name);
  const AnyMesh mesh = *parse_primitive(c->mesh);
  if (c->dim == 2) return measure(std::get<Mesh<2>>(mesh), *MetricField<2>::from_formula(c->formula));
  return measure(std::get<Mesh<3>>(mesh), *MetricField<3>::from_formula(c->formula));
}

void check_lengths(const char* name, std::int64_t count, double min, double mean, double max, double cv) {
  CAPTURE(name);
  const Statistics s = measure_case(name).edge_length;
  CHECK(s.count == count);
  CHECK(s.min == Approx(min).margin(6e-4));
  CHECK(s.mean == Approx(mean).margin(6e-4));
  CHECK(s.max == Approx(max).margin(6e-3));
  CHECK(s.cv == Approx(cv).margin(6e-4));
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("the initial lengths of the paper's tables are reproduced") {
  // paper-notes.md: to all printed digits for Tables 1, 2 and 4, and what the misprints of 3 and 5 stand for.
  check_lengths("iso2d", 142, 1.000, 4.205, 20.0, 1.042);
  check_lengths("aniso2d", 142, 1.275, 3.875, 11.65, 0.703);
  check_lengths("circle2d", 220, 0.443, 2.119, 10.26, 1.249);
  check_lengths("linear3d", 300, 1.250, 2.456, 5.00, 0.497);
  check_lengths("sphere3d-paper", 540, 0.105, 0.465, 4.69, 1.418);
  check_lengths("sphere3d", 540, 0.106, 0.467, 3.42, 1.410);
}

TEST_CASE("a report counts what the mesh has") {
  const Report r = measure_case("linear3d");
  CHECK(r.dim == 3);
  CHECK(r.vertices == 125);
  CHECK(r.edges == 300);
  CHECK(r.cells == 64);
  CHECK(r.shape.count == 64);
  CHECK(r.shape_integral.count == 64);
  CHECK(r.scaled_jacobian_min == Approx(1.0));
  CHECK(r.scaled_jacobian_mean == Approx(1.0));
  CHECK(r.irregular_vertices == 0);
  CHECK(r.complexity == Approx(1250.0).epsilon(1e-3));
  CHECK(r.valid);
  CHECK(r.defect.empty());
}

TEST_CASE("a report without volumes has the same lengths and shapes") {
  const auto check = []<int Dim>(const char* name) {
    const Case* c = find_case(name);
    const auto mesh = std::get<Mesh<Dim>>(*parse_primitive(c->mesh));
    const auto field = *MetricField<Dim>::from_formula(c->formula);
    const Report all = measure(mesh, field), some = measure_lengths_and_shapes(mesh, field);
    CHECK(some.edge_length.mean == all.edge_length.mean);
    CHECK(some.shape.mean == all.shape.mean);
    CHECK(some.shape.min == all.shape.min);
    CHECK(some.scaled_jacobian_min == all.scaled_jacobian_min);
    CHECK(some.cells == all.cells);
    CHECK(all.complexity > 0.0);
    CHECK(some.complexity == 0.0);
    CHECK(some.shape_integral.count == 0);
  };
  check.operator()<2>("shock2d");
  check.operator()<3>("linear3d");
}

TEST_CASE("an inverted cell is reported, and still measured") {
  Mesh<2> mesh = make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(1, 1));
  for (Point<2>& p : mesh.points) {
    if ((p - Point<2>(1.0 / 3, 1.0 / 3)).norm() < 1e-9) p = Point<2>(0.9, 0.9);
  }
  const Report r = measure(mesh, *MetricField<2>::from_formula("h = 0.3"));
  CHECK_FALSE(r.valid);
  CHECK_FALSE(r.defect.empty());
  CHECK(r.edge_length.count == 24);
  CHECK(r.scaled_jacobian_min < 0.0);
  CHECK(contains(to_json(r), "\"valid\": false,\n  \"defect\": \""));
}

TEST_CASE("the JSON has the schema's keys in order") {
  Report r = measure_case("iso2d");
  r.seconds["total"] = 0.25;
  r.operations["layers"] = 12;
  r.peak_memory_bytes = 1024;
  const std::string json = to_json(r);
  std::size_t at = 0;
  for (const char* key : {"\"mesh\": {",
                          "\"dim\": 2",
                          "\"vertices\": 80",
                          "\"edges\": 142",
                          "\"cells\": 63",
                          "\"edge_length\": {",
                          "\"count\": 142",
                          "\"min\": ",
                          "\"mean\": ",
                          "\"max\": ",
                          "\"cv\": ",
                          "\"share_in_range\": ",
                          "\"shape\": {",
                          "\"shape_integral\": {",
                          "\"scaled_jacobian\": {",
                          "\"min\": 1",
                          "\"mean\": 1",
                          "\"irregular_vertices\": 0",
                          "\"complexity\": 1779.",
                          "\"valid\": true",
                          "\"seconds\": {",
                          "\"total\": 0.25",
                          "\"peak_memory_bytes\": 1024",
                          "\"operations\": {",
                          "\"layers\": 12"}) {
    CAPTURE(key);
    const std::size_t found = json.find(key, at);
    REQUIRE(found != std::string::npos);
    at = found;
  }
  CHECK(json.front() == '{');
  CHECK(json.back() == '}');
  CHECK_FALSE(contains(json, "defect"));
}

TEST_CASE("the JSON says how fields were carried, if any were") {
  Report r;
  CHECK_FALSE(contains(to_json(r), "fields"));
  r.fields = {{"heat", false, "multilinear interpolation"}, {"id", true, "the old value"}};
  CHECK(contains(to_json(r), "\"fields\": {\n    \"points\": {\n      \"heat\": \"multilinear interpolation\"\n    },\n"
                             "    \"cells\": {\n      \"id\": \"the old value\"\n    }\n  },"));
}

TEST_CASE("the JSON holds no NaN and no control characters") {
  Report r;
  r.edge_length.mean = std::numeric_limits<double>::quiet_NaN();
  r.complexity = std::numeric_limits<double>::infinity();
  r.defect = "a \"quoted\"\nback\\slash";
  const std::string json = to_json(r);
  CHECK(contains(json, "\"mean\": null"));
  CHECK(contains(json, "\"complexity\": null"));
  CHECK(contains(json, R"("defect": "a \"quoted\"\u000aback\\slash")"));
  CHECK_FALSE(contains(json, "nan"));
  CHECK_FALSE(contains(json, "inf\n"));
}

TEST_CASE("the process knows its peak memory") {
#ifdef __linux__
  CHECK(peak_memory_bytes() > 1'000'000);
#else
  CHECK(peak_memory_bytes() >= 0);
#endif
}

}  // namespace report_test
