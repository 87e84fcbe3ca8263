#include "pillowmesh/mesh/interfaces.h"

#include "../catch.h"
#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/primitives.h"

namespace interfaces_test {

using namespace pillowmesh;

namespace {

/// The grid's cells to the left of x = 1/2 are one region, the others another; `frozen` names a region to keep.
template <int Dim>
Index interface_of(std::array<int, Dim> n, bool two, const std::vector<std::string>& frozen = {}) {
  MeshInput<Dim> input = to_input(make_grid<Dim>(n, Point<Dim>::Zero(), Point<Dim>::Ones()));
  input.region_groups = {{1, "left"}, {2, "right"}};
  input.cell_region.clear();
  for (const auto& cell : input.cells) input.cell_region.push_back(two && input.points[cell[0]][0] >= 0.5 ? 1 : 0);
  BoundaryOptions options;
  options.freeze = frozen;
  return free_interface_facets(*make_mesh(std::move(input), options));
}

}  // namespace

TEST_CASE("facets between regions are counted unless they are frozen") {
  CHECK(interface_of<2>({4, 3}, true) == 3);
  CHECK(interface_of<3>({4, 3, 2}, true) == 6);
  CHECK(interface_of<2>({4, 3}, false) == 0);
  CHECK(interface_of<2>({4, 3}, true, {"left"}) == 0);
  CHECK(interface_of<3>({4, 3, 2}, true, {"2"}) == 0);
  CHECK(free_interface_facets(make_grid<2>({4, 3}, {0.0, 0.0}, {1.0, 1.0})) == 0);
}

}  // namespace interfaces_test
