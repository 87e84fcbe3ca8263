// The corner simplices of a cell, by which shapes are measured.
#pragma once

#include <array>
#include <utility>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/metric/volume.h"

namespace pillowmesh {

/// The corner simplices of a cell as index arithmetic. The edges of simplex k run from corner k to corner k ^ (1 << d),
/// and between those ends, in the order of SimplexLengths.
template <int Dim>
struct CornerSimplex {
  static constexpr int edges = Dim * (Dim + 1) / 2;

  static constexpr std::array<int, 2> edge(int k, int i) {
    if (i < Dim) return {k, k ^ (1 << i)};
    // i = Dim, Dim + 1, Dim + 2 join the ends along the axes (0, 1), (0, 2), (1, 2).
    const int a = i == Dim + 2 ? 1 : 0;
    const int b = i == Dim ? 1 : 2;
    return {k ^ (1 << a), k ^ (1 << b)};
  }
};

/// The pairs of corners that are an edge of some corner simplex, each once, and the place of each simplex edge among them.
template <int Dim>
struct SimplexPairs {
  static constexpr int count = Dim == 2 ? 6 : 24;  // edges, and diagonals of quadrilaterals
  std::array<std::array<int, 2>, count> pair{};
  std::array<std::array<int, CornerSimplex<Dim>::edges>, Cell<Dim>::corners> place{};

  constexpr SimplexPairs() {
    int found = 0;
    for (int k = 0; k < Cell<Dim>::corners; ++k) {
      for (int i = 0; i < CornerSimplex<Dim>::edges; ++i) {
        const std::array<int, 2> e = CornerSimplex<Dim>::edge(k, i);
        const int low = e[0] < e[1] ? e[0] : e[1];
        const int high = e[0] < e[1] ? e[1] : e[0];
        int at = 0;
        while (at < found && !is(at, low, high)) ++at;
        if (at == found) {
          pair[found][0] = low;
          pair[found++][1] = high;
        }
        place[k][i] = at;
      }
    }
  }

  /// The pair of these corners. \pre a < b, some simplex has that edge
  [[nodiscard]] constexpr int find(int a, int b) const {
    int j = 0;
    while (!is(j, a, b)) ++j;
    return j;
  }

  /// Whether pair j is an edge of the cell, and no diagonal.
  [[nodiscard]] constexpr bool is_edge(int j) const {
    const int bits = pair[j][0] ^ pair[j][1];
    return (bits & (bits - 1)) == 0;
  }

 private:
  [[nodiscard]] constexpr bool is(int j, int a, int b) const { return pair[j][0] == a && pair[j][1] == b; }
};

/// The simplex at corner k of cell c, positively oriented where the cell is.
template <int Dim>
SimplexPoints<Dim> corner_simplex(const Mesh<Dim>& mesh, CellId c, int k) {
  const auto point = [&](int corner) { return mesh.points[mesh.cells[c][corner]]; };
  SimplexPoints<Dim> p{point(k)};
  for (int d = 0; d < Dim; ++d) p[1 + d] = point(k ^ (1 << d));
  if (Cell<Dim>::corner_sign(k) < 0) std::swap(p[1], p[2]);
  return p;
}

}  // namespace pillowmesh
