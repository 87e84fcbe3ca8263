// The curves of a boundary: its pieces put in order, from corner to corner or around.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pillowmesh/mesh/ids.h"

namespace pillowmesh {

struct Chain {
  std::vector<Index> pieces;           ///< in order
  std::vector<std::uint8_t> reversed;  ///< per piece: 1 if the chain runs through it from its end to its beginning
  std::vector<Index> vertices;         ///< as many as pieces in a closed chain, else one more
  bool closed = false;

  /// Vertex k of the chain; in a closed chain k may pass the ends by less than its length.
  [[nodiscard]] Index vertex(Index k) const {
    const Index n = static_cast<Index>(vertices.size());
    return vertices[closed ? (k + n) % n : k];
  }
};

/// `ends` and `neighbours` of each piece, by end; kNone where a curve ends. Cost: linear.
inline std::vector<Chain> find_chains(const std::vector<std::array<Index, 2>>& ends,
                                      const std::vector<std::array<Index, 2>>& neighbours) {
  std::vector<Chain> chains;
  std::vector<std::uint8_t> seen(ends.size(), 0);
  const auto follow = [&](Index piece, int begin) {
    Chain& chain = chains.emplace_back();
    chain.vertices.push_back(ends[piece][begin]);
    while (piece != kNone && !seen[piece]) {
      seen[piece] = 1;
      chain.pieces.push_back(piece);
      chain.reversed.push_back(static_cast<std::uint8_t>(begin));
      const Index v = ends[piece][1 - begin];
      chain.vertices.push_back(v);
      piece = neighbours[piece][1 - begin];
      if (piece != kNone) begin = ends[piece][0] == v ? 0 : 1;
    }
    chain.closed = piece != kNone;
    if (chain.closed) chain.vertices.pop_back();
  };
  for (Index i = 0; i < static_cast<Index>(ends.size()); ++i)
    for (int end = 0; end < 2; ++end)
      if (!seen[i] && neighbours[i][end] == kNone) follow(i, end);
  for (Index i = 0; i < static_cast<Index>(ends.size()); ++i)
    if (!seen[i]) follow(i, 0);
  return chains;
}

}  // namespace pillowmesh
