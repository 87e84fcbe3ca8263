#include "pillowmesh/mesh/primitives.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "../catch.h"
#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/sections.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/quality/jacobian.h"

namespace primitives_test {

using namespace pillowmesh;

namespace {

template <int Dim>
Mesh<Dim> primitive(const char* spec) {
  const auto mesh = parse_primitive(spec);
  INFO(spec << ": " << mesh.status().message);
  REQUIRE(mesh.ok());
  return std::get<Mesh<Dim>>(*mesh);
}

/// Number of boundary facets by the name of their patch. Each name must be one patch.
template <int Dim>
std::map<std::string, int> sides(const Mesh<Dim>& mesh) {
  std::map<std::string, int> count;
  std::map<std::string, PatchId> patch;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; f < Cell<Dim>::facets; ++f) {
      if (!mesh.on_boundary(c, f)) continue;
      const std::string name = mesh.patch_groups[mesh.patch_of(c, f)].name;
      ++count[name];
      CHECK(patch.emplace(name, mesh.patch_of(c, f)).first->second == mesh.patch_of(c, f));
    }
  return count;
}

/// How many vertices live on corners, curves, surfaces, inside: by the dimension of their support.
template <int Dim>
std::vector<int> supports(const Mesh<Dim>& mesh) {
  std::vector<int> count(Dim + 1, 0);
  for (const auto& s : mesh.support) ++count[s.dim];
  return count;
}

/// The vertices of one named side lie at this distance from the z axis.
template <int Dim>
void check_radius(const Mesh<Dim>& mesh, const std::string& side, double radius) {
  int seen = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; f < Cell<Dim>::facets; ++f) {
      if (!mesh.on_boundary(c, f) || mesh.patch_groups[mesh.patch_of(c, f)].name != side) continue;
      for (const VertexId v : mesh.facet_vertices(c, f)) {
        const auto& p = mesh.points[v];
        CHECK(std::sqrt(p[0] * p[0] + p[1] * p[1]) == Approx(radius).epsilon(1e-15));
        ++seen;
      }
    }
  CHECK(seen > 0);
}

template <int Dim>
double least_scaled_jacobian(const Mesh<Dim>& mesh) {
  double least = 1.0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) least = std::min(least, scaled_jacobian(mesh, c));
  return least;
}

bool usage_says(const char* spec, const std::string& part) {
  const auto mesh = parse_primitive(spec);
  INFO(spec << ": " << mesh.status().message);
  CHECK(mesh.status().code == StatusCode::usage);
  return !mesh.ok() && mesh.status().message.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a grid has the counts of a box and is valid") {
  const auto quads = make_grid<2>({3, 2}, Point<2>(0, 0), Point<2>(3, 2));
  CHECK(quads.cell_count() == 6);
  CHECK(quads.vertex_count() == 12);
  CHECK(unique_edges(quads).size() == 3 * 3 + 4 * 2);  // horizontal + vertical
  CHECK(validate(quads).ok());
  const auto hexes = make_grid<3>({2, 3, 4}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  CHECK(hexes.cell_count() == 24);
  CHECK(unique_edges(hexes).size() == 2 * 4 * 5 + 3 * 3 * 5 + 4 * 3 * 4);
  CHECK(validate(hexes).message == "");
}

TEST_CASE("the sides of a grid are patches and its corners are pinned") {
  const auto mesh = make_grid<2>({3, 2}, Point<2>(0, 0), Point<2>(3, 2));
  CHECK(mesh.patch_groups.size() == 4);
  int pinned = 0, sliding = 0;
  for (const auto& s : mesh.support) pinned += s.dim == 0, sliding += s.dim == 1;
  CHECK(pinned == 4);
  CHECK(sliding == 2 * (2 + 1));
  const auto box = make_grid<3>({2, 2, 2}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  CHECK(box.patch_groups.size() == 6);
  int dims[4] = {};
  for (const auto& s : box.support) ++dims[s.dim];
  CHECK(dims[0] == 8);   // corners
  CHECK(dims[1] == 12);  // one inside each edge of the box
  CHECK(dims[2] == 6);
  CHECK(dims[3] == 1);
  CHECK(box.geometry->curve_patches.size() == 12);
}

TEST_CASE("a disk is a core with rings, round to the last digit") {
  const auto disk = primitive<2>("ogrid:4,2:3");
  CHECK(disk.cell_count() == 4 * 4 + 2 * 16);
  CHECK(disk.vertex_count() == 5 * 5 + 2 * 16);
  CHECK(sides(disk) == std::map<std::string, int>{{"side", 16}});
  CHECK(supports(disk) == std::vector<int>{0, 16, 41});
  CHECK(validate(disk).message == "");
  CHECK(least_scaled_jacobian(disk) > 0.8);
  check_radius(disk, "side", 3.0);
}

TEST_CASE("a cylinder has a smooth side between two round curves without corners") {
  const auto cylinder = primitive<3>("ogrid:2,1,3:1,0,2");
  CHECK(cylinder.cell_count() == 3 * (4 + 8));
  CHECK(sides(cylinder) == std::map<std::string, int>{{"side", 24}, {"zmin", 12}, {"zmax", 12}});
  CHECK(supports(cylinder) == std::vector<int>{0, 2 * 8, 2 * 8 + 2 * 9, 2 * 9});
  CHECK(cylinder.geometry->curve_patches.size() == 2);
  CHECK(validate(cylinder).message == "");
  check_radius(cylinder, "side", 1.0);
}

TEST_CASE("a ring has two round sides") {
  const auto ring = primitive<2>("ring:12,3:1,2");
  CHECK(ring.cell_count() == 36);
  CHECK(sides(ring) == std::map<std::string, int>{{"inner", 12}, {"outer", 12}});
  CHECK(supports(ring) == std::vector<int>{0, 24, 24});
  check_radius(ring, "inner", 1.0);
  check_radius(ring, "outer", 2.0);
  const auto tube = primitive<3>("ring:3,1,2:1,2,-1,1");  // the coarsest
  CHECK(validate(tube).message == "");
  CHECK(tube.geometry->curve_patches.size() == 4);
}

TEST_CASE("a cube minus a cylinder has plane sides, a round one, and lines that leave it radially") {
  const auto quarter = primitive<3>("quarter:3,2,4:0.5,1,0,1");
  CHECK(quarter.cell_count() == 2 * 3 * 2 * 4);
  CHECK(sides(quarter) ==
        std::map<std::string, int>{
            {"hole", 24}, {"ymin", 8}, {"xmax", 12}, {"ymax", 12}, {"xmin", 8}, {"zmin", 12}, {"zmax", 12}});
  CHECK(supports(quarter)[0] == 10);
  CHECK(quarter.geometry->curve_patches.size() == 15);  // a prism over a pentagon
  CHECK(validate(quarter).message == "");
  CHECK(least_scaled_jacobian(quarter) > 0.6);
  check_radius(quarter, "hole", 0.5);
  for (CellId c = 0; c < quarter.cell_count(); ++c) {
    const auto& a = quarter.points[quarter.cells[c][0]];
    const auto& b = quarter.points[quarter.cells[c][1]];
    CHECK(std::abs(a[0] * b[1] - a[1] * b[0]) < 1e-15);
    for (int f = 0; f < 6; ++f) {
      if (!quarter.on_boundary(c, f)) continue;
      const std::string side = quarter.patch_groups[quarter.patch_of(c, f)].name;
      for (const VertexId v : quarter.facet_vertices(c, f)) {
        if (side == "xmin" || side == "xmax") CHECK(quarter.points[v][0] == (side == "xmax"));
        if (side == "ymin" || side == "ymax") CHECK(quarter.points[v][1] == (side == "ymax"));
      }
    }
  }
}

TEST_CASE("an L-prism has six sides, two of which meet at the inner edge") {
  const auto ell = primitive<3>("lprism:5,2,3:2,0.5,0,1");
  CHECK(ell.cell_count() == (5 * 2 + 3 * 2) * 3);
  CHECK(
      sides(ell) ==
      std::map<std::string, int>{
          {"xmin", 15}, {"xmid", 9}, {"xmax", 6}, {"ymin", 15}, {"ymid", 9}, {"ymax", 6}, {"zmin", 16}, {"zmax", 16}});
  CHECK(supports(ell)[0] == 12);
  CHECK(validate(ell).message == "");
  int at_inner_edge = 0;
  for (const auto& p : ell.points) at_inner_edge += p[0] == 0.5 && p[1] == 0.5;
  CHECK(at_inner_edge == 4);
}

TEST_CASE("the mirror images of a round mesh have the same digits") {
  const auto disk = disk_section(3, 2, 0.7);
  for (const auto& p : disk.points)
    for (const auto& image : {Point<2>(-p[0], p[1]), Point<2>(p[0], -p[1]), Point<2>(p[1], p[0])})
      CHECK(std::count(disk.points.begin(), disk.points.end(), image) == 1);
}

TEST_CASE("coarse and fine primitives are valid in 2D and 3D") {
  for (const char* spec :
       {"ogrid:1,1:1", "ogrid:1,5:1", "ogrid:9,1:1", "ring:3,1:1,2", "ring:40,1:1,1.01", "quarter:1,1:0.5,1",
        "quarter:1,1:0.99,1", "quarter:7,3:0.01,1", "lprism:2,1:1,0.9", "lprism:9,1:1,0.01"}) {
    INFO(spec);
    CHECK(validate(primitive<2>(spec)).message == "");
    std::string solid = spec;
    solid.insert(solid.find(':', solid.find(':') + 1), ",2");
    solid += ",-1,1";
    CHECK(validate(primitive<3>(solid.c_str())).message == "");
  }
}

TEST_CASE("a specification is told from a file name") {
  for (const char* spec : {"grid:1,1:0,1,0,1", "ogrid:", "ring:x", "quarter:", "lprism:1"}) CHECK(is_primitive(spec));
  for (const char* name : {"grid", "grid.mesh", "c:grid", "grids:1", "", ":"}) CHECK_FALSE(is_primitive(name));
}

TEST_CASE("a specification is read, and refused with the reason") {
  CHECK(primitive<2>("grid:10,5:-1,1,0,.5").cell_count() == 50);
  CHECK(primitive<3>("grid:2,2,2:0,1,0,1,0,1").cell_count() == 8);
  CHECK(usage_says("grid:10,5", "lacks its bounds"));
  CHECK(usage_says("ogrid:4,2", "lacks its sizes"));
  CHECK(usage_says("grid:10,a:0,1,0,1", "'a' is not a number"));
  CHECK(usage_says("quarter:3,2:0.5,one", "'one'"));
  CHECK(usage_says("ring:3,2:0.5,nan", "'nan'"));
  CHECK(usage_says("grid:0,5:0,1,0,1", "whole numbers of at least 1"));
  CHECK(usage_says("ogrid:2,0:1", "whole numbers of at least 1"));
  CHECK(usage_says("lprism:2.5,1:1,.5", "whole numbers of at least 1"));
  CHECK(usage_says("grid:2,2:1,0,0,1", "low < high"));
  CHECK(usage_says("ogrid:2,2:0", "radius R must be above 0"));
  CHECK(usage_says("ring:2,2:1,2", "at least 3 cells"));
  CHECK(usage_says("ring:8,2:2,1", "R0 < R1"));
  CHECK(usage_says("quarter:2,2:1,1", "R < S"));
  CHECK(usage_says("lprism:2,2:1,.5", "M < N"));
  CHECK(usage_says("lprism:3,2:1,1", "A < S"));
  CHECK(usage_says("ogrid:2,2,2:1,1,1", "Z0 < Z1"));
  CHECK(usage_says("ogrid:2,2,2:1", "3 counts and 1 sizes"));
  CHECK(usage_says("ogrid:2,2:1,0,1", "an ogrid is written ogrid:N,M[,NZ]:R[,Z0,Z1]"));
  CHECK(usage_says("grid:1000000,1000:0,1,0,1", "100 million"));
  CHECK(usage_says("ogrid:10000,1,100:1,0,1", "100 million"));
  CHECK(usage_says("sphere:4:1", "quarter:N,M[,NZ]:R,S[,Z0,Z1]"));
}

TEST_CASE("a mesh survives the way out to a file's view and back") {
  const auto box = make_grid<3>({2, 1, 1}, Point<3>(0, 0, 0), Point<3>(2, 1, 1));
  const auto again = make_mesh(to_input(box));
  REQUIRE(again.ok());
  CHECK(again->cells == box.cells);
  CHECK(again->patch_groups.size() == 6);
  CHECK(again->support == box.support);
}

}  // namespace primitives_test
