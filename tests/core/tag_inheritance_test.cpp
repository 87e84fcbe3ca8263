#include "pillowmesh/refine/tag_inheritance.h"

#include "../catch.h"
#include "meshes.h"

namespace tag_inheritance_test {

using namespace pillowmesh;

namespace {

template <int Dim>
struct Inserted {
  Mesh<Dim> mesh;
  EdgeTags<Dim> tags;
  PillowWorkspace<Dim> work;
  BufferLayer<Dim> layer;

  /// Tags all edges along the axes of `axes` (bits), inserts a layer around `set`, lets tags be inherited.
  Inserted(Mesh<Dim> m, const std::vector<CellId>& set, int axes) : mesh(std::move(m)) {
    tags.mask.assign(mesh.cells.size(), 0);
    for (CellId c = 0; c < mesh.cell_count(); ++c)
      for (int e = 0; e < Cell<Dim>::edges; ++e)
        if ((axes >> Cell<Dim>::edge_axis(e)) & 1) set_tag(mesh, tags, {c, e});
    // As find_layer does: the edges inside the set have been used.
    const Status s = insert_buffer_layer<Dim>(mesh, set, {}, work, layer);
    INFO(s.message);
    REQUIRE(s.ok());
    inherit_tags<Dim>(mesh, layer, work.hull.facets, tags);
  }

  [[nodiscard]] int tagged_edges(CellId c, int axis) const {
    int count = 0;
    for (int k = 0; k < Cell<Dim>::edges_per_axis; ++k) count += tags.has(c, Cell<Dim>::edge(axis, k));
    return count;
  }
};

template <int Dim>
void check_agreement(const Mesh<Dim>& mesh, const EdgeTags<Dim>& tags) {
  REQUIRE(tags.mask.size() == mesh.cells.size());
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int e = 0; e < Cell<Dim>::edges; ++e)
      for_each_cell_at_edge(mesh, {c, e}, [&](CellId n, int f) { REQUIRE(tags.has(n, f) == tags.has(c, e)); });
}

}  // namespace

TEST_CASE("the cells above and below a shrunk row inherit the tags along it, its ends do not") {
  //  row of four in a 6 x 3 grid: new cells over each of its quads, and one at each end
  const Inserted<2> i(make_grid<2>({6, 3}, Point<2>(0, 0), Point<2>(6, 3)), {7, 8, 9, 10}, 1);
  check_agreement(i.mesh, i.tags);
  CHECK(i.tagged_edges(8, 0) == 2);
  CHECK(i.tagged_edges(9, 0) == 2);
  CHECK(i.tagged_edges(7, 0) == 0);  // both hull edges along the row are corner edges of an end cell
  CHECK(i.tagged_edges(10, 0) == 0);
  for (Index k = 0; k < i.layer.cell_count; ++k) {
    const auto& h = i.work.hull.facets[k];
    const CellId c = i.layer.first_cell + k;
    if (Cell<2>::facet_axis(h.facet) == 0) {
      CHECK(i.tagged_edges(c, 1) == 0);  // the end cap: nothing across the row was tagged
      CHECK(i.tagged_edges(c, 0) == 0);
    } else {
      CHECK(i.tagged_edges(c, 0) == (h.inside == 7 || h.inside == 10 ? 1 : 2));  // the outer copy keeps its tag
      CHECK(i.tagged_edges(c, 1) == 0);  // edges that are new have none
    }
  }
}

TEST_CASE("a row that ends at the domain's boundary has no corner edges there") {
  const Inserted<2> i(make_grid<2>({4, 3}, Point<2>(0, 0), Point<2>(4, 3)), {4, 5, 6, 7}, 1);
  check_agreement(i.mesh, i.tags);
  for (const CellId c : {4, 5, 6, 7}) CHECK(i.tagged_edges(c, 0) == 2);
  for (Index k = 0; k < i.layer.cell_count; ++k) CHECK(i.tagged_edges(i.layer.first_cell + k, 0) == 2);
}

TEST_CASE("one quad alone has corner edges only") {
  const Inserted<2> i(make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(3, 3)), {4}, 3);
  check_agreement(i.mesh, i.tags);
  CHECK(i.tags.mask[4] == 0);
  for (const CellId outside : {1, 3, 5, 7}) CHECK(i.tags.mask[outside] == EdgeTags<2>::all);
  for (Index k = 0; k < i.layer.cell_count; ++k) {
    int tagged = 0;
    for (int e = 0; e < 4; ++e) tagged += i.tags.has(i.layer.first_cell + k, e);
    CHECK(tagged == 1);  // its outer edge
  }
}

TEST_CASE("edges inside the shrink set keep or lose their tags as the layer left them") {
  // Upright edges between the quads of the row are not on the hull.
  const Inserted<2> i(make_grid<2>({6, 3}, Point<2>(0, 0), Point<2>(6, 3)), {7, 8, 9, 10}, 2);
  check_agreement(i.mesh, i.tags);
  CHECK(i.tagged_edges(8, 1) == 2);
  CHECK(i.tagged_edges(7, 1) == 1);  // its outer one is a hull edge of a corner: not inherited by the copy
  CHECK(i.tagged_edges(10, 1) == 1);
}

TEST_CASE("in 3D the edges across the edge that two hull facets of a hex share are corner edges") {
  //  a plate of 2 x 2 hexes inside a 4 x 4 x 3 block: every hex is at a corner of the plate
  const Inserted<3> i(make_grid<3>({4, 4, 3}, Point<3>(0, 0, 0), Point<3>(4, 4, 3)), {21, 22, 25, 26}, 1);
  check_agreement(i.mesh, i.tags);
  for (const CellId c : {21, 22, 25, 26}) CHECK(i.tagged_edges(c, 0) == 0);
  // A plate through the whole block has none.
  const Inserted<3> all(make_grid<3>({3, 2, 3}, Point<3>(0, 0, 0), Point<3>(3, 2, 3)), {6, 7, 8, 9, 10, 11}, 1);
  check_agreement(all.mesh, all.tags);
  for (CellId c = 6; c < 12; ++c) CHECK(all.tagged_edges(c, 0) == 4);
  for (Index k = 0; k < all.layer.cell_count; ++k) CHECK(all.tagged_edges(all.layer.first_cell + k, 0) == 4);
}

TEST_CASE("tags agree in all cells at an edge after random layers") {
  std::mt19937 random(12);
  for (const auto& [name, mesh] : corpus::meshes<2>())
    for (int n = 0; n < 10; ++n) {
      INFO(name << ", " << n);
      auto copy = mesh;
      PillowWorkspace<2> work;
      BufferLayer<2> layer;
      EdgeTags<2> tags;
      tags.mask.assign(copy.cells.size(), 0);
      for (CellId c = 0; c < copy.cell_count(); ++c)
        for (int e = 0; e < 4; ++e)
          if (random() % 2) set_tag(copy, tags, {c, e});
      for (int i = 0; i < 4; ++i) {
        const auto set = corpus::random_set(copy, 1 + random() % 6, random);
        if (!insert_buffer_layer<2>(copy, set, {}, work, layer).ok()) continue;
        inherit_tags<2>(copy, layer, work.hull.facets, tags);
        check_agreement(copy, tags);
      }
    }
}

}  // namespace tag_inheritance_test
