#include "pillowmesh/mesh/cavity.h"

#include <random>

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/coarsen/boundary_collapse.h"
#include "pillowmesh/coarsen/chord_collapse.h"
#include "pillowmesh/coarsen/diagonal_collapse.h"
#include "pillowmesh/coarsen/partial_chord_collapse.h"
#include "pillowmesh/mesh/compact.h"
#include "pillowmesh/mesh/ordered_star.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/reconnect/boundary_open.h"
#include "pillowmesh/reconnect/chord_split.h"
#include "pillowmesh/reconnect/open.h"
#include "pillowmesh/reconnect/partial_chord_split.h"
#include "pillowmesh/reconnect/rotate.h"

namespace cavity_test {

using namespace pillowmesh;

namespace {

bool same(const Mesh<2>& a, const Mesh<2>& b) {
  return a.points == b.points && a.cells == b.cells && a.twins == b.twins && a.vertex_cell == b.vertex_cell &&
         a.support == b.support && a.anchor == b.anchor && a.region == b.region;
}

struct Counts {
  Index vertices = 0, cells = 0, edges = 0;
};
Counts counts(const Mesh<2>& mesh) {
  Counts n;
  for (const CellId c : mesh.vertex_cell) n.vertices += c != kNone;
  for (CellId c = 0; c < mesh.cell_count(); ++c) n.cells += mesh.alive(c);
  n.edges = static_cast<Index>(unique_edges(mesh).size());
  return n;
}

/// Neighbours know each other, every used vertex knows a cell of its own, no vertex is left with too few cells.
void check_topology(const Mesh<2>& mesh) {
  OrderedStar star;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    for (int side = 0; side < 4; ++side) {
      const HalfFacetId twin = twin_of_side(mesh, c, side);
      if (twin < 0) continue;
      const CellId n = mesh.cell_of(twin);
      const int j = kFacetSide[mesh.facet_of(twin)];
      REQUIRE(mesh.alive(n));
      REQUIRE(twin_of_side(mesh, n, j) == mesh.half_facet(c, kSideFacet[side]));
      REQUIRE(around(mesh, n, j) == around(mesh, c, side + 1));
      REQUIRE(around(mesh, n, j + 1) == around(mesh, c, side));
    }
    for (const VertexId v : mesh.cells[c]) {
      REQUIRE(mesh.vertex_cell[v] != kNone);
      REQUIRE(place_of(mesh, mesh.vertex_cell[v], v) >= 0);
      REQUIRE(find_star(mesh, v, star));
    }
  }
}

/// Along side `side` of cell c and on, past as many edges to the left at each vertex as a regular one has.
std::vector<VertexId> straight_path(const Mesh<2>& mesh, CellId c, int side, unsigned edges) {
  std::vector<VertexId> path{around(mesh, c, side), around(mesh, c, side + 1)};
  while (path.size() <= edges) {
    const HalfFacetId twin = twin_of_side(mesh, c, side + 1);
    if (twin < 0) break;
    c = mesh.cell_of(twin);
    side = (kFacetSide[mesh.facet_of(twin)] + 1) & 3;
    path.push_back(around(mesh, c, side + 1));
  }
  return path;
}

/// A random operator somewhere. \return what it is called, nullptr when it is not legal there.
const char* plan_any(const Mesh<2>& mesh, std::mt19937& random, std::vector<std::uint8_t>& marks, Cavity& cavity) {
  const CellId c = static_cast<CellId>(random() % mesh.cells.size());
  if (!mesh.alive(c)) return nullptr;
  const int side = static_cast<int>(random() % 4);
  marks.resize(mesh.cells.size(), 0);
  Chord chord;
  OrderedStar star;
  switch (random() % 19) {
    case 0:
      find_chord(mesh, c, side, marks, chord);
      return plan_chord_collapse(mesh, chord, cavity) ? "chord collapse" : nullptr;
    case 1:
      find_chord(mesh, c, side, marks, chord);
      return plan_chord_split(mesh, chord, cavity) ? "chord split" : nullptr;
    case 2:
    case 3:
    case 4: return plan_diagonal_collapse(mesh, c, side, cavity) ? "collapse" : nullptr;
    case 5:
    case 6:
    case 7: {
      const VertexId v = around(mesh, c, side);
      if (!find_star(mesh, v, star)) return nullptr;
      const int first = static_cast<int>(random() % star.count);
      return plan_opening(mesh, v, star, first, first + 2, cavity) ? "open" : nullptr;
    }
    case 8:
    case 9: return plan_boundary_collapse(mesh, around(mesh, c, side), cavity) ? "boundary collapse" : nullptr;
    case 11:
    case 12: {
      find_chord(mesh, c, side, marks, chord);
      const std::size_t first = random() % chord.cells.size(), most = 1 + random() % 6;
      const std::size_t last = std::min(first + most, chord.cells.size());
      const std::vector<ChordCell> part(chord.cells.begin() + first, chord.cells.begin() + last);
      return plan_partial_chord_collapse(mesh, part, random() % 2, cavity) ? "partial chord collapse" : nullptr;
    }
    case 13:
    case 14: return plan_partial_chord_split(mesh, straight_path(mesh, c, side, 2 + random() % 6), random() % 2, cavity)
                        ? "partial chord split"
                        : nullptr;
    case 10: return plan_boundary_opening(mesh, c, side, random() % 2 == 1, cavity) ? "boundary opening" : nullptr;
    default: return plan_rotation(mesh, c, side, static_cast<int>(random() % 2), cavity) ? "rotate" : nullptr;
  }
}

}  // namespace

TEST_CASE("any sequence of operators keeps the topology whole, and each is taken back to the last bit") {
  const unsigned seed = 20260;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (const auto& [name, initial] : corpus::meshes<2>()) {
    INFO(name);
    Mesh<2> mesh = initial;
    const Index euler = checks::euler(mesh);
    Journal journal(mesh);
    Cavity cavity;
    std::vector<CellId> ids;
    std::vector<std::uint8_t> marks;
    int kept = 0;
    for (int i = 0; i < 600; ++i) {
      const char* what = plan_any(mesh, random, marks, cavity);
      if (what == nullptr) continue;
      INFO(what);
      const Mesh<2> before = mesh;
      journal.begin();
      const bool whole = journal.apply(cavity, ids);
      bool sound = whole;
      OrderedStar star;
      if (whole)
        for (const VertexId v : cavity.around)
          if (mesh.vertex_cell[v] != kNone)
            sound = sound && find_star(mesh, v, star) && star.count >= (mesh.support[v].dim == 2 ? 3 : 1);
      if (whole && sound) check_topology(mesh);
      if (!sound || random() % 3 == 0) {
        journal.undo();
        REQUIRE(same(mesh, before));
      } else {
        ++kept;
      }
    }
    CHECK(kept > 20);
    Mesh<2> dense = mesh;
    compact(dense);
    const Counts n = counts(dense);
    CHECK(n.vertices - n.edges + n.cells == euler);
    CHECK(n.vertices == dense.vertex_count());
    CHECK(n.cells == dense.cell_count());
    check_topology(dense);
  }
}

TEST_CASE("each operator changes the numbers of vertices and cells as its picture says") {
  const Mesh<2> grid = make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(4, 4));
  const auto apply = [&](auto&& plan) {
    Mesh<2> mesh = grid;
    Journal journal(mesh);
    Cavity cavity;
    std::vector<CellId> ids;
    REQUIRE(plan(mesh, cavity));
    REQUIRE(journal.apply(cavity, ids));
    check_topology(mesh);
    return counts(mesh);
  };
  std::vector<std::uint8_t> marks(grid.cells.size(), 0);
  Chord chord;
  find_chord(grid, 5, 0, marks, chord);
  CHECK(chord.cells.size() == 4);
  CHECK_FALSE(chord.closed);
  const Counts rotated = apply([](auto& m, auto& c) { return plan_rotation(m, 5, 1, 0, c); });
  CHECK((rotated.vertices == 25 && rotated.cells == 16));
  const Counts collapsed = apply([](auto& m, auto& c) { return plan_diagonal_collapse(m, 5, 0, c); });
  CHECK((collapsed.vertices == 24 && collapsed.cells == 15));
  const Counts opened = apply([](auto& m, auto& c) {
    OrderedStar star;
    return find_star(m, 12, star) && plan_opening(m, 12, star, 0, 2, c);
  });
  CHECK((opened.vertices == 26 && opened.cells == 17));
  const Counts shorter = apply([&](auto& m, auto& c) { return plan_chord_collapse(m, chord, c); });
  CHECK((shorter.vertices == 20 && shorter.cells == 12));
  const Counts longer = apply([&](auto& m, auto& c) { return plan_chord_split(m, chord, c); });
  CHECK((longer.vertices == 30 && longer.cells == 20));
  const std::vector<ChordCell> part(chord.cells.begin() + 1, chord.cells.begin() + 3);
  const std::vector<VertexId> path = straight_path(grid, 8, 0, 3);
  for (const int way : {0, 1}) {
    const Counts fewer = apply([&](auto& m, auto& c) { return plan_partial_chord_collapse(m, part, way, c); });
    CHECK((fewer.vertices == 23 && fewer.cells == 14));
    const Counts more = apply([&](auto& m, auto& c) { return plan_partial_chord_split(m, path, way, c); });
    CHECK((more.vertices == 27 && more.cells == 18));
  }
  const Counts joined = apply([](auto& m, auto& c) { return plan_boundary_collapse(m, 2, c); });
  CHECK((joined.vertices == 23 && joined.cells == 15));
}

TEST_CASE("a boundary opening takes a boundary collapse back") {
  const Mesh<2> grid = make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(4, 4));
  // In the middle of a side, and next to each end of it, where a corner stays.
  for (const VertexId v : {1, 2, 3}) {
    INFO("vertex " << v);
    Mesh<2> mesh = grid;
    Journal journal(mesh);
    Cavity cavity;
    std::vector<CellId> ids;
    REQUIRE(plan_boundary_collapse(mesh, v, cavity));
    REQUIRE(journal.apply(cavity, ids));
    check_topology(mesh);
    const VertexId keep = v == 1 ? 0 : (v == 3 ? 4 : 2);
    CHECK(mesh.points[keep] == grid.points[keep]);
    int place = place_of(mesh, ids[0], keep);
    REQUIRE(place >= 0);
    // The quad's two edges at `keep` have the row above it and the row beside it.
    journal.begin();
    CHECK_FALSE(plan_boundary_opening(mesh, ids[0], place + 2, false, cavity));  // inside
    REQUIRE(plan_boundary_opening(mesh, ids[0], place, v == 3, cavity));
    REQUIRE(journal.apply(cavity, ids));
    check_topology(mesh);
    compact(mesh);
    CHECK(counts(mesh).vertices == 25);
    CHECK(counts(mesh).edges == counts(grid).edges);
    CHECK(counts(mesh).cells == 16);
    CHECK(checks::distance_from_geometry(mesh) == 0.0);
    OrderedStar star;
    for (VertexId w = 0; w < mesh.vertex_count(); ++w) {
      REQUIRE(find_star(mesh, w, star));
      CHECK(star.count == (mesh.support[w].dim == 2 ? 4 : (mesh.support[w].dim == 1 ? 2 : 1)));
    }
  }
}

TEST_CASE("a partial chord collapse takes a partial chord split back, and the split inverts no cell") {
  const Mesh<2> grid = make_grid<2>({8, 4}, Point<2>(0, 0), Point<2>(8, 4));
  for (const int way : {0, 1})
    for (const unsigned edges : {2u, 3u, 6u}) {
      INFO("way " << way << ", " << edges << " edges");
      Mesh<2> mesh = grid;
      Journal journal(mesh);
      Cavity cavity;
      std::vector<CellId> ids;
      const std::vector<VertexId> path = straight_path(mesh, 17, 0, edges);
      REQUIRE(plan_partial_chord_split(mesh, path, way, cavity));
      REQUIRE(journal.apply(cavity, ids));
      check_topology(mesh);
      CHECK(validate(mesh).ok());
      CHECK(counts(mesh).cells == 32 + static_cast<Index>(edges) - 1);
      // The ends have a cell more, and the first and the last copy, on one side each, a cell less.
      OrderedStar star;
      std::array<int, 8> with{};
      for (VertexId v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.support[v].dim == 2 && find_star(mesh, v, star)) ++with[star.count];
      CHECK((with[3] == 2 && with[5] == 2 && with[4] == 21 + static_cast<int>(edges) - 1 - 4));
      std::vector<ChordCell> part;
      for (std::size_t k = ids.size() - (edges - 1); k < ids.size(); ++k) part.push_back({ids[k], 0});
      REQUIRE(plan_partial_chord_collapse(mesh, part, way, cavity));
      REQUIRE(journal.apply(cavity, ids));
      check_topology(mesh);
      compact(mesh);
      CHECK(counts(mesh).cells == 32);
      for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
        REQUIRE(find_star(mesh, v, star));
        CHECK(star.count == (mesh.support[v].dim == 2 ? 4 : (mesh.support[v].dim == 1 ? 2 : 1)));
      }
    }
}

TEST_CASE("operators that the boundary forbids are refused") {
  const Mesh<2> grid = make_grid<2>({2, 1}, Point<2>(0, 0), Point<2>(2, 1));
  Cavity cavity;
  CHECK_FALSE(plan_rotation(grid, 0, 0, 0, cavity));                                         // a boundary edge
  for (int i = 0; i < 4; ++i) CHECK_FALSE(plan_diagonal_collapse(grid, 0, i, cavity));       // boundary vertices only
  std::vector<std::uint8_t> marks(grid.cells.size(), 0);
  Chord chord;
  find_chord(grid, 0, 3, marks, chord);  // along the two cells: its rungs join corners
  CHECK_FALSE(plan_chord_collapse(grid, chord, cavity));
  CHECK_FALSE(plan_boundary_collapse(grid, 0, cavity));                 // a corner
  CHECK_FALSE(plan_boundary_collapse(grid, 1, cavity));                 // between two corners
  CHECK_FALSE(plan_boundary_opening(grid, 0, 1, false, cavity));        // no cell on one side of it
  const Mesh<2> inside = make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(4, 4));
  CHECK_FALSE(plan_boundary_collapse(inside, 12, cavity));
}

TEST_CASE("a hole of four edges is not closed by laying two of them on each other") {
  MeshInput<2> in;
  for (const double r : {1.0, 2.0})
    for (const Point<2>& p : {Point<2>(r, 0), Point<2>(0, r), Point<2>(-r, 0), Point<2>(0, -r)}) in.points.push_back(p);
  for (int i = 0; i < 4; ++i) in.cells.push_back({(i + 1) % 4, i, (i + 1) % 4 + 4, i + 4});
  const Mesh<2> mesh = *make_mesh(in, {.corner_cosine = -0.5});
  Cavity cavity;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) CHECK_FALSE(plan_boundary_collapse(mesh, v, cavity));
}

TEST_CASE("a chord split on a curved boundary puts its new vertices on the curve's facets") {
  Mesh<2> mesh = corpus::ring(8, 2, true);
  std::vector<std::uint8_t> marks(mesh.cells.size(), 0);
  for (int side = 0; side < 2; ++side) {
    Mesh<2> split = mesh;
    Journal journal(split);
    Cavity cavity;
    std::vector<CellId> ids;
    Chord chord;
    find_chord(split, 0, side, marks, chord);
    REQUIRE(plan_chord_split(split, chord, cavity));
    REQUIRE(journal.apply(cavity, ids));
    check_topology(split);
    CHECK(validate(split).ok());
    CHECK(checks::distance_from_geometry(split) < 1e-12);
  }
}

}  // namespace cavity_test
