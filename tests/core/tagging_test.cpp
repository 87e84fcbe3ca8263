#include "pillowmesh/adapt/tagging.h"

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/refine/balance.h"

namespace tagging_test {

using namespace pillowmesh;

namespace {

/// Tags hold exactly the edges that are longer than the threshold, in all cells at them.
template <int Dim>
void check_tags(const Mesh<Dim>& mesh, const MetricField<Dim>& field, double threshold, const EdgeTags<Dim>& tags) {
  LengthOptions options;
  options.panel = default_panel<Dim>(mesh.points);
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int e = 0; e < Cell<Dim>::edges; ++e) {
      const double l = edge_length<Dim>(field, mesh.points[mesh.cells[c][Cell<Dim>::edge_from(e)]],
                                        mesh.points[mesh.cells[c][Cell<Dim>::edge_to(e)]], options);
      if (std::abs(l - threshold) > checks::kTagging * threshold) CHECK(tags.has(c, e) == (l > threshold));
    }
}

}  // namespace

TEST_CASE("tags are the edges longer than the threshold, whatever cell looks at them") {
  for (const double threshold : {1.2, 2.0, 5.0}) {
    for (const auto& [name, mesh] : corpus::meshes<2>()) {
      INFO(name);
      const auto field = *MetricField<2>::from_formula("h1 = 0.1 + 0.2*abs(x); h2 = 0.3; theta = y");
      Tagging<2> tagging(mesh, threshold);
      EdgeTags<2> tags;
      const auto cells = tagging.tag_long_edges(mesh, field, tags);
      check_tags(mesh, field, threshold, tags);
      CHECK(std::is_sorted(cells.begin(), cells.end()));
      for (CellId c = 0; c < mesh.cell_count(); ++c)
        CHECK(std::binary_search(cells.begin(), cells.end(), c) == (tags.mask[c] != 0));
    }
    for (const auto& [name, mesh] : corpus::meshes<3>()) {
      INFO(name);
      const auto field = *MetricField<3>::from_formula("h1 = 0.1 + 0.2*abs(x); h2 = 0.3; h3 = 0.2 + 0.1*z");
      Tagging<3> tagging(mesh, threshold);
      EdgeTags<3> tags;
      (void)tagging.tag_long_edges(mesh, field, tags);
      check_tags(mesh, field, threshold, tags);
    }
  }
}

TEST_CASE("only the edges of cells that are to be looked at again are measured") {
  auto mesh = make_grid<2>({4, 1}, Point<2>(0, 0), Point<2>(4, 1));
  const auto field = *MetricField<2>::from_formula("h = 1");
  Tagging<2> tagging(mesh, 2.0);
  EdgeTags<2> tags;
  CHECK(tagging.tag_long_edges(mesh, field, tags).empty());
  const auto fine = field.scaled(0.1);
  CHECK(tagging.tag_long_edges(mesh, fine, tags).empty());  // nothing has changed
  tagging.look_again(3);
  tagging.look_again(3);
  CHECK(tagging.tag_long_edges(mesh, fine, tags) == std::vector<CellId>{2, 3});  // 2 shares an edge
  CHECK(tags.mask[0] == 0);
  CHECK(tags.mask[3] == EdgeTags<2>::all);
  tagging.look_at_all(mesh);
  (void)tagging.tag_long_edges(mesh, fine, tags);
  for (const auto mask : tags.mask) CHECK(mask == EdgeTags<2>::all);
}

TEST_CASE("only cells at given edges are looked at when these are all that has become too long") {
  const auto mesh = make_grid<2>({6, 2}, Point<2>(0, 0), Point<2>(6, 2));
  const auto fine = *MetricField<2>::from_formula("h = 0.1");
  Tagging<2> tagging(mesh, 2.0);
  EdgeTags<2> tags;
  // The edge between the cells 1 and 2: all edges of both are tagged, and of their neighbours those that they share.
  const std::vector<std::array<VertexId, 2>> edges{{2, 9}};
  REQUIRE(mesh.points[2] == Point<2>(2, 0));
  REQUIRE(mesh.points[9] == Point<2>(2, 1));
  tagging.look_at(mesh, edges);
  CHECK(tagging.tag_long_edges(mesh, fine, tags) == std::vector<CellId>{0, 1, 2, 3, 7, 8});
  CHECK(tags.mask[1] == EdgeTags<2>::all);
  CHECK(tags.mask[2] == EdgeTags<2>::all);
  CHECK(tags.mask[7] != EdgeTags<2>::all);
}

TEST_CASE("a cell where layers are refused again and again waits longer, unless its edges change or all are woken") {
  auto mesh = make_grid<2>({4, 1}, Point<2>(0, 0), Point<2>(4, 1));
  const auto fine = *MetricField<2>::from_formula("h = 0.1");
  Tagging<2> tagging(mesh, 2.0);
  EdgeTags<2> tags;
  const auto seen = [&] {
    tags.mask.assign(mesh.cells.size(), 0);
    return !tagging.tag_long_edges(mesh, fine, tags).empty();
  };
  CHECK(seen());
  for (const int calls : {1, 1, 1, 2, 4, 8}) {
    tagging.look_again_later(0);
    CHECK(tagging.waiting());
    for (int i = 1; i < calls; ++i) CHECK_FALSE(seen());
    CHECK(seen());
    CHECK_FALSE(tagging.waiting());
  }
  tagging.look_again_later(0);
  CHECK_FALSE(seen());
  CHECK(tagging.wake());
  CHECK(seen());
  CHECK_FALSE(tagging.wake());
  tagging.look_again_later(0);
  tagging.look_again(0);
  CHECK(seen());
}

TEST_CASE("a ring a two-hundredth wide that crosses an edge is not overlooked") {
  const auto mesh = make_grid<2>({1, 1}, Point<2>(0, 0), Point<2>(1, 1));
  Tagging<2> tagging(mesh, 2.0);
  EdgeTags<2> tags;
  // 0.005 / 0.001 = 5 units of length in the ring, 0.33 outside.
  const auto field = *MetricField<2>::from_formula("h = if(abs(r - 0.6283) < 0.0025, 0.001, 3)");
  (void)tagging.tag_long_edges(mesh, field, tags);
  CHECK(tags.has(0, Cell<2>::edge(0, 0)));
  CHECK(tags.has(0, Cell<2>::edge(1, 0)));
  CHECK_FALSE(tags.has(0, Cell<2>::edge(0, 1)));  // the far edges are outside of it
  CHECK_FALSE(tags.has(0, Cell<2>::edge(1, 1)));
}

TEST_CASE("balancing may reach cells that had no tags: they are collected") {
  const auto mesh = make_grid<2>({3, 1}, Point<2>(0, 0), Point<2>(3, 1));
  EdgeTags<2> tags;
  tags.mask.assign(3, 0);
  for (const int e : {0, 1, 2}) set_tag(mesh, tags, {0, e});  // bottom, top, left: the right edge follows
  const Tagging<2> tagging(mesh, 2.0);
  std::vector<CellId> cells{0};
  balance_tags<2>(mesh, tags, cells);
  tagging.collect_tagged_cells(mesh, tags, cells);
  CHECK(cells == std::vector<CellId>{0, 1});
}

}  // namespace tagging_test
