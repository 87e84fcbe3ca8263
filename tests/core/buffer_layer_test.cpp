#include "pillowmesh/refine/buffer_layer.h"

#include "../catch.h"
#include "checks.h"
#include "meshes.h"
#include "pillowmesh/mesh/validate.h"

namespace buffer_layer_test {

using namespace pillowmesh;

namespace {

/// Inserts random layers, validating after each. Returns the share of them that gave a mesh. A set that is the whole mesh
/// has no hull, and is not counted.
template <int Dim>
double insert_at_random(Mesh<Dim> mesh, int trials, std::size_t largest, unsigned seed, bool restart) {
  const Mesh<Dim> initial = mesh;
  const Index number = checks::euler(mesh);
  std::mt19937 random(seed);
  PillowWorkspace<Dim> work;
  BufferLayer<Dim> layer;
  int inserted = 0, tried = 0;
  for (int i = 0; i < trials; ++i) {
    if (restart) mesh = initial;
    const auto set = corpus::random_set(mesh, 1 + random() % largest, random);
    if (set.size() == mesh.cells.size()) continue;
    ++tried;
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
    REQUIRE(checks::euler(mesh) == number);
    REQUIRE(mesh.cell_count() == before.cell_count() + layer.cell_count);
  }
  return static_cast<double>(inserted) / tried;
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
    for (unsigned seed : {1u, 2u, 3u}) CHECK(insert_at_random(mesh, 12, 9, seed, false) >= 0.6);
    CHECK(insert_at_random(mesh, 60, 9, 11, true) >= 0.9);
  }
}

TEST_CASE("random layers on hex meshes stay valid and keep the Euler number") {
  for (const auto& [name, mesh] : corpus::meshes<3>()) {
    INFO(name);
    CHECK(insert_at_random(mesh, 60, 8, 5, true) >= 0.95);
    CHECK(insert_at_random(mesh, 20, 25, 6, true) >= 0.95);
  }
}

}  // namespace buffer_layer_test
