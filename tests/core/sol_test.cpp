#include "pillowmesh/io/sol.h"

#include "../catch.h"
#include "pillowmesh/io/background_file.h"

namespace sol_test {

using namespace pillowmesh;

namespace {

Expected<SolFile> read(std::string_view text, std::string_view name = "a.sol") {
  return read_sol(name, {text.data(), text.size()});
}

std::string refusal(std::string_view text, std::size_t vertices) {
  const auto sol = read(text);
  if (!sol) return sol.status().message;
  const auto metric = metric_of_sol<2>(*sol, "a.sol", vertices);
  return metric ? "" : metric.status().message;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::string kHead = "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n";

}  // namespace

TEST_CASE("sizes and tensors are read as metrics") {
  const auto sizes = metric_of_sol<2>(*read(kHead + "2\n1 1\n0.5\n0.1\nEnd\n"), "a.sol", 2);
  REQUIRE(sizes);
  CHECK((*sizes)[1] == SymTensor<2>::isotropic(0.1));
  const auto both = read(kHead + "1\n2 1 3\n7  4 1 9\nEnd\n");
  REQUIRE(both);
  CHECK((*metric_of_sol<2>(*both, "a.sol", 1))[0] == SymTensor<2>{{4.0, 1.0, 9.0}});  // a tensor says more than a size
}

TEST_CASE("the six entries of a tensor in space are in Medit's order") {
  const auto sol = read("MeshVersionFormatted 2\nDimension\n3\nSolAtVertices\n1\n1 3\n11 0.12 22 0.13 0.23 33\nEnd");
  REQUIRE(sol);
  const SymTensor<3> M = (*metric_of_sol<3>(*sol, "a.sol", 1))[0];
  CHECK(M(0, 0) == 11.0);
  CHECK(M(0, 1) == 0.12);
  CHECK(M(1, 1) == 22.0);
  CHECK(M(0, 2) == 0.13);
  CHECK(M(1, 2) == 0.23);
  CHECK(M(2, 2) == 33.0);
}

TEST_CASE("files come back bit for bit, text and binary") {
  std::vector<SymTensor<3>> tensors(5, SymTensor<3>::isotropic(1.0 / 3.0));
  tensors[3](0, 2) = 0.1;
  for (const char* name : {"a.sol", "a.solb"}) {
    const std::string bytes = write_sol(sol_of_metric<3>(tensors), name);
    const auto sol = read(bytes, name);
    INFO(name << ": " << sol.status().message);
    REQUIRE(sol);
    CHECK(*metric_of_sol<3>(*sol, name, 5) == tensors);
    const auto cut = read(std::string_view(bytes).substr(0, bytes.size() * 2 / 3), name);
    REQUIRE_FALSE(cut);
    CHECK(cut.status().code == StatusCode::bad_input);
  }
}

TEST_CASE("sections that are no metric are passed over") {
  const auto sol = read("MeshVersionFormatted 2\nDimension 2\nTime\n0.25\n" + kHead.substr(kHead.find("Sol")) +
                        "1\n1 1\n0.5\nIterations 3\nEnd\n");
  REQUIRE(sol);
  CHECK(sol->fields[0].values == std::vector<double>{0.5});
}

TEST_CASE("what is no metric is refused with line and vertex") {
  CHECK(contains(refusal(kHead + "3\n1 1\n1\n0\n1\nEnd\n", 3), "a.sol, line 7: vertex 2: the size 0"));
  CHECK(contains(refusal(kHead + "1\n1 1\ninf\nEnd\n", 1), "vertex 1: the size infinity"));
  CHECK(contains(refusal(kHead + "1\n1 1\nnan\nEnd\n", 1), "the size nan"));
  CHECK(contains(refusal(kHead + "1\n1 1\n-2\nEnd\n", 1), "the size -2"));
  CHECK(contains(refusal(kHead + "1\n1 3\n1 2 1\nEnd\n", 1), "vertex 1: the tensor (1, 2, 1) is not positive definite"));
  CHECK(contains(refusal(kHead + "1\n1 3\n1 nan 1\nEnd\n", 1), "not finite"));
  CHECK(contains(refusal(kHead + "2\n1 1\n1 1\nEnd\n", 3), "values for 2 vertices, but its mesh has 3"));
  CHECK(contains(refusal(kHead + "1\n1 2\n1 1\nEnd\n", 1), "only vectors"));
  CHECK(contains(refusal(kHead + "9\n1 1\n1 1\nEnd\n", 9), "a.sol"));
  CHECK(contains(refusal(kHead + "1\n1 1\n1 1\nEnd\n", 1), "more numbers than its count"));
  CHECK(contains(refusal(kHead + "1\n1 7\n1\nEnd\n", 1), "type should be 1"));
  CHECK(contains(refusal("MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n1\n1 1\n1\nEnd\n", 1), "3-dimensional"));
  CHECK(contains(refusal("MeshVersionFormatted 2\nDimension 2\nEnd\n", 1), "no values at vertices"));
  CHECK(contains(refusal("", 1), "empty"));
}

TEST_CASE("backgrounds may be triangles, tetrahedra, quads and hexahedra") {
  const auto read_background_text = [](std::string_view text) { return read_background("b.mesh", {text.data(), text.size()}); };
  const auto flat = read_background_text(
      "MeshVersionFormatted 2\nDimension 2\nVertices\n5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\nTriangles\n1\n2 5 3 0\n"
      "Quadrilaterals\n1\n1 2 3 4 0\nEnd\n");
  REQUIRE(flat);
  REQUIRE(std::holds_alternative<NodalMetric<2>>(*flat));
  const auto& f = std::get<NodalMetric<2>>(*flat);
  CHECK(f.points.size() == 5);
  REQUIRE(f.simplices.size() == 3);
  double area = 0.0;
  for (const auto& s : f.simplices) area += 0.5 * simplex_determinant<2>(f.points, s);
  CHECK(area == Approx(1.5));
  const auto solid = read_background_text(
      "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTriangles\n1\n1 2 3 0\n"
      "Tetrahedra\n1\n1 2 3 4 0\nEnd\n");
  REQUIRE(solid);
  REQUIRE(std::holds_alternative<NodalMetric<3>>(*solid));
  CHECK(std::get<NodalMetric<3>>(*solid).simplices == std::vector<Simplex<3>>{{0, 1, 2, 3}});
  const auto wrong = read_background_text(
      "MeshVersionFormatted 2\nDimension 2\nVertices\n2\n0 0 0\n1 0 0\nTriangles\n1\n1 2 3 0\nEnd\n");
  CHECK(contains(wrong.status().message, "triangle 0"));
  const auto none = read_background_text("MeshVersionFormatted 2\nDimension 2\nVertices\n1\n0 0 0\nEnd\n");
  CHECK(contains(none.status().message, "it is no background"));
}

}  // namespace sol_test
