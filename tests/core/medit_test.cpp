#include "pillowmesh/io/medit.h"

#include "../catch.h"
#include "io_meshes.h"

namespace medit_test {

using namespace pillowmesh;
using namespace io_test;

namespace {

// Two unit squares side by side:
//   6---5---4
//   | 1 | 2 |
//   1---2---3
const std::string kTwoSquares = R"(MeshVersionFormatted 2
Dimension
2
# corners first
Vertices
6
0 0 0
1 0 0
2 0 0
2 1 0
1 1 0
0 1 0

Quadrilaterals
2
1 2 5 6 10
2 3 4 5 20

Edges
3
1 2 1
2 3 1
3 4 2

Corners
1
2

End
)";

}  // namespace

TEST_CASE("A Medit file is read with references, corners, comments and any order of sections") {
  const auto mesh = read_mesh("two.mesh", kTwoSquares);
  REQUIRE(mesh.status().message == "");
  const auto& m = std::get<Mesh<2>>(*mesh);
  CHECK(m.vertex_count() == 6);
  CHECK(m.cell_count() == 2);
  CHECK(m.cells[0] == Corners<2>{0, 1, 5, 4});  // corner bits: the last two change places
  const MeshInput<2> input = to_input(m);
  CHECK(cell_tags(input) == std::vector<Index>{10, 20});
  int first = 0, second = 0, none = 0;
  for (const auto& [vertices, tag] : facet_tags(input)) ++(tag == 1 ? first : tag == 2 ? second : none);
  CHECK(first == 2);
  CHECK(second == 1);
  CHECK(none == 3);
  CHECK(m.support[1].dim == 0);  // pinned, though the boundary is straight there
}

TEST_CASE("A planar Medit file of dimension 3 is a 2D mesh") {
  const std::string lifted = R"(MeshVersionFormatted 1
Dimension 3
Vertices
4
0 0 2.5 0
1 0 2.5 0
1 1 2.5 0
0 1 2.5 0
Quadrilaterals
1
1 2 3 4 0
Triangles
0
End
)";
  CHECK(std::holds_alternative<Mesh<2>>(*read_mesh("a.mesh", lifted)));
  CHECK(lacks(refusal("a.mesh", with(lifted, "1 1 2.5", "1 1 2.6")), {"plane z = constant"}) == "");
}

TEST_CASE("Sections that do not matter are skipped") {
  CHECK(refusal("a.mesh", with(kTwoSquares, "Edges\n", "RequiredEdges\n1\n1\nNormals\n1\n-1e-3 .5\n\nEdges\n")) ==
        "accepted");
  CHECK(refusal("a.mesh", with(kTwoSquares, "\nEnd\n", "\n")) == "accepted");  // some programs leave out End
}

TEST_CASE("A wrong Medit file is refused with its line and the reason") {
  struct Wrong {
    const char* from;
    const char* to;
    const char* line;
    const char* reason;
  };
  // Line 15 holds the second cell's count, 16 and 17 the cells.
  const Wrong wrongs[] = {
      {"MeshVersionFormatted", "MeshFormat", "line 1", "MeshVersionFormatted"},
      {"MeshVersionFormatted 2", "MeshVersionFormatted 9", "line 1", "version 9"},
      {"Dimension\n2", "Dimension\n4", "line 3", "dimension 4"},
      {"Dimension\n2\n", "\n\n", "line 5", "Dimension should come before"},
      {"1 0 0\n", "1 x 0\n", "line 8", "expected a coordinate, found 'x'"},
      {"1 0 0\n", "1 nan 0\n", "line 8", "not a finite number"},
      {"1 0 0\n", "1 1e999 0\n", "line 8", "not a finite number"},
      {"1 0 0\n", "1 -1e200 0\n", "a.mesh", "vertex 2 has a coordinate that is not a number of at most 1e100"},
      {"1 0 0\n", "1 0 0 0\n", "line 12", "expected a keyword, found '0'"},
      {"1 2 5 6 10", "1 2 5 99 10", "line 16", "names vertex 99, but the file has 6"},
      {"1 2 5 6 10", "0 2 5 6 10", "line 16", "names vertex 0"},
      {"1 2 5 6 10", "-3 2 5 6 10", "line 16", "names vertex -3"},
      {"1 2 5 6 10", "1 2 5 5 10", "line 16", "names vertex 5 twice"},
      {"1 2 5 6 10", "1 2 5.5 6 10", "line 16", "expected a vertex number, found '5.5'"},
      {"1 2 5 6 10", "1 2 5 99999999999 10", "line 16", "does not fit in 32 bits"},
      {"1 2 5 6 10", "6 5 2 1 10", "line 16", "inside out"},
      {"Quadrilaterals\n2\n", "Quadrilaterals\n4000000000\n", "line 15", "promises 4000000000 quads"},
      {"Quadrilaterals\n2\n", "Quadrilaterals\n-2\n", "line 15", "negative"},
      {"Quadrilaterals\n2\n", "Quadrilaterals\n3\n", "line 19", "found 'Edges'"},
      {"Quadrilaterals\n2\n", "Quadrilaterals\n1\n", "line 17", "expected a keyword, found '2'"},
      {"Vertices\n6\n", "Vertices\n1000000000\n", "line 6", "promises 1000000000 vertices"},
      {"Edges\n3\n", "Triangles\n1\n1 2 5 0\nEdges\n3\n", "line 21", "mixes 1 triangle with 2 quads"},
      {"Edges\n3\n", "Hexahedra\n1\n1 2 3 4 5 6 7 8 0\nEdges\n3\n", "line 21", "names vertex 7"},
      {"Quadrilaterals\n2\n1 2 5 6 10\n2 3 4 5 20\n", "Triangles\n1\n1 2 5 0\n", "line 16", "no quads"},
      {"Quadrilaterals\n2\n1 2 5 6 10\n2 3 4 5 20\n", "Tetrahedra\n1\n1 2 5 6 0\n", "line 16", "1 tetrahedron"},
      {"Quadrilaterals\n2\n1 2 5 6 10\n2 3 4 5 20\n", "QuadrilateralsQ2\n0\n", "a.mesh", "no quads"},
      {"Quadrilaterals\n2\n1 2 5 6 10\n2 3 4 5 20\n", "", "a.mesh", "no quads and no hexahedra"},
      {"Corners\n1\n2", "Corners\n1\n77", "a.mesh", "corner vertex 77 does not exist"},
      {"\nEnd\n", "\nEn", "line", "truncated"},
  };
  for (const Wrong& w : wrongs) {
    const std::string text = with(kTwoSquares, w.from, w.to);
    INFO(w.from << " -> " << w.to);
    CHECK(lacks(refusal("a.mesh", text), {"a.mesh", w.line, w.reason}) == "");
  }
}

TEST_CASE("Hanging nodes are refused") {
  // One square beside two half ones: vertex 4 hangs on the edge 2-6.
  const std::string text = R"(MeshVersionFormatted 2
Dimension 2
Vertices
8
0 0 0
1 0 0
2 0 0
1 .5 0
2 .5 0
1 1 0
2 1 0
0 1 0
Quadrilaterals
3
1 2 6 8 0
2 3 5 4 0
4 5 7 6 0
End
)";
  CHECK(lacks(refusal("a.mesh", text), {"a.mesh", "hang"}) == "");
}

TEST_CASE("A binary Medit file is read in versions 1 to 4 and in the other byte order") {
  // Version 1 (float, 32-bit positions) and its byte-swapped twin, made by hand for one square.
  for (const int version : {1, 2, 3, 4})
    for (const bool swapped : {false, true}) {
      INFO("version " << version << (swapped ? " swapped" : ""));
      std::string bytes;
      const auto put = [&](auto value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        if (swapped) std::reverse(raw, raw + sizeof value);
        bytes.append(raw, sizeof value);
      };
      const auto position = [&](std::size_t size) {
        const std::size_t wide = version >= 3 ? 8 : 4;
        const std::size_t next = bytes.size() + wide + size;
        version >= 3 ? put(static_cast<std::int64_t>(next)) : put(static_cast<std::int32_t>(next));
      };
      const auto id = [&](int v) { version == 4 ? put(std::int64_t{v}) : put(std::int32_t{v}); };
      const auto real = [&](double v) { version == 1 ? put(static_cast<float>(v)) : put(v); };
      const std::size_t id_size = version == 4 ? 8 : 4, real_size = version == 1 ? 4 : 8;
      put(std::int32_t{1});
      put(std::int32_t{version});
      put(std::int32_t{3});  // Dimension
      position(4);
      put(std::int32_t{2});
      put(std::int32_t{60});  // a section that does not matter
      position(3);
      bytes += "abc";
      put(std::int32_t{4});  // Vertices
      position(id_size + 4 * (2 * real_size + id_size));
      id(4);
      for (const auto& [x, y] : {std::pair(0., 0.), {1., 0.}, {1., 1.}, {0., 1.}}) {
        real(x);
        real(y);
        id(0);
      }
      put(std::int32_t{7});  // Quadrilaterals
      position(6 * id_size);
      for (int v : {1, 1, 2, 3, 4, 5}) id(v);
      put(std::int32_t{54});  // End
      position(0);
      const auto mesh = read_mesh("a.meshb", bytes);
      REQUIRE(mesh.status().message == "");
      CHECK(std::get<Mesh<2>>(*mesh).cell_count() == 1);
      CHECK(std::get<Mesh<2>>(*mesh).region_groups.at(0).tag == 5);
    }
}

TEST_CASE("A wrong binary Medit file is refused with its byte and the reason") {
  const std::string good = *write_mesh(grouped_mesh<3>(), "a.meshb");
  CHECK(lacks(refusal("a.meshb", kTwoSquares), {"byte-order mark"}) == "");
  CHECK(lacks(refusal("a.meshb", good.substr(0, 4) + '\7' + good.substr(5)), {"version 7"}) == "");
  CHECK(lacks(refusal("a.meshb", good.substr(0, good.size() / 2)), {"byte", "truncated"}) == "");
}

}  // namespace medit_test
