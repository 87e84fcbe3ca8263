#include "pillowmesh/refine/layer.h"

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/refine/balance.h"
#include "pillowmesh/refine/tag_inheritance.h"

namespace layer_test {

using namespace pillowmesh;

namespace {

EdgeTags<2> no_tags(const Mesh<2>& mesh) {
  EdgeTags<2> tags;
  tags.mask.assign(mesh.cells.size(), 0);
  return tags;
}

int count_tags(const Mesh<2>& mesh, const EdgeTags<2>& tags) {
  int count = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int e = 0; e < 4; ++e) count += tags.has(c, e) && represents_edge(mesh, {c, e});
  return count;
}

/// Vertical edge on the left (k = 0) or right (k = 1) of a grid cell; horizontal: bottom or top.
constexpr int vertical(int k) { return Cell<2>::edge(1, k); }
constexpr int horizontal(int k) { return Cell<2>::edge(0, k); }

}  // namespace

TEST_CASE("a layer takes the cells at its tagged edges and one more at each end") {
  const auto mesh = make_grid<2>({8, 3}, Point<2>(0, 0), Point<2>(8, 3));
  auto tags = no_tags(mesh);
  // Middle row, cells 8 to 15: the vertical edges right of cells 10, 11, 12.
  for (const CellId c : {10, 11, 12}) set_tag(mesh, tags, {c, vertical(1)});
  LayerMarks marks;
  Layer layer;
  for (const int augment : {0, 1, 2}) {
    auto t = tags;
    find_layer<2>(mesh, t, {11, vertical(1)}, {augment, 1}, marks, layer);
    auto cells = layer.cells;
    std::sort(cells.begin(), cells.end());
    std::vector<CellId> expected;
    for (CellId c = 10 - augment; c <= 13 + augment; ++c) expected.push_back(c);
    CHECK(cells == expected);
    CHECK(layer.edges.size() == 3);
    CHECK(count_tags(mesh, t) == 0);
  }
}

TEST_CASE("a layer through a whole row stops at the boundary, one around an annulus closes") {
  const auto grid = make_grid<2>({5, 3}, Point<2>(0, 0), Point<2>(5, 3));
  auto tags = no_tags(grid);
  for (CellId c = 5; c < 10; ++c)
    for (int k : {0, 1}) set_tag(grid, tags, {c, vertical(k)});
  LayerMarks marks;
  Layer layer;
  find_layer<2>(grid, tags, {7, vertical(0)}, {}, marks, layer);
  CHECK(layer.cells.size() == 5);
  CHECK(layer.edges.size() == 6);

  const auto ring = corpus::ring(12, 3, true);
  auto around = no_tags(ring);
  for (CellId c = 12; c < 24; ++c) set_tag(ring, around, {c, vertical(0)});
  find_layer<2>(ring, around, {12, vertical(0)}, {}, marks, layer);
  CHECK(layer.cells.size() == 12);
  CHECK(layer.edges.size() == 12);
}

TEST_CASE("a layer that crosses itself visits the crossing once per axis") {
  // Around a vertex of valence 3 the chord next to it turns and crosses itself... the star's chords are followed to
  // their ends: every cell appears once in the shrink set whatever the number of visits.
  const auto mesh = corpus::star(3, 3);
  auto tags = no_tags(mesh);
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int e = 0; e < 4; ++e) set_tag(mesh, tags, {c, e});
  LayerMarks marks;
  Layer layer;
  find_layer<2>(mesh, tags, {0, vertical(0)}, {}, marks, layer);
  auto cells = layer.cells;
  std::sort(cells.begin(), cells.end());
  CHECK(std::adjacent_find(cells.begin(), cells.end()) == cells.end());
  CHECK(layer.visits.size() >= layer.cells.size());
}

TEST_CASE("a thicker layer takes the row beside it where more edges are tagged") {
  const auto mesh = make_grid<2>({6, 4}, Point<2>(0, 0), Point<2>(6, 4));
  auto tags = no_tags(mesh);
  for (CellId c = 6; c < 18; ++c) set_tag(mesh, tags, {c, vertical(0)});  // rows 1 and 2
  LayerMarks marks;
  Layer layer;
  find_layer<2>(mesh, tags, {8, vertical(0)}, {0, 2}, marks, layer);
  CHECK(layer.cells.size() == 12);
  CHECK(std::all_of(layer.cells.begin(), layer.cells.end(), [](CellId c) { return c >= 6 && c < 18; }));
  CHECK(count_tags(mesh, tags) == 0);
}

namespace {

constexpr int kWidth = 6;

/// A grid of rows of kWidth unit cells: cell kWidth * j + i is number i of row j.
Mesh<2> rows_of_cells(int rows) { return make_grid<2>({kWidth, rows}, Point<2>(0, 0), Point<2>(kWidth, rows)); }

/// Tags the vertical edges of a row from number `first` to `last`; there are kWidth + 1.
void tag_row(const Mesh<2>& mesh, EdgeTags<2>& tags, int row, int first = 0, int last = kWidth) {
  for (int i = first; i <= last; ++i)
    set_tag(mesh, tags, {kWidth * row + std::min(i, kWidth - 1), vertical(i == kWidth ? 1 : 0)});
}

/// The rows of the layer of `thickness` that starts in `seed_row`. Each must be in it as a whole.
std::vector<int> rows_of_layer(const Mesh<2>& mesh, EdgeTags<2>& tags, int seed_row, int thickness, LayerMarks& marks) {
  Layer layer;
  find_layer<2>(mesh, tags, {kWidth * seed_row + 2, vertical(0)}, {0, thickness}, marks, layer);
  std::vector<int> cells_in_row(mesh.cells.size() / kWidth, 0), rows;
  for (const CellId c : layer.cells) ++cells_in_row[c / kWidth];
  for (std::size_t row = 0; row < cells_in_row.size(); ++row) {
    if (cells_in_row[row] == 0) continue;
    CHECK(cells_in_row[row] == kWidth);
    rows.push_back(static_cast<int>(row));
  }
  return rows;
}

using Rows = std::vector<int>;

}  // namespace

TEST_CASE("a row joins a thicker layer as a whole, and not at all when one of its cells is refined already") {
  const auto mesh = rows_of_cells(5);
  auto tags = no_tags(mesh);
  tag_row(mesh, tags, 1);
  tag_row(mesh, tags, 2);
  LayerMarks marks;
  marks.refined.assign(mesh.cells.size(), 0);
  auto t = tags;
  CHECK(rows_of_layer(mesh, t, 1, 2, marks) == Rows{1, 2});
  CHECK(count_tags(mesh, t) == 0);

  marks.refined[kWidth * 2 + 3] = 1u << 0;  // across the layer: does not matter
  t = tags;
  CHECK(rows_of_layer(mesh, t, 1, 2, marks) == Rows{1, 2});

  marks.refined[kWidth * 2 + 3] = 1u << 1;
  t = tags;
  CHECK(rows_of_layer(mesh, t, 1, 2, marks) == Rows{1});
  CHECK(count_tags(mesh, t) == kWidth + 1);  // the other row waits for a layer of its own
}

TEST_CASE("the last row before the boundary does not join a thicker layer: it would have no hull to be halved at") {
  const auto mesh = rows_of_cells(4);
  auto tags = no_tags(mesh);
  for (const int row : {2, 3}) tag_row(mesh, tags, row);
  LayerMarks marks;
  auto t = tags;
  CHECK(rows_of_layer(mesh, t, 2, 2, marks) == Rows{2});
  tag_row(mesh, tags, 1);  // on the other side there is a row that may
  t = tags;
  CHECK(rows_of_layer(mesh, t, 2, 2, marks) == Rows{1, 2});
}

TEST_CASE("a layer along the boundary has hull on one side only, and does not become thicker") {
  const auto mesh = rows_of_cells(4);
  auto tags = no_tags(mesh);
  for (const int row : {0, 1}) tag_row(mesh, tags, row);
  LayerMarks marks;
  CHECK(rows_of_layer(mesh, tags, 0, 2, marks) == Rows{0});
  CHECK(count_tags(mesh, tags) == kWidth + 1);
}

TEST_CASE("a row with less than half as many tags does not join a thicker layer") {
  const auto mesh = rows_of_cells(4);
  auto tags = no_tags(mesh);
  tag_row(mesh, tags, 1);        // 7 edges
  tag_row(mesh, tags, 2, 2, 4);  // 3 edges
  LayerMarks marks;
  auto t = tags;
  CHECK(rows_of_layer(mesh, t, 1, 2, marks) == Rows{1});
  tag_row(mesh, tags, 2, 5, 5);  // and one more
  t = tags;
  CHECK(rows_of_layer(mesh, t, 1, 2, marks) == Rows{1, 2});
}

TEST_CASE("a layer grows by row after row on one side, up to its thickness or the first row that may not join") {
  const auto mesh = rows_of_cells(7);
  auto tags = no_tags(mesh);
  for (const int row : {1, 2, 3}) tag_row(mesh, tags, row);
  LayerMarks marks;
  for (const auto& [thickness, rows] :
       {std::pair{1, Rows{1}}, {2, Rows{1, 2}}, {3, Rows{1, 2, 3}}, {4, Rows{1, 2, 3}}}) {
    auto t = tags;
    CHECK(rows_of_layer(mesh, t, 1, thickness, marks) == rows);
    CHECK(count_tags(mesh, t) == (kWidth + 1) * (3 - static_cast<int>(rows.size())));
  }
}

TEST_CASE("a layer that winds beside itself does not become thicker: where it does, no hull is left") {
  const int around = 12;
  const auto mesh = corpus::snail(around, 7);
  auto tags = no_tags(mesh);
  //  15 edges, a turn and a quarter; and after a gap, all around that, enough tags for the row outside to join
  for (CellId c = 3 * around; c < 4 * around + 3; ++c) set_tag(mesh, tags, {c, vertical(0)});
  for (CellId c = 4 * around + 6; c < 5 * around + 3; ++c) set_tag(mesh, tags, {c, vertical(0)});
  LayerMarks marks;
  Layer layer;
  find_layer<2>(mesh, tags, {3 * around, vertical(0)}, {0, 2}, marks, layer);
  CHECK(layer.cells.size() == 16);
  CHECK(layer.edges.size() == 15);
}

TEST_CASE("cells that this iteration has made are not halved again by a thicker layer beside them") {
  //  row 2 is refined first: it and the cells made above and below it are small
  auto mesh = rows_of_cells(6);
  auto tags = no_tags(mesh);
  tag_row(mesh, tags, 2);
  LayerMarks marks;
  Layer first, second;
  find_layer<2>(mesh, tags, {kWidth * 2, vertical(0)}, {0, 1}, marks, first);
  PillowWorkspace<2> work;
  BufferLayer<2> made;
  REQUIRE(insert_buffer_layer<2>(mesh, first.cells, {}, work, made).ok());
  mark_refined<2>(mesh, first, made, work.hull.facets, marks);

  tags.mask.resize(mesh.cells.size(), 0);
  tag_row(mesh, tags, 3);
  for (Index i = 0; i < made.cell_count; ++i)
    for (int e = 0; e < 4; ++e) set_tag(mesh, tags, {made.first_cell + i, e});
  find_layer<2>(mesh, tags, {kWidth * 3 + 2, vertical(0)}, {0, 2}, marks, second);
  CHECK(second.cells.size() == kWidth);  // row 3 alone, for all the tags of the cells below it
  for (const CellId c : second.cells) CHECK(c / kWidth == 3);
}

TEST_CASE("a quad with three tagged edges gets all four, and that spreads") {
  const auto mesh = make_grid<2>({3, 1}, Point<2>(0, 0), Point<2>(3, 1));
  auto tags = no_tags(mesh);
  set_tag(mesh, tags, {0, vertical(0)});
  set_tag(mesh, tags, {0, horizontal(0)});
  CHECK(balance_tags<2>(mesh, tags, std::vector<CellId>{0}) == 0);  // two are not more than two
  set_tag(mesh, tags, {0, horizontal(1)});
  set_tag(mesh, tags, {1, horizontal(0)});
  set_tag(mesh, tags, {1, horizontal(1)});
  CHECK(balance_tags<2>(mesh, tags, std::vector<CellId>{0, 1, 2}) == 2);  // between 0 and 1, then between 1 and 2
  CHECK(tags.mask[0] == EdgeTags<2>::all);
  CHECK(tags.mask[1] == EdgeTags<2>::all);
  CHECK(tags.mask[2] == 1u << vertical(0));
}

TEST_CASE("both copies of a hull edge inherit its tag, but the shrunk copy of a corner edge does not") {
  //  row of four cells in the middle of a 6 x 3 grid, all horizontal edges tagged
  auto mesh = make_grid<2>({6, 3}, Point<2>(0, 0), Point<2>(6, 3));
  auto tags = no_tags(mesh);
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int k : {0, 1}) set_tag(mesh, tags, {c, horizontal(k)});
  PillowWorkspace<2> work;
  BufferLayer<2> layer;
  REQUIRE(insert_buffer_layer<2>(mesh, std::vector<CellId>{7, 8, 9, 10}, {}, work, layer).ok());
  inherit_tags<2>(mesh, layer, work.hull.facets, tags);
  for (const CellId middle : {8, 9})
    for (int k : {0, 1}) CHECK(tags.has(middle, horizontal(k)));
  for (const CellId end : {7, 10})
    for (int k : {0, 1}) CHECK_FALSE(tags.has(end, horizontal(k)));
  for (const CellId outside : {1, 4, 13, 16}) CHECK(tags.has(outside, horizontal(outside < 6 ? 1 : 0)));
  // The same bit in every cell of an edge.
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int e = 0; e < 4; ++e)
      for_each_cell_at_edge(mesh, {c, e}, [&](CellId n, int f) { CHECK(tags.has(n, f) == tags.has(c, e)); });
}

}  // namespace layer_test
