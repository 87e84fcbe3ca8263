#include "pillowmesh/io/io.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>

#include "../catch.h"
#include "io_meshes.h"
#include "pillowmesh/mesh/number.h"
#include "pillowmesh/mesh/validate.h"

namespace files_test {

using namespace pillowmesh;
using namespace io_test;

namespace {

std::string written(double value) {
  char text[kNumberLength];
  return {text, static_cast<std::size_t>(format_double(value, text))};
}

double parsed(std::string_view text) {
  double value = -1.0;
  return parse_double(text, value) ? value : std::nan("");
}

template <int Dim>
void check_round_trip(const Mesh<Dim>& mesh) {
  const MeshInput<Dim> before = to_input(mesh);
  for (const Variant& v : all_variants()) {
    INFO(describe(v));
    const auto bytes = write_mesh(mesh, v.name, v.options);
    REQUIRE(bytes.ok());
    const auto back = read_mesh(v.name, *bytes);
    REQUIRE(back.status().message == "");
    REQUIRE(std::holds_alternative<Mesh<Dim>>(*back));
    const Mesh<Dim>& read = std::get<Mesh<Dim>>(*back);
    CHECK(validate(read).ok());
    const MeshInput<Dim> after = to_input(read);
    CHECK(after.points == before.points);  // bit for bit
    CHECK(tagged_cells(after) == tagged_cells(before));
    if (v.name.ends_with(".msh") && v.options.gmsh_version == 41) {
      // Version 4.1 lists the cells of each region together: their order changes.
    } else {
      CHECK(after.cells == before.cells);
    }
    CHECK(facet_tags(after) == facet_tags(before));
    for (VertexId i = 0; i < mesh.vertex_count(); ++i) CHECK(read.support[i].dim == mesh.support[i].dim);
    // What was read is written as it was; only the first time cells may change their order.
    const auto second = write_mesh(read, v.name, v.options);
    CHECK(*write_mesh(*read_mesh(v.name, *second), v.name, v.options) == *second);
  }
}

}  // namespace

TEST_CASE("A double survives being written and read bit for bit") {
  std::mt19937_64 random(20240607);
  for (int i = 0; i < 200000; ++i) {
    const std::uint64_t bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (i % 2 == 0) value = static_cast<double>(bits >> 11) * std::ldexp(1.0, -53 + static_cast<int>(bits % 60) - 30);
    if (!std::isfinite(value)) continue;
    const std::string text = written(value);
    const double back = parsed(text);
    if (std::memcmp(&back, &value, sizeof value) != 0 || text.size() >= kNumberLength) FAIL(text);
  }
  SUCCEED();
}

TEST_CASE("Numbers are written with the fewest digits of 15, 16, 17 that read back") {
  CHECK(written(0.1) == "0.1");
  CHECK(written(-0.0) == "-0");
  CHECK(written(1.0 / 3.0) == "0.3333333333333333");
  CHECK(written(0.1 + 0.2) == "0.30000000000000004");
  CHECK(written(1e-7) == "1e-7");
  CHECK(written(0.00012) == "0.00012");
  CHECK(written(123456.0) == "123456");
  CHECK(written(1.5e300) == "1.5e300");
  CHECK(written(5e-324) == "4.94065645841247e-324");
}

TEST_CASE("Numbers are read as the nearest double") {
  CHECK(parsed("9007199254740993") == 9007199254740992.0);  // a tie goes to the even mantissa
  CHECK(parsed("9007199254740993.00000000000000000000000000001") == 9007199254740994.0);
  CHECK(parsed("0.1000000000000000055511151231257827") == 0.1);
  CHECK(parsed("1e23") == 1e23);
  CHECK(parsed("8.5e-308") == 8.5e-308);
  CHECK(parsed("1d3") == 1000.0);
  CHECK(parsed("+.5") == 0.5);
  CHECK(parsed("1e400") == HUGE_VAL);
  for (const char* wrong : {"", ".", "1,5", "1e", "e5", "--1", "1 ", "0x10", "1.2.3"}) {
    INFO(wrong);
    CHECK(std::isnan(parsed(wrong)));
  }
}

TEST_CASE("Every format keeps cells, coordinates and groups of a quad mesh") { check_round_trip(grouped_mesh<2>()); }

TEST_CASE("Every format keeps cells, coordinates and groups of a hex mesh") { check_round_trip(grouped_mesh<3>()); }

TEST_CASE("Every format keeps an unstructured mesh with a curved boundary") {
  const auto mesh = read_mesh("plate_hole_v4.msh", read_data("plate_hole_v4.msh"));
  REQUIRE(mesh.ok());
  check_round_trip(std::get<Mesh<2>>(*mesh));
}

TEST_CASE("Gmsh and VTU files keep the names of groups") {
  for (const char* name : {"a.msh", "a.vtu"}) {
    INFO(name);
    const auto mesh = read_mesh(name, *write_mesh(grouped_mesh<2>(), name));
    REQUIRE(mesh.ok());
    const auto& m = std::get<Mesh<2>>(*mesh);
    std::vector<std::string> names;
    for (const Group& g : m.patch_groups) names.push_back(g.name);
    std::sort(names.begin(), names.end());
    CHECK(names == std::vector<std::string>{"xmax", "xmin", "ymax", "ymin"});
    REQUIRE(m.region_groups.size() == 2);
    CHECK(m.region_groups[0].name == "right part");  // by tag: 4, 7
    CHECK(m.region_groups[1].name == "left");
  }
}

TEST_CASE("A mesh without groups comes back without groups, but for the number that Gmsh needs") {
  MeshInput<2> input = grouped_grid<2>();
  input.facets.clear();
  input.cell_region.clear();
  input.region_groups.clear();
  const Mesh<2> mesh = *make_mesh<2>(input);
  for (const Variant& v : all_variants()) {
    INFO(describe(v));
    const auto back = read_mesh(v.name, *write_mesh(mesh, v.name, v.options));
    REQUIRE(back.ok());
    for (const Group& g : std::get<Mesh<2>>(*back).patch_groups) CHECK(g.tag == 0);
    CHECK(std::get<Mesh<2>>(*back).region_groups.at(0).tag == (v.name.ends_with(".msh") ? 1 : 0));
  }
}

TEST_CASE("A vertex that the input pins on a straight side stays pinned in Medit and Gmsh files") {
  MeshInput<2> input = grouped_grid<2>();
  const VertexId middle = 1;  // on ymin, between two collinear edges
  input.corners.push_back(middle);
  const Mesh<2> mesh = *make_mesh<2>(input);
  REQUIRE(mesh.support[middle].dim == 0);
  for (const char* name : {"a.mesh", "a.meshb", "a.msh"}) {
    INFO(name);
    const auto back = read_mesh(name, *write_mesh(mesh, name));
    REQUIRE(back.ok());
    CHECK(std::get<Mesh<2>>(*back).support[middle].dim == 0);
  }
}

TEST_CASE("A file cut at any byte is refused or means the same mesh") {
  const Mesh<2> mesh = grouped_mesh<2>();
  const MeshInput<2> whole = to_input(mesh);
  for (const Variant& v : all_variants()) {
    INFO(describe(v));
    const std::string bytes = *write_mesh(mesh, v.name, v.options);
    int accepted = 0;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const auto cut = read_mesh(v.name, std::string_view(bytes).substr(0, n));
      if (!cut.ok()) {
        if (cut.status().code != StatusCode::bad_input || !cut.status().message.starts_with(v.name))
          FAIL("cut at " << n << ": " << cut.status().message);
        continue;
      }
      ++accepted;
      const MeshInput<2> part = to_input(std::get<Mesh<2>>(*cut));
      if (part.points != whole.points || sorted_cells(part) != sorted_cells(whole))
        FAIL("cut at " << n << " gives another mesh");
    }
    CHECK(accepted < static_cast<int>(bytes.size() / 3));
  }
}

TEST_CASE("The ending chooses the format, in upper case too, and an unknown one is refused with those that are known") {
  const std::string bytes = *write_mesh(grouped_mesh<2>(), "a.vtu");
  CHECK(read_mesh("folder.d/A.VTU", bytes).ok());
  CHECK(lacks(refusal("a.stl", bytes), {"a.stl", "'.stl' is not known", ".vtu"}) == "");
  CHECK(lacks(refusal("folder.vtu/mesh", bytes), {"no ending"}) == "");
  CHECK(write_mesh(grouped_mesh<2>(), "a.stl").status().code == StatusCode::usage);
  CHECK(lacks(write_mesh(grouped_mesh<2>(), "a.mesh", {true, 41}).status().message, {".meshb"}) == "");
}

TEST_CASE("An empty file is refused in every format") {
  for (const Variant& v : all_variants()) {
    INFO(describe(v));
    CHECK(lacks(refusal(v.name, ""), {v.name, "empty"}) == "");
    CHECK(lacks(refusal(v.name, "\n"), {v.name}) == "");
  }
}

TEST_CASE("A failed write leaves neither a half file nor a temporary one, and replaces nothing") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("pillowmesh_io_test_" + std::to_string(std::random_device{}()));
  fs::create_directories(folder / "taken.vtu" / "inside");  // a folder cannot be replaced by a file
  const Mesh<2> mesh = grouped_mesh<2>();
  CHECK(lacks(write_mesh_file(mesh, (folder / "taken.vtu").string()).message, {"cannot be written"}) == "");
  CHECK(lacks(write_mesh_file(mesh, (folder / "missing" / "a.vtu").string()).message, {"cannot be written"}) == "");
  CHECK(std::distance(fs::directory_iterator(folder), {}) == 1);

  const std::string path = (folder / "a.vtu").string();
  REQUIRE(write_mesh_file(mesh, path).ok());
  CHECK(std::distance(fs::directory_iterator(folder), {}) == 2);
  const auto back = read_mesh_file(path);
  REQUIRE(back.ok());
  CHECK(to_input(std::get<Mesh<2>>(*back)).points == to_input(mesh).points);
  CHECK(lacks(read_mesh_file((folder / "none.vtu").string()).status().message, {"none.vtu: cannot be read"}) == "");
  CHECK(lacks(read_mesh_file((folder / "taken.vtu").string()).status().message, {"cannot be read"}) == "");
  fs::remove_all(folder);
}

}  // namespace files_test
