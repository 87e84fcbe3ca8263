#include "pillowmesh/refine/hull.h"

#include <set>

#include "../catch.h"
#include "meshes.h"

namespace hull_test {

using namespace pillowmesh;

namespace {

template <int Dim>
void check_hull(const Mesh<Dim>& mesh, const std::vector<CellId>& set, Hull<Dim>& hull) {
  using C = Cell<Dim>;
  find_hull<Dim>(mesh, set, {}, hull);
  const std::set<CellId> in(set.begin(), set.end());
  std::size_t expected = 0;
  for (const CellId c : set)
    for (int f = 0; f < C::facets; ++f) {
      const CellId n = mesh.neighbour(c, f);
      const bool parts = n != kNone && in.count(n) == 0;
      expected += parts;
      REQUIRE(hull.is_hull(c, f) == parts);
      if (n != kNone && parts) REQUIRE_FALSE(hull.is_hull(n, mesh.facet_of(mesh.twins[c][f])));
    }
  REQUIRE(hull.facets.size() == expected);
  std::set<VertexId> vertices;
  for (const auto& h : hull.facets) {
    CHECK(in.count(h.inside) == 1);
    CHECK(in.count(h.outside) == 0);
    CHECK(mesh.facet_vertices(h.inside, h.facet) == h.vertices);
    for (int k = 0; k < C::facet_corners; ++k) {
      CHECK(mesh.cells[h.outside][h.outside_corner[k]] == h.vertices[k]);
      CHECK(C::corner_on_facet(h.outside_corner[k], h.outside_facet));
      vertices.insert(h.vertices[k]);
    }
  }
  CHECK(vertices.size() == hull.vertices.size());
  for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
    CHECK(vertices.count(hull.vertices[i]) == 1);
    CHECK(hull.slot[hull.vertices[i]] == static_cast<Index>(i));
  }
  clear_hull<Dim>(set, hull);
  CHECK(std::all_of(hull.in_set.begin(), hull.in_set.end(), [](auto m) { return m == 0; }));
  CHECK(std::all_of(hull.hull_sides.begin(), hull.hull_sides.end(), [](auto m) { return m == 0; }));
  CHECK(std::all_of(hull.slot.begin(), hull.slot.end(), [](Index s) { return s == kNone; }));
}

template <int Dim>
void check_random_sets() {
  std::mt19937 random(4);
  Hull<Dim> hull;  // reused: marks must be clean between uses
  for (const auto& [name, mesh] : corpus::meshes<Dim>())
    for (int i = 0; i < 20; ++i) {
      INFO(name << ", set " << i);
      check_hull(mesh, corpus::random_set(mesh, 1 + random() % 12, random), hull);
    }
}

}  // namespace

TEST_CASE("the hull is the facets between the shrink set and the rest, as both sides see them") {
  check_random_sets<2>();
  check_random_sets<3>();
}

TEST_CASE("the hull of one inner cell is all its facets, of one cell in a corner half of them") {
  Hull<2> hull;
  const auto quads = make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(3, 3));
  find_hull<2>(quads, std::vector<CellId>{4}, {}, hull);
  CHECK(hull.facets.size() == 4);
  CHECK(hull.vertices.size() == 4);
  clear_hull<2>(std::vector<CellId>{4}, hull);
  find_hull<2>(quads, std::vector<CellId>{0}, {}, hull);
  CHECK(hull.facets.size() == 2);
  CHECK(hull.vertices.size() == 3);
  Hull<3> hexes;
  const auto cube = make_grid<3>({3, 3, 3}, Point<3>(0, 0, 0), Point<3>(3, 3, 3));
  find_hull<3>(cube, std::vector<CellId>{13}, {}, hexes);
  CHECK(hexes.facets.size() == 6);
  CHECK(hexes.vertices.size() == 8);
}

TEST_CASE("a facet of the domain's boundary is hull only where it is named") {
  const auto mesh = make_grid<2>({3, 1}, Point<2>(0, 0), Point<2>(3, 1));
  const std::vector<CellId> all{0, 1, 2};
  Hull<2> hull;
  find_hull<2>(mesh, all, {}, hull);
  CHECK(hull.facets.empty());
  clear_hull<2>(all, hull);
  const int bottom = Cell<2>::facet(1, 0);
  find_hull<2>(mesh, all, std::vector<HalfFacetId>{mesh.half_facet(1, bottom)}, hull);
  REQUIRE(hull.facets.size() == 1);
  CHECK(hull.facets[0].outside == kNone);
  CHECK(hull.facets[0].patch == mesh.patch_of(1, bottom));
  CHECK(hull.is_hull(1, bottom));
  CHECK_FALSE(hull.is_hull(0, bottom));
}

}  // namespace hull_test
