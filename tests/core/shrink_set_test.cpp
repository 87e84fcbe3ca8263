// Random shrink sets: each gives a valid mesh, or is refused with the mesh untouched, and few are refused.
#include <cstdlib>
#include <map>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/io/io.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/refine/buffer_layer.h"
#include "shared_data.h"

namespace shrink_set_test {

using namespace pillowmesh;

namespace {

struct Tally {
  int sets = 0, given = 0;
  int enlarged = 0;  ///< cells had to be added to the set
  std::map<std::string, int> refusals;  ///< by reason, without the numbers in it
  double share() const { return sets == 0 ? 1.0 : static_cast<double>(given) / sets; }
};

/// Tries `sets` random proper subsets of 1 to `largest` cells, each on the mesh as it came.
Tally try_random_sets(const Mesh<3>& initial, int sets, std::size_t largest, unsigned seed,
                      std::int64_t most_untangling = std::numeric_limits<std::int64_t>::max()) {
  std::mt19937 random(seed);
  PillowWorkspace<3> work;
  work.most_untangling = most_untangling;
  BufferLayer<3> layer;
  Tally tally;
  Mesh<3> mesh = initial;
  largest = std::min(largest, initial.cells.size() - 1);
  while (tally.sets < sets) {
    const auto set = corpus::random_set(mesh, 1 + random() % largest, random);
    ++tally.sets;
    std::string cells;
    for (const CellId c : set) cells += std::to_string(c) + " ";
    INFO("seed " << seed << ", set " << tally.sets << ": " << cells);
    const Status s = insert_buffer_layer<3>(mesh, set, {}, work, layer);
    if (!s.ok()) {
      REQUIRE(s.code == StatusCode::illegal);
      REQUIRE_FALSE(s.message.empty());
      REQUIRE(corpus::identical(mesh, initial));
      std::string reason;
      for (const char c : s.message)
        if (c < '0' || c > '9') reason += c;
      ++tally.refusals[reason];
      continue;
    }
    ++tally.given;
    tally.enlarged += !layer.added.empty();
    REQUIRE(layer.cell_count > 0);
    REQUIRE(mesh.cell_count() == initial.cell_count() + layer.cell_count);
    const Status valid = validate(mesh);
    INFO(valid.message);
    REQUIRE(valid.ok());
    REQUIRE(find_inside_defects(mesh, 1).empty());
    mesh = initial;
  }
  return tally;
}

void print(const std::string& name, std::size_t largest, unsigned seed, const Tally& t) {
  std::printf("%-16s seed %u, sets of 1 to %3zu cells: %d of %d give a valid mesh (%.1f %%), %d of them enlarged\n",
              name.c_str(), seed, largest, t.given, t.sets, 100 * t.share(), t.enlarged);
  for (const auto& [reason, count] : t.refusals) std::printf("    %d refused: %s\n", count, reason.c_str());
}

Mesh<3> primitive(const char* spec) { return std::get<Mesh<3>>(*parse_primitive(spec)); }

/// Primitives, and the meshes of others, those of ../shared/data where they are present.
std::vector<corpus::Named<3>> meshes_to_shrink() {
  std::vector<corpus::Named<3>> out;
  out.push_back({"cube", primitive("grid:4,4,4:0,1,0,1,0,1")});
  out.push_back({"o-grid", primitive("ogrid:4,2,4:1,0,2")});
  for (const char* name : {"ellipsoid_hex", "hexbox/val3", "hexbox/val5", "hexbox/val11", "hexbox/Torus"}) {
    const std::string file = shared_data::path(std::string(name) + ".mesh");
    if (file.empty()) continue;
    auto mesh = read_mesh_file(file);
    REQUIRE(mesh.ok());
    out.push_back({name, std::get<Mesh<3>>(std::move(*mesh))});
  }
  return out;
}

}  // namespace

TEST_CASE("random shrink sets give a valid mesh or leave the mesh untouched, and most give one") {
  for (const auto& [name, mesh] : meshes_to_shrink()) {
    INFO(name);
    const int sets = mesh.cells.size() > 1000 ? 25 : 60;
    for (const std::size_t largest : {8u, 25u}) {
      const Tally tally = try_random_sets(mesh, sets, largest, 1);
      print(name, largest, 1, tally);
      CHECK(tally.share() >= 0.95);
    }
  }
}

TEST_CASE("the less may be untangled, the more sets are refused; a hundred thousand evaluations give nearly all") {
  const auto mesh = primitive("ogrid:4,2,4:1,0,2");
  const int none = try_random_sets(mesh, 60, 25, 1, 0).given;
  const int few = try_random_sets(mesh, 60, 25, 1, 1000).given;
  const int most = try_random_sets(mesh, 60, 25, 1, 100'000).given;
  INFO(none << " " << few << " " << most);
  CHECK(none < few);
  CHECK(few < most);
  CHECK(most >= 57);
}

TEST_CASE("sets on the o-grid that touch themselves so that they have to be enlarged give a valid mesh") {
  const auto mesh = primitive("ogrid:4,2,4:1,0,2");
  PillowWorkspace<3> work;
  BufferLayer<3> layer;
  for (const std::vector<CellId>& set :
       {std::vector<CellId>{11, 59, 18, 19, 63}, {108, 60, 120, 168, 71}, {115, 131, 67, 132, 68}}) {
    Mesh<3> shrunk = mesh;
    INFO(set[0]);
    REQUIRE(insert_buffer_layer<3>(shrunk, set, {}, work, layer).ok());
    CHECK(layer.added.size() == 1);
    CHECK(validate(shrunk).message == "");
    CHECK(find_inside_defects(shrunk).empty());
  }
}

TEST_CASE("no hex is left inverted inside with all corner Jacobians positive") {
  const auto mesh = primitive("ogrid:4,2,4:1,0,2");
  Mesh<3> shrunk = mesh;
  PillowWorkspace<3> work;
  BufferLayer<3> layer;
  REQUIRE(insert_buffer_layer<3>(shrunk, std::vector<CellId>{162, 155, 151, 154, 106, 102, 114}, {}, work, layer).ok());
  CHECK(find_inside_defects(shrunk).empty());
  const std::string torus = shared_data::path("hexbox/Torus.mesh");
  if (torus.empty()) return;
  shrunk = std::get<Mesh<3>>(*read_mesh_file(torus));
  REQUIRE(find_inside_defects(shrunk).empty());
  REQUIRE(insert_buffer_layer<3>(shrunk, std::vector<CellId>{182, 178, 189, 191}, {}, work, layer).ok());
  CHECK(find_inside_defects(shrunk).empty());
}

TEST_CASE("a cell is added where the shrink set touches itself as no layer can be wrapped around") {
  // Five of the eight cells at the vertex (2, 1, 1), a path around it, the ends of which share the edge to (2, 2, 1) only:
  //
  //   z = 0:  S .     z = 1:  . S      The set is connected at (2, 1, 1), at (2, 2, 1) it is not, the rest is.
  //           S S             . S
  const auto mesh = primitive("grid:4,4,4:0,4,0,4,0,4");
  const std::vector<CellId> set{5, 2, 1, 22, 18};
  Mesh<3> shrunk = mesh;
  PillowWorkspace<3> work;
  BufferLayer<3> layer;
  REQUIRE(insert_buffer_layer<3>(shrunk, set, {}, work, layer).ok());
  CHECK(layer.added.size() == 1);
  CHECK((layer.added[0] == 6 || layer.added[0] == 21));  // one of the two that part the ends
  CHECK(validate(shrunk).message == "");
  // Without the cell at one end the set is an ordinary one.
  shrunk = mesh;
  REQUIRE(insert_buffer_layer<3>(shrunk, std::vector<CellId>{2, 1, 22, 18}, {}, work, layer).ok());
  CHECK(layer.added.empty());
}

TEST_CASE("a hex that touches a feature edge only lets go of it") {
  // The hex inside the re-entrant edge of an L, and the two beside it: the L keeps its edge.
  const auto mesh = primitive("lprism:4,2,4:1,.5,0,1");
  PillowWorkspace<3> work;
  BufferLayer<3> layer;
  for (const CellId c : {5, 17, 29, 41}) {
    Mesh<3> shrunk = mesh;
    INFO(c);
    REQUIRE(insert_buffer_layer<3>(shrunk, std::vector<CellId>{c}, {}, work, layer).ok());
    CHECK(validate(shrunk).message == "");
    for (const VertexId v : shrunk.cells[c]) CHECK(shrunk.support[v].dim >= 2);
  }
}

TEST_CASE("layers upon layers of random shrink sets stay valid") {
  for (const char* spec :
       {"grid:3,3,3:0,1,0,1,0,1", "ogrid:2,1,2:1,0,1", "quarter:2,1,2:.5,1,0,1", "lprism:4,2,2:1,.5,0,1"}) {
    INFO(spec);
    Mesh<3> mesh = primitive(spec);
    std::mt19937 random(7);
    PillowWorkspace<3> work;
    BufferLayer<3> layer;
    int given = 0;
    for (int i = 0; i < 12; ++i) {
      const Mesh<3> before = mesh;
      const auto set = corpus::random_set(mesh, 1 + random() % 8, random);
      if (insert_buffer_layer<3>(mesh, set, {}, work, layer).ok()) {
        ++given;
        REQUIRE(validate(mesh).message == "");
      } else {
        REQUIRE(corpus::identical(mesh, before));
      }
    }
    CHECK(given >= 6);
  }
}

// pillowmesh_tests "[.full]": 500 sets on each mesh, and larger sets. Minutes.
TEST_CASE("of 500 random shrink sets on each mesh 95 of 100 give a valid mesh", "[.full]") {
  unsigned seed = 2;
  for (const std::size_t largest : {8u, 25u, 60u})
    for (const auto& [name, mesh] : meshes_to_shrink()) {
      INFO(name);
      // Validation of the whole of a large mesh after each set takes its time.
      const int sets = mesh.cells.size() > 1000 && largest > 25 ? 100 : 500;
      const Tally tally = try_random_sets(mesh, sets, largest, ++seed);
      print(name, largest, seed, tally);
      CHECK(tally.share() >= 0.95);
    }
}

}  // namespace shrink_set_test
