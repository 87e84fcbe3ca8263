#include "pillowmesh/mesh/edge_table.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/topology.h"

namespace edge_table_test {

using namespace pillowmesh;

namespace {

using Pairs = std::vector<std::array<VertexId, 2>>;

Pairs pairs(const EdgeTable& table) {
  Pairs p;
  for (Index e = 0; e < table.size(); ++e) p.push_back(table[e]);
  return p;
}

template <int Dim>
void check_all(const Mesh<Dim>& mesh) {
  std::vector<CellId> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0);
  const EdgeTable table(mesh, cells);
  Pairs expected = unique_edges(mesh);
  for (auto& e : expected)
    if (e[1] < e[0]) std::swap(e[0], e[1]);
  std::sort(expected.begin(), expected.end());
  CHECK(pairs(table) == expected);
  REQUIRE(table.size() == static_cast<Index>(expected.size()));
  for (Index e = 0; e < table.size(); ++e) {
    CHECK(table.find(expected[e][0], expected[e][1]) == e);
    CHECK(table.find(expected[e][1], expected[e][0]) == e);
  }
}

}  // namespace

TEST_CASE("an edge table has each edge of a mesh once, in order, and finds it by its vertices") {
  check_all(make_grid<2>({4, 3}, Point<2>(0, 0), Point<2>(1, 1)));
  check_all(make_grid<3>({2, 3, 2}, Point<3>(0, 0, 0), Point<3>(1, 1, 1)));
}

TEST_CASE("an edge table of some cells has their edges only") {
  const auto mesh = make_grid<2>({3, 1}, Point<2>(0, 0), Point<2>(1, 1));
  const std::vector<CellId> last{2};
  CHECK(pairs(EdgeTable(mesh, last)) == Pairs{{2, 3}, {2, 6}, {3, 7}, {6, 7}});
  CHECK(EdgeTable(mesh, {}).size() == 0);
}

}  // namespace edge_table_test
