#include "pillowmesh/io/gmsh.h"

#include "../catch.h"
#include "io_meshes.h"
#include "pillowmesh/mesh/validate.h"

namespace gmsh_test {

using namespace pillowmesh;
using namespace io_test;

namespace {

// One unit square with sparse node numbers, two physical groups of edges, and one pinned vertex.
const std::string kSquare22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 5 "wall, outer"
2 9 "plate"
$EndPhysicalNames
$Nodes
4
10 0 0 0
20 1 0 0
3000000 1 1 0
5 0 1 0
$EndNodes
$Elements
5
1 15 2 1 1 10
2 1 2 5 1 10 20
3 1 2 6 2 20 3000000
4 3 2 9 1 10 20 3000000 5
5 3 2 8 1 10 20 3000000 5
$EndElements
)";

const std::string kSquare41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
1 1 1 0
1 0 0 0 1 3
1 0 0 0 1 0 0 2 -5 6 0
1 0 0 0 1 1 0 1 9 1 1
$EndEntities
$Nodes
2 4 1 4
1 1 1 2
1
2
0 0 0 .25
1 0 0 .75
2 1 0 2
4
3
0 1 0
1 1 0
$EndNodes
$Comments
anything $Nodes
$EndComments
$Elements
3 3 1 3
0 1 15 1
1 1
1 1 1 1
2 1 2
2 1 3 1
3 1 2 3 4
$EndElements
)";

}  // namespace

TEST_CASE("Gmsh's own files are read with their physical groups") {
  for (const char* name : {"lshape_v2.msh", "lshape_v4.msh"}) {
    INFO(name);
    const auto mesh = read_mesh(name, read_data(name));
    REQUIRE(mesh.status().message == "");
    const auto& m = std::get<Mesh<2>>(*mesh);
    CHECK(m.cell_count() == 108);
    CHECK(validate(m).ok());
    const MeshInput<2> input = to_input(m);
    REQUIRE(input.region_groups.size() == 1);
    CHECK(input.region_groups[0].name == "domain");
    int inflow = 0, walls = 0;
    for (const auto& f : input.facets) {
      const std::string& group = input.facet_groups[f.group].name;
      inflow += group == "inflow" ? 1 : 0;
      walls += group == "walls" ? 1 : 0;
    }
    CHECK(inflow == 10);  // 10 edges of the file carry tag 2, 34 carry tag 3
    CHECK(walls == 34);
  }
  const auto plate = read_mesh("plate_hole_v4.msh", read_data("plate_hole_v4.msh"));
  REQUIRE(plate.ok());
  CHECK(std::get<Mesh<2>>(*plate).cell_count() == 180);
  CHECK(std::get<Mesh<2>>(*plate).region_groups.at(0).name == "plate");
}

TEST_CASE("Both versions of a Gmsh file give the same mesh") {
  const auto v2 = read_mesh("a.msh", read_data("plate_hole_v2.msh"));
  const auto v4 = read_mesh("a.msh", read_data("plate_hole_v4.msh"));
  REQUIRE(v2.ok());
  REQUIRE(v4.ok());
  CHECK(std::get<Mesh<2>>(*v2).cells == std::get<Mesh<2>>(*v4).cells);
  CHECK(std::get<Mesh<2>>(*v2).points == std::get<Mesh<2>>(*v4).points);
}

TEST_CASE("A mesh of quads and triangles is refused with the count of both") {
  CHECK(lacks(refusal("mixed.msh", read_data("mixed_tri_quad_v2.msh")),
              {"mixed.msh, line 95", "17 triangles", "58 quads"}) == "");
}

TEST_CASE("Sparse node numbers, repeated elements and physical points of version 2.2 are understood") {
  const auto mesh = read_mesh("a.msh", kSquare22);
  REQUIRE(mesh.status().message == "");
  const auto& m = std::get<Mesh<2>>(*mesh);
  CHECK(m.cell_count() == 1);  // the quad stands there once for each of its groups: the first counts
  CHECK(m.region_groups.at(0).name == "plate");
  const auto facets = facet_tags(to_input(m));
  REQUIRE(facets.size() == 4);
  CHECK(facets[0] == std::pair(std::vector<Index>{0, 1}, Index{5}));
  CHECK(facets[2] == std::pair(std::vector<Index>{1, 2}, Index{6}));
  CHECK(m.support[0].dim == 0);
}

TEST_CASE("Entities, parametric nodes and unknown sections of version 4.1 are understood") {
  const auto mesh = read_mesh("a.msh", kSquare41);
  REQUIRE(mesh.status().message == "");
  const auto& m = std::get<Mesh<2>>(*mesh);
  CHECK(m.cell_count() == 1);
  CHECK(m.region_groups.at(0).tag == 9);
  CHECK(facet_tags(to_input(m))[0] == std::pair(std::vector<Index>{0, 1}, Index{5}));  // of -5 and 6, the first
}

TEST_CASE("A wrong Gmsh file is refused with its line and the reason") {
  struct Wrong {
    const std::string& text;
    const char* from;
    const char* to;
    const char* line;
    const char* reason;
  };
  const Wrong wrongs[] = {
      {kSquare22, "$MeshFormat\n", "$NOD\n", "line 1", "$MeshFormat"},
      {kSquare22, "2.2 0 8", "4 0 8", "line 2", "version '4' is not supported: save as 4.1 or 2.2"},
      {kSquare22, "2.2 0 8", "2.2 3 8", "line 2", "file type"},
      {kSquare22, "2.2 0 8", "2.2 1 4", "line 2", "size 4"},
      {kSquare22, "1 5 \"wall, outer\"", "1 5 wall", "line 6", "quotes"},
      {kSquare22, "20 1 0 0", "20 1 zero 0", "line 12", "expected a coordinate, found 'zero'"},
      {kSquare22, "20 1 0 0", "20 1 -inf 0", "line 12", "not a finite number"},
      {kSquare22, "20 1 0 0", "10 1 0 0", "line", "node 10 is defined twice"},
      {kSquare22, "20 1 0 0", "-20 1 0 0", "line", "not positive"},
      {kSquare22, "$Nodes\n4\n", "$Nodes\n400000000\n", "line 10", "promises 400000000 nodes"},
      {kSquare22, "$Nodes\n4\n", "$Nodes\n3\n", "line 14", "expected '$EndNodes', found '5'"},
      {kSquare22, "$Nodes\n4\n", "$Nodes\n5\n", "line 15", "found '$EndNodes'"},
      {kSquare22, "$Elements\n5\n", "$Elements\n7\n", "line", "found '$EndElements'"},
      {kSquare22, "4 3 2 9 1 10 20 3000000 5", "4 3 2 9 1 10 20 30 5", "line 21", "node 30"},
      {kSquare22, "4 3 2 9 1 10 20 3000000 5", "4 3 2 9 1 10 20 20 5", "line 21", "twice"},
      {kSquare22, "4 3 2 9 1 10 20 3000000 5", "4 99 2 9 1 10 20 30 5", "line 21", "element type 99"},
      {kSquare22, "4 3 2 9 1 10 20 3000000 5", "4 3 -1 9 1 10 20 30 5", "line 21", "negative"},
      {kSquare22, "3 1 2 6 2 20 3000000", "3 10 2 6 2 5 5 5 5 5 5 5 5 5", "line 20", "second-order quad"},
      {kSquare22, "$Nodes", "$Cells", "line 9", "the file ends before '$EndCells'"},
      {kSquare22, "$EndElements\n", "", "line", "truncated"},
      {kSquare41, "2 4 1 4", "2 5 1 4", "line", "promises 5 nodes but lists 4"},
      {kSquare41, "3 3 1 3", "3 4 1 3", "line", "promises 4 elements but lists 3"},
      {kSquare41, "1 1 1 2\n1\n", "1 1 1 2000000000\n1\n", "line 12", "promises 2000000000 nodes"},
      {kSquare41, "2 1 3 1\n", "2 1 16 1\n", "line 34", "expected a node number"},
      {kSquare41, "3 1 2 3 4\n", "3 4 3 2 1\n", "line 33", "inside out"},
      {kSquare41, "$Entities\n1 1 1 0", "$Entities\n1 1 99999999999 0", "line 5", "99999999999 entities"},
      {kSquare41, "$Entities", "$PartitionedEntities", "line 4", "partition"},
      {kSquare41, "$EndComments", "", "line", "truncated"},
  };
  for (const Wrong& w : wrongs) {
    INFO(w.from << " -> " << w.to);
    CHECK(lacks(refusal("a.msh", with(w.text, w.from, w.to)), {"a.msh", w.line, w.reason}) == "");
  }
}

TEST_CASE("A wrong binary Gmsh file is refused with its byte and the reason") {
  for (const int version : {22, 41}) {
    const std::string good = *write_mesh(grouped_mesh<3>(), "a.msh", {true, version});
    INFO(version);
    CHECK(lacks(refusal("a.msh", with(good, std::string("\1\0\0\0\n$End", 9), std::string("\2\0\0\0\n$End", 9))),
                {"byte-order"}) == "");
    CHECK(lacks(refusal("a.msh", good.substr(0, good.find("$EndNodes") - 50)), {"byte"}) == "");
    CHECK(lacks(refusal("a.msh", good.substr(0, good.size() - 20)), {"byte"}) == "");
  }
}

TEST_CASE("Every element of a written Gmsh file has a physical group, as meshio and Gmsh's own saving ask for") {
  const auto plate = read_mesh("plate_hole_v4.msh", read_data("plate_hole_v4.msh"));
  REQUIRE(plate.ok());
  const std::string text = *write_mesh(*plate, "a.msh", {false, 22});
  CHECK(lacks(text, {"\n1 3 2 1 1 "}) == "");      // number, quad, two tags: physical 1, entity 1
  CHECK(lacks(text, {"$Elements\n180\n"}) == "");  // the boundary has no groups: it is left out
}

}  // namespace gmsh_test
