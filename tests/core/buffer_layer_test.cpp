#include "pillowmesh/refine/buffer_layer.h"

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/mesh/validate.h"

using namespace pillowmesh;

namespace {

template <int Dim>
Index euler(const Mesh<Dim>& mesh) {
  Index boundary = 0, cells = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    ++cells;
    for (int f = 0; f < Cell<Dim>::facets; ++f) boundary += mesh.on_boundary(c, f);
  }
  const Index facets = (cells * Cell<Dim>::facets + boundary) / 2;
  const Index edges = static_cast<Index>(unique_edges(mesh).size());
  return Dim == 2 ? mesh.vertex_count() - edges + cells : mesh.vertex_count() - edges + facets - cells;
}

/// Inserts random layers, validating after each. Returns how many of them gave a mesh.
template <int Dim>
int insert_at_random(Mesh<Dim> mesh, int trials, std::size_t largest, unsigned seed, bool restart) {
  const Mesh<Dim> initial = mesh;
  const Index number = euler(mesh);
  std::mt19937 random(seed);
  PillowWorkspace<Dim> work;
  BufferLayer<Dim> layer;
  int inserted = 0;
  for (int i = 0; i < trials; ++i) {
    if (restart) mesh = initial;
    const auto set = corpus::random_set(mesh, 1 + random() % largest, random);
    const Mesh<Dim> before = mesh;
    const Status s = insert_buffer_layer<Dim>(mesh, set, {}, work, layer);
    INFO("seed " << seed << ", trial " << i << ", set of " << set.size());
    if (!s.ok()) {
      REQUIRE(s.code == StatusCode::illegal);
      REQUIRE(corpus::identical(mesh, before));
      continue;
    }
    ++inserted;
    INFO(validate(mesh).message);
    REQUIRE(validate(mesh).ok());
    REQUIRE(euler(mesh) == number);
    REQUIRE(mesh.cell_count() == before.cell_count() + layer.cell_count);
  }
  return inserted;
}

}  // namespace

TEST_CASE("a buffer layer around one inner quad adds four quads and four vertices") {
  auto mesh = make_grid<2>({3, 3}, Point<2>(0, 0), Point<2>(3, 3));
  PillowWorkspace<2> work;
  BufferLayer<2> layer;
  REQUIRE(insert_buffer_layer<2>(mesh, std::vector<CellId>{4}, {}, work, layer).ok());
  CHECK(mesh.cell_count() == 13);
  CHECK(mesh.vertex_count() == 20);
  CHECK(validate(mesh).ok());
  // The shrunk quad is the middle third.
  CHECK(mesh.points[mesh.cells[4][0]][0] == Approx(1 + 1.0 / 3));
  CHECK(mesh.points[mesh.cells[4][3]][1] == Approx(2 - 1.0 / 3));
}

TEST_CASE("a whole row that meets the boundary is split in three, a boundary row in two") {
  PillowWorkspace<2> work;
  BufferLayer<2> layer;
  auto mesh = make_grid<2>({4, 3}, Point<2>(0, 0), Point<2>(4, 3));
  REQUIRE(insert_buffer_layer<2>(mesh, std::vector<CellId>{4, 5, 6, 7}, {}, work, layer).ok());
  CHECK(mesh.cell_count() == 12 + 8);
  REQUIRE(insert_buffer_layer<2>(mesh, std::vector<CellId>{0, 1, 2, 3}, {}, work, layer).ok());
  CHECK(mesh.cell_count() == 12 + 8 + 4);
  CHECK(validate(mesh).ok());
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    CHECK((mesh.support[v].dim == 2) ==
          (mesh.points[v][0] > 0 && mesh.points[v][0] < 4 && mesh.points[v][1] > 0 && mesh.points[v][1] < 3));
}

TEST_CASE("the whole mesh has no hull unless part of the boundary is named") {
  auto mesh = make_grid<2>({3, 1}, Point<2>(0, 0), Point<2>(3, 1));
  const auto before = mesh;
  PillowWorkspace<2> work;
  BufferLayer<2> layer;
  const std::vector<CellId> all{0, 1, 2};
  CHECK(insert_buffer_layer<2>(mesh, all, {}, work, layer).code == StatusCode::illegal);
  CHECK(corpus::identical(mesh, before));
  std::vector<HalfFacetId> bottom;
  for (const CellId c : all) bottom.push_back(mesh.half_facet(c, Cell<2>::facet(1, 0)));
  REQUIRE(insert_buffer_layer<2>(mesh, all, bottom, work, layer).ok());
  CHECK(mesh.cell_count() == 6);
  CHECK(validate(mesh).message == "");
}

TEST_CASE("two shrunk quads that touch at a vertex get a copy of it each, the rest keeps it") {
  auto mesh = make_grid<2>({4, 4}, Point<2>(0, 0), Point<2>(4, 4));
  PillowWorkspace<2> work;
  BufferLayer<2> layer;
  REQUIRE(insert_buffer_layer<2>(mesh, std::vector<CellId>{5, 10}, {}, work, layer).ok());
  CHECK(layer.origins.size() == 8);  // 4 + 4 corners; the vertex they share is copied twice
  CHECK(mesh.cell_count() == 16 + 8);
  CHECK(validate(mesh).ok());
}

TEST_CASE("random layers on quad meshes stay valid and keep the Euler number") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    for (unsigned seed : {1u, 2u, 3u}) CHECK(insert_at_random(mesh, 12, 9, seed, false) >= 8);
    CHECK(insert_at_random(mesh, 60, 9, 11, true) >= 40);
  }
}

TEST_CASE("random layers on hex meshes stay valid and keep the Euler number") {
  for (const auto& [name, mesh] : corpus::meshes<3>()) {
    INFO(name);
    CHECK(insert_at_random(mesh, 60, 25, 5, true) >= 40);
  }
}
