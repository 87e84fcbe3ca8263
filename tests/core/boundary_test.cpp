#include "pillowmesh/mesh/boundary.h"

#include <set>

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/mesh/validate.h"

namespace boundary_test {

using namespace pillowmesh;

namespace {

template <int Dim>
std::array<int, Dim + 1> vertices_by_support(const Mesh<Dim>& mesh) {
  std::array<int, Dim + 1> count{};
  for (const auto& s : mesh.support) ++count[s.dim];
  return count;
}

MeshInput<2> square(int n) {
  MeshInput<2> in;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) in.points.push_back(Point<2>(i, j));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      in.cells.push_back({a, a + 1, a + n + 1, a + n + 2});
    }
  return in;
}

}  // namespace

TEST_CASE("without groups, sides and corners of a domain are found by angle") {
  const auto mesh = *make_mesh(square(4));
  CHECK(mesh.patch_groups.size() == 4);
  CHECK(vertices_by_support(mesh) == std::array<int, 3>{4, 12, 9});
  const auto ell = corpus::ell(6);
  CHECK(ell.patch_groups.size() == 6);
  CHECK(vertices_by_support(ell)[0] == 6);
  const auto ring = corpus::ring(24, 2, true);  // turns by 15 degrees
  CHECK(ring.patch_groups.size() == 2);
  CHECK(vertices_by_support(ring)[0] == 0);
  const auto half = corpus::ring(9, 2, false);
  CHECK(half.patch_groups.size() == 4);
  CHECK(vertices_by_support(half)[0] == 4);
}

TEST_CASE("how sharp a corner must be is an option") {
  MeshInput<2> in;  // an octagon's half: it turns by 45 degrees
  const auto at = [](double r, int i) { return Point<2>(r * std::cos(i * 0.785398163397448), r * std::sin(i * 0.785398163397448)); };
  for (int i = 0; i <= 4; ++i) in.points.push_back(at(1, i));
  for (int i = 0; i <= 4; ++i) in.points.push_back(at(2, i));
  for (int i = 0; i < 4; ++i) in.cells.push_back({i + 1, i, i + 6, i + 5});
  const auto sharp = *make_mesh(in);
  CHECK(vertices_by_support(sharp)[0] == 10);
  const auto blunt = *make_mesh(in, {.corner_cosine = 0.5});
  CHECK(vertices_by_support(blunt)[0] == 4);
}

TEST_CASE("groups part a straight side, and a vertex that the file pins is a corner") {
  auto in = square(4);
  in.facet_groups = {{7, "inlet"}, {8, "wall"}};
  in.facets = {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 3}, 1}, {{3, 4}, 1}};
  const auto mesh = *make_mesh(in);
  CHECK(mesh.support[2].dim == 0);  // where inlet and wall meet
  CHECK(mesh.support[1].dim == 1);
  CHECK(mesh.patch_groups.size() == 5);
  const auto length = checks::boundary_by_group(mesh);
  CHECK(length.at(7) == 2.0);
  CHECK(length.at(8) == 2.0);
  in.corners = {10};  // on the left side
  CHECK((*make_mesh(in)).support[10].dim == 0);
  CHECK((*make_mesh(in)).patch_groups.size() == 6);
}

TEST_CASE("two pieces of one group stay one group in what is written") {
  auto in = square(4);
  in.facet_groups = {{3, "wall"}};
  in.facets = {{{0, 1}, 0}, {{1, 2}, 0}, {{20, 21}, 0}};  // at the bottom and, apart from it, at the top
  const auto mesh = *make_mesh(in);
  const auto out = to_input(mesh);
  int walls = 0;
  for (const auto& g : out.facet_groups) walls += g.tag == 3;
  CHECK(walls == 1);
  CHECK(out.facets.size() == 16);
}

TEST_CASE("a mesh goes out and comes in again the same") {
  const auto check = [](const auto& mesh) {
    const auto again = make_mesh(to_input(mesh));
    REQUIRE(again.ok());
    CHECK(again->points == mesh.points);
    CHECK(again->cells == mesh.cells);
    CHECK(again->patch_groups.size() == mesh.patch_groups.size());
    CHECK(vertices_by_support(*again) == vertices_by_support(mesh));
    CHECK(validate(*again).ok());
  };
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    check(mesh);
  }
  for (const auto& [name, mesh] : corpus::meshes<3>()) {
    INFO(name);
    check(mesh);
  }
}

TEST_CASE("dead cells and vertices without cells are not written") {
  auto mesh = make_grid<2>({3, 1}, Point<2>(0, 0), Point<2>(3, 1));
  mesh.cells[2].fill(kNone);
  const auto out = to_input(mesh);
  CHECK(out.cells.size() == 2);
  CHECK(out.points.size() == 6);
  for (const auto& cell : out.cells)
    for (const VertexId v : cell) CHECK(v < 6);
}

TEST_CASE("a box has 8 corners, 12 curves and 6 patches, and each curve knows its patches") {
  const auto mesh = make_grid<3>({4, 3, 2}, Point<3>(0, 0, 0), Point<3>(4, 3, 2));
  CHECK(mesh.patch_groups.size() == 6);
  CHECK(mesh.geometry->curve_patches.size() == 12);
  const std::set<std::array<PatchId, 2>> pairs(mesh.geometry->curve_patches.begin(), mesh.geometry->curve_patches.end());
  CHECK(pairs.size() == 12);
  for (const auto& [a, b] : pairs) CHECK(a < b);
  // 3 + 2 + 1 inner vertices on the three directions of edges, four of each.
  CHECK(vertices_by_support(mesh) == std::array<int, 4>{8, 4 * (3 + 2 + 1), 2 * (3 * 2 + 3 * 1 + 2 * 1), 3 * 2 * 1});
}

TEST_CASE("the pieces of the boundary's geometry are linked within their patch, and end at its corners") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    const auto& g = *mesh.geometry;
    for (std::size_t i = 0; i < g.facets.size(); ++i)
      for (int end = 0; end < 2; ++end) {
        const Index n = g.neighbours[i][end];
        if (n == kNone) continue;
        CHECK(g.patch[n] == g.patch[i]);
        const auto& f = g.facets[n];
        const VertexId shared = g.facets[i][end];
        CHECK((f[0] == shared || f[1] == shared));
        CHECK(g.neighbours[n][f[0] == shared ? 0 : 1] == static_cast<Index>(i));
      }
  }
}

}  // namespace boundary_test
