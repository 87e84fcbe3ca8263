#include "pillowmesh/adapt/longest_edge.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/metric/length.h"

namespace longest_edge_test {

using namespace pillowmesh;

TEST_CASE("there are longer edges where the longest edge says so") {
  for (const Case& c : gallery()) {
    if (c.dim != 2) continue;
    CAPTURE(std::string(c.name));
    const auto field = *MetricField<2>::from_formula(c.formula);
    const Mesh<2> mesh = std::get<Mesh<2>>(*parse_primitive(c.mesh));
    const double longest = longest_edge(mesh, field);
    CHECK_FALSE(longer_edges(mesh, field, 0.5 * longest).empty());
    CHECK_FALSE(longer_edges(mesh, field, 0.99 * longest).empty());
    CHECK(longer_edges(mesh, field, 1.01 * longest).empty());
    if (c.name == "circle-1") continue;  // a layer narrower than a quarter of the edges across it
    for (const double share : {0.3, 0.6, 0.8}) {
      const auto found = longer_edges(mesh, field, share * longest);
      for (const auto& e : unique_edges(mesh)) {
        const double l = edge_length(field, mesh.points[e[0]], mesh.points[e[1]]);
        if (std::fabs(l - share * longest) > 0.01 * l)
          CHECK((std::find(found.begin(), found.end(), e) != found.end()) == (l > share * longest));
      }
    }
  }
}

TEST_CASE("longer edges between vertices that have not been touched are left out, and no others") {
  const auto field = *MetricField<2>::from_formula("h = 0.1");
  const Mesh<2> mesh = std::get<Mesh<2>>(*parse_primitive("grid:4,4:0,1,0,1"));
  std::vector<unsigned char> touched(mesh.points.size(), 0);
  CHECK(longer_edges(mesh, field, 2.0, touched).empty());
  touched[6] = 1;  // a vertex inside
  std::vector<std::array<VertexId, 2>> expected = unique_edges(mesh);
  std::erase_if(expected, [](const auto& e) { return e[0] != 6 && e[1] != 6; });
  CHECK(expected.size() == 4);
  CHECK(longer_edges(mesh, field, 2.0, touched) == expected);
  touched.assign(mesh.points.size(), 1);
  CHECK(longer_edges(mesh, field, 2.0, touched) == longer_edges(mesh, field, 2.0));
}

TEST_CASE("frozen edges do not count as longer, and a mesh without edges has none") {
  const auto field = *MetricField<2>::from_formula("h = if(x < 0.1, 0.1, 1)");
  const auto grid = [](const std::vector<std::string>& frozen) {
    return std::get<Mesh<2>>(*parse_primitive("grid:2,1:0,2,0,1", frozen));
  };
  // The left side is 10 long, the edges at it 1.9.
  CHECK_FALSE(longer_edges(grid({}), field, 2.0).empty());
  CHECK(longer_edges(grid({"xmin"}), field, 2.0).empty());
  CHECK_FALSE(longer_edges(grid({"xmin"}), field, 1.5).empty());
  CHECK(longer_edges(Mesh<2>{}, field, 0.1).empty());
}

}  // namespace longest_edge_test
