// Whether a change of topology is likely to be kept, told from lengths and valences before it is planned.
#pragma once

#include <vector>

#include "pillowmesh/adapt/trial.h"

namespace pillowmesh {

/// Odds of rotations, collapses and openings: linear in the lengths of the edges around, in the growth of irregularity, and
/// in what the change is allowed to cost. Coefficients: logistic regression on trials of three cases (docs/algorithm.md).
class Outlook {
 public:
  /// Must not outlive them.
  Outlook(const Mesh<2>& mesh, const Trial& trial) : mesh_(mesh), trial_(trial) {}

  /// Lengths are looked up again from here on; else only where a change was kept.
  void forget() { fans_.assign(mesh_.points.size(), Fan()); }
  /// The same, and holds no memory.
  void release() { std::vector<Fan>().swap(fans_); }

  [[nodiscard]] int valence(VertexId v) { return fan(v).cells; }
  /// By how much (valence - ideal)^2 grows when a vertex gets `change` cells more.
  [[nodiscard]] int excess(VertexId v, int change) {
    const int off = valence(v) - trial_.ideal(v);
    return change * (2 * off + change);
  }

  /// Logarithm of the odds that a change is kept which makes `excess` more irregularity and may cost `allowed`.
  /// Of the edge between side i of cell c and side j of cell n; `way` as in plan_rotation.
  double rotation(CellId c, int i, CellId n, int j, int way, int excess, double allowed);
  /// Of cell c, whose corners i and i + 2 are joined.
  double collapse(CellId c, int i, int excess, double allowed);
  /// Of a vertex with this star, along the spokes `first` and `last`.
  double opening(const OrderedStar& star, int first, int last, int excess, double allowed);
  /// Of so many cells in a row, whose rungs and other sides have these mean lengths.
  static double partial_collapse(int cells, int excess, double allowed, double rungs, double sides);
  /// Of a path of so many edges of this mean length, with edges of length `across` on both sides.
  static double partial_split(int edges, int excess, double allowed, double across, double along);

 private:
  struct Fan {
    Index seen = kNone;
    std::uint8_t cells = 0, spokes = 0;
    double sum = 0.0;  ///< of the lengths of the spokes
  };
  const Fan& fan(VertexId v);
  /// Mean length of the spokes of v but for `inside` of them that measure `sum` together.
  double beyond(VertexId v, int inside, double sum);

  const Mesh<2>& mesh_;
  const Trial& trial_;
  std::vector<Fan> fans_;
  OrderedStar star_;
};

}  // namespace pillowmesh
