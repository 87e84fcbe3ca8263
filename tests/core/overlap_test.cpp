#include "pillowmesh/mesh/overlap.h"

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/mesh/validate.h"

namespace overlap_test {

using namespace pillowmesh;

TEST_CASE("no mesh of ours lies over itself") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) CHECK_FALSE(folded_at(mesh, v));
    CHECK(find_overlaps<2>(mesh, 10).empty());
  }
}

}  // namespace overlap_test
