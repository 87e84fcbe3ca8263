#include "pillowmesh/io/vtk.h"

#include "../catch.h"
#include "io_meshes.h"
#include "pillowmesh/io/codec.h"

namespace vtk_test {

using namespace pillowmesh;
using namespace io_test;

namespace {

const std::string kSquareVtk = R"(# vtk DataFile Version 2.0
a title, anything
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 4 double
0 0 0
1 0 0
1 1 0
0 1 0

CELLS 3 10
2 0 1
4 0 1 2 3
1 2

CELL_TYPES 3
3
9
1

POINT_DATA 4
VECTORS v float
0 0 0  1 1 1  2 2 2  3 3 3
CELL_DATA 3
FIELD FieldData 1
other 2 3 int
1 2 3 4 5 6
SCALARS CellEntityIds int 1
LOOKUP_TABLE default
7
8
9
)";

const std::string kSquareVtu = R"(<?xml version="1.0"?>
<!-- a comment with <tags> -->
<VTKFile type='UnstructuredGrid' version="0.1" byte_order="LittleEndian">
<UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="2">
<PointData/>
<CellData><DataArray type="Int32" Name="gmsh:physical" format="ascii">
7 8
</DataArray></CellData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0  1 0 0  1 1 0  0 1 0
</DataArray></Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">2 6</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">3 9</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

template <int Dim = 2>
MeshInput<Dim> read(const std::string& name, const std::string& bytes) {
  const auto mesh = read_mesh(name, bytes);
  INFO(mesh.status().message);
  REQUIRE(mesh.ok());
  REQUIRE(std::holds_alternative<Mesh<Dim>>(*mesh));
  return to_input(std::get<Mesh<Dim>>(*mesh));
}

std::string unhex(std::string_view hex) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(digit(hex[i]) * 16 + digit(hex[i + 1]));
  return bytes;
}

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The four arrays of a square as appended data: the header of the file up to '_' and the bytes behind it.
std::string appended(bool raw, bool compressed) {
  std::string data;
  std::vector<std::size_t> offsets;
  const auto add = [&](const std::string& bytes) {
    offsets.push_back(data.size());
    std::string head, body;
    if (compressed) {  // one stored deflate block: 78 01, final, length, its complement
      body = unhex("7801") + '\1';
      append(body, static_cast<std::uint16_t>(bytes.size()));
      append(body, static_cast<std::uint16_t>(~bytes.size()));
      body += bytes + std::string(4, '\0');
      for (std::size_t v : {std::size_t{1}, bytes.size(), std::size_t{0}, body.size()})
        append(head, static_cast<std::uint32_t>(v));
    } else {
      append(head, static_cast<std::uint32_t>(bytes.size()));
      body = bytes;
    }
    if (raw) {
      data += head + body;
      return;
    }
    struct Text {
      std::string& s;
      Text& operator<<(char c) {
        s += c;
        return *this;
      }
    } out{data};
    Base64Encoder encoder;
    encoder.add(out, head.data(), head.size());
    if (compressed) encoder.finish(out);  // VTK encodes the head of compressed data by itself
    encoder.add(out, body.data(), body.size());
    encoder.finish(out);
  };
  std::string bytes;
  for (double v : {0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.}) append(bytes, v);
  add(bytes);
  bytes.clear();
  for (std::int32_t v : {0, 1, 2, 3}) append(bytes, v);
  add(bytes);
  bytes.clear();
  append(bytes, std::int32_t{4});
  add(bytes);
  add("\x09");
  const auto array = [&](const char* type, const char* name, int i) {
    return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"appended\" offset=\"" +
           std::to_string(offsets[static_cast<std::size_t>(i)]) + "\"/>";
  };
  return std::string("<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"") +
         (compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
         "><UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>" + array("Float64", "Points", 0) +
         "</Points><Cells>" + array("Int32", "connectivity", 1) + array("Int32", "offsets", 2) +
         array("UInt8", "types", 3) + "</Cells></Piece></UnstructuredGrid><AppendedData encoding=\"" +
         (raw ? "raw" : "base64") + "\">\n_" + data + "\n</AppendedData></VTKFile>";
}

}  // namespace

TEST_CASE("A legacy VTK file is read with its group array among other data") {
  const MeshInput<2> input = read("a.vtk", kSquareVtk);
  CHECK(input.cells.size() == 1);
  CHECK(cell_tags(input) == std::vector<Index>{8});
  CHECK(facet_tags(input)[0] == std::pair(std::vector<Index>{0, 1}, Index{7}));
}

TEST_CASE("Pixels and voxels are quads and hexahedra in corner-bit order") {
  const std::string pixel = with(with(kSquareVtk, "4 0 1 2 3", "4 0 1 3 2"), "\n9\n", "\n8\n");
  CHECK(read("a.vtk", pixel).cells == read("a.vtk", kSquareVtk).cells);
  const std::string voxel = R"(# vtk DataFile Version 3.0
t
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 8 float
0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1
CELLS 1 9
8 0 1 2 3 4 5 6 7
CELL_TYPES 1
11
)";
  CHECK(read<3>("a.vtk", voxel).cells == std::vector<Corners<3>>{{0, 1, 2, 3, 4, 5, 6, 7}});
}

TEST_CASE("Version 5 of the legacy format is read") {
  const std::string text = R"(# vtk DataFile Version 5.1
t
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 4 float
0 0 0 1 0 0 1 1 0 0 1 0
METADATA
INFORMATION 0

CELLS 3 6
OFFSETS vtktypeint64
0 2 6
CONNECTIVITY vtktypeint64
0 1 0 1 2 3
CELL_TYPES 2
3
9
CELL_DATA 2
SCALARS group int
LOOKUP_TABLE default
7 8
)";
  const MeshInput<2> input = read("a.vtk", text);
  CHECK(input.cells.size() == 1);
  CHECK(cell_tags(input) == std::vector<Index>{8});
}

TEST_CASE("A wrong legacy VTK file is refused with the place and the reason") {
  struct Wrong {
    const char* from;
    const char* to;
    const char* place;
    const char* reason;
  };
  const Wrong wrongs[] = {
      {"# vtk DataFile", "# vdk DataFile", "line 1", "# vtk DataFile Version"},
      {"Version 2.0", "Version 17.0", "line 1", "version '17.0'"},
      {"ASCII", "ASCI", "line 3", "expected ASCII or BINARY"},
      {"UNSTRUCTURED_GRID", "POLYDATA", "line 4", "only UNSTRUCTURED_GRID"},
      {"POINTS 4 double", "POINTS 4 quad", "line 5", "data type 'quad'"},
      {"POINTS 4 double", "POINTS 400000000 double", "line 5", "promises 400000000 points"},
      {"POINTS 4 double", "POINTS 5 double", "line 11", "expected a value, found 'CELLS'"},
      {"1 1 0\n", "1 nan 0\n", "a.vtk", "vertex 2 is not a finite number"},
      {"1 1 0\n", "1 1 0.1\n", "a.vtk", "plane z = constant"},
      {"CELLS 3 10", "CELLS 3 11", "line", "promises 11 numbers but has 10"},
      {"CELLS 3 10", "CELLS 3 2", "line 11", "less than their number"},
      {"4 0 1 2 3", "5 0 1 2 3", "line 16", "expected a vertex number, found 'CELL_TYPES'"},
      {"4 0 1 2 3", "4 0 1 2 7", "line 13", "names vertex 7"},
      {"4 0 1 2 3", "4 0 1 2 -1", "line 13", "names vertex -1"},
      {"4 0 1 2 3", "4 0 1 2 2", "line 13", "names vertex 2 twice"},
      {"4 0 1 2 3", "4 3 2 1 0", "line 13", "inside out"},
      {"CELL_TYPES 3\n3\n", "CELL_TYPES 3\n5\n", "cell 0", "has 2 vertices, but its VTK type 5 has 3"},
      {"\n9\n", "\n23\n", "line 13", "VTK type 23"},
      {"\n9\n", "\n10\n", "line 13", "1 tetrahedron and no quads"},
      {"CELL_TYPES 3\n3\n", "CELL_TYPES 2\n", "a.vtk", "3 cells but 2 cell types"},
      {"CELL_TYPES", "CELL_TIPES", "line 16", "expected a keyword such as CELLS, found 'CELL_TIPES'"},
      {"POINTS 4 double\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "", "a.vtk", "no POINTS"},
  };
  for (const Wrong& w : wrongs) {
    INFO(w.from << " -> " << w.to);
    CHECK(lacks(refusal("a.vtk", with(kSquareVtk, w.from, w.to)), {"a.vtk", w.place, w.reason}) == "");
  }
}

TEST_CASE("A VTU file is read with comments, either quotes and a group array") {
  const MeshInput<2> input = read("a.vtu", kSquareVtu);
  CHECK(cell_tags(input) == std::vector<Index>{8});
  CHECK(facet_tags(input)[0] == std::pair(std::vector<Index>{0, 1}, Index{7}));
}

TEST_CASE("Appended data is read raw and as base64, plain and compressed") {
  for (const bool raw : {false, true})
    for (const bool compressed : {false, true}) {
      INFO((raw ? "raw" : "base64") << (compressed ? " compressed" : ""));
      CHECK(read("a.vtu", appended(raw, compressed)).cells == std::vector<Corners<2>>{{0, 1, 3, 2}});
    }
}

TEST_CASE("A wrong VTU file is refused with the place and the reason") {
  struct Wrong {
    const char* from;
    const char* to;
    const char* place;
    const char* reason;
  };
  const Wrong wrongs[] = {
      {"<VTKFile", "<File", "line", "<VTKFile>"},
      {"'UnstructuredGrid'", "'PolyData'", "line 3", "only UnstructuredGrid"},
      {"version=\"0.1\"", "compressor=\"vtkLZ4DataCompressor\"", "line 3", "vtkLZ4DataCompressor"},
      {"</Piece>", "</Piece><Piece>", "line", "several pieces"},
      {"NumberOfCells=\"2\"", "NumberOfCells=\"two\"", "line 5", "NumberOfCells"},
      {"NumberOfCells=\"2\"", "NumberOfCells=\"1000000000\"", "a.vtu", "NumberOfCells is 1000000000"},
      {"NumberOfPoints=\"4\"", "NumberOfPoints=\"5\"", "a.vtu", "has 4 entries, but NumberOfPoints is 5"},
      {"0 0 0  1 0 0", "0 0 0  1 0", "a.vtu", "not three per point"},
      {"0 0 0  1 0 0", "0 0 0  1 O 0", "line 11", "expected a number, found 'O'"},
      {"0 0 0  1 0 0", "0 0 0  1 nan 0", "a.vtu", "vertex 1 is not a finite number"},
      {"0 1 0 1 2 3", "0 1 0 1 2 9", "a.vtu", "names vertex 9"},
      {"0 1 0 1 2 3", "0 1 0 1 2 99999999999", "a.vtu", "names vertex -"},
      {"2 6", "2 7", "cell 1", "ends outside"},
      {"2 6", "6 2", "cell 0", "has 6 vertices, but its VTK type 3 has 2"},
      {"3 9", "3", "a.vtu", "'types' has 1 entries"},
      {"3 9", "3 28", "a.vtu", "VTK type 28"},
      {"Name=\"offsets\"", "Name=\"ofsets\"", "a.vtu", "'offsets' is missing"},
      {"</VTKFile>", "", "a.vtu", "truncated"},
      {"type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\"", "type=\"Float32\" format=\"binary\"", "line 10",
       "truncated or malformed"},
  };
  for (const Wrong& w : wrongs) {
    INFO(w.from << " -> " << w.to);
    CHECK(lacks(refusal("a.vtu", with(kSquareVtu, w.from, w.to)), {"a.vtu", w.place, w.reason}) == "");
  }
  for (const bool compressed : {false, true}) {
    const std::string good = appended(true, compressed);
    std::string lying = good;
    lying.replace(good.find("\n_") + 2, 4, std::string("\xff\xff\xff\x7f", 4));  // a size or block count of 2^31
    CHECK(lacks(refusal("a.vtu", lying), {"truncated or malformed"}) == "");
  }
}

TEST_CASE("Base64 decodes pieces that were encoded one after the other") {
  std::string bytes;
  CHECK(decode_base64("TWF\n uTQ==YWI=", 100, bytes));  // "ManM" + "ab"
  CHECK(bytes == "ManMab");
  bytes.clear();
  CHECK(decode_base64("TWFuTWFu", 4, bytes));
  CHECK(bytes == "ManM");
  CHECK_FALSE(decode_base64("TW*u", 100, bytes));
}

TEST_CASE("Deflate streams of all three kinds expand, and damaged ones are refused") {
  // Python: zlib.compress(b"quad " * 20, 9)
  std::string quads;
  for (int i = 0; i < 20; ++i) quads += "quad ";
  const std::string fixed = unhex("78da2b2c4d4c5128a42d010021af23dd");
  // Python: zlib.compress(" ".join(str(i * i % 251) for i in range(256)).encode(), 9)
  std::string squares;
  for (int i = 0; i < 256; ++i) squares.append(i == 0 ? "" : " ").append(std::to_string(i * i % 251));
  const std::string dynamic = unhex(
      "78da3d938b91033108435b510906fcedbfb17b623337936437b60021c45068ea29b672a9b6e6d39ebaa11843913ce7e416c4"
      "030206d4d52945703f7d3e9455caa30332b9e199fcadd0bd608e725cbeba4bb1923b6a9238805f122c3ddeced2d14b5e383a"
      "94770840622631043c62404e722e4e2994142a634319571786031a8f073dc06b3c512193b483cb494c194b4753cb1548344a"
      "9cafad4d844b5b09ce1f8582d23c1ea7dc14b9cc7a0e6d82ddbd95a28345564ee35ab4d4de7264b89001a58d0a8854307193"
      "8b2c660c0b0b42f0026e35296c7597a9f2ee3348bed22da11193d8fc567ffa2f875c0130aef18e73bcf3bc2f6fe74f17bb5f"
      "e566001333caa6679666dbac7f2d6477e4ced6d7a7fb75dffbb60a560351ac8d35ca4f312b670eb95a4f64b5bad54a5b7184"
      "b7fe1e83a7e1a9783a54f3b03cb3d113ec419e1eab197bca9e365337553c602be08817ed0ffbc46d8e68f7981319e8f1b4bb"
      "6cb2f5390ed6e0ed43fbf13aa63d6aaf625993cad33eb69f6de7d31eb7d7dbf3781f715984d53be1dde81df1aee4b73b0845"
      "8f80ab578b057b6c5a68fc6fdc1fccc3a04a");
  const std::string stored = unhex("7801") + std::string("\1\3\0\xfc\xff", 5) + "abc";
  std::string out;
  CHECK(inflate_zlib(fixed, 100, out));
  CHECK(out == quads);
  CHECK(inflate_zlib(dynamic, squares.size(), out));  // onto the end
  CHECK(out == quads + squares);
  CHECK(inflate_zlib(stored, 3, out));
  CHECK(out == quads + squares + "abc");
  out.clear();
  CHECK_FALSE(inflate_zlib(fixed, 99, out));  // longer than promised
  CHECK_FALSE(inflate_zlib(fixed.substr(0, 8), 100, out));
  for (std::size_t n = 0; n + 4 < dynamic.size(); ++n) {  // without its checksum it is whole
    out.clear();
    CHECK_FALSE(inflate_zlib(dynamic.substr(0, n), squares.size(), out));
  }
  CHECK_FALSE(inflate_zlib(unhex("79") + fixed.substr(1), 100, out));
}

}  // namespace vtk_test
