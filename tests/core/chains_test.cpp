#include "pillowmesh/mesh/chains.h"

#include "../catch.h"
#include "meshes.h"

namespace chains_test {

using namespace pillowmesh;

TEST_CASE("a curve is followed from corner to corner, whatever the directions of its pieces") {
  // 0 -- 1 -- 2 -- 3, the middle piece the other way round
  const std::vector<std::array<Index, 2>> ends{{2, 3}, {2, 1}, {0, 1}};
  const std::vector<std::array<Index, 2>> neighbours{{1, kNone}, {0, 2}, {kNone, 1}};
  const auto chains = find_chains(ends, neighbours);
  REQUIRE(chains.size() == 1);
  CHECK(!chains[0].closed);
  CHECK(chains[0].vertices == std::vector<Index>{3, 2, 1, 0});
  CHECK(chains[0].pieces == std::vector<Index>{0, 1, 2});
  CHECK(chains[0].reversed == std::vector<std::uint8_t>{1, 0, 1});
}

TEST_CASE("every boundary edge is in one chain, end to end; round boundaries are closed") {
  for (const auto& [name, mesh] : corpus::meshes<2>()) {
    INFO(name);
    const auto& g = *mesh.geometry;
    std::size_t pieces = 0;
    for (const Chain& chain : find_chains(g.facets, g.neighbours)) {
      pieces += chain.pieces.size();
      CHECK(chain.vertices.size() == chain.pieces.size() + (chain.closed ? 0 : 1));
      for (Index k = 0; k < static_cast<Index>(chain.pieces.size()); ++k) {
        const auto& f = g.facets[chain.pieces[k]];
        CHECK(f[chain.reversed[k]] == chain.vertex(k));
        CHECK(f[1 - chain.reversed[k]] == chain.vertex(k + 1));
      }
    }
    CHECK(pieces == g.facets.size());
  }
  const auto ring = corpus::ring(24, 2, true);
  const auto chains = find_chains(ring.geometry->facets, ring.geometry->neighbours);
  REQUIRE(chains.size() == 2);
  CHECK(chains[0].closed);
  CHECK(chains[1].closed);
}

}  // namespace chains_test
