// Which changes of topology are tried, and in what order: passes over the cells of a quad mesh.
#pragma once

#include "pillowmesh/adapt/outlook.h"
#include "pillowmesh/adapt/random.h"
#include "pillowmesh/adapt/refusals.h"
#include "pillowmesh/adapt/trial.h"
#include "pillowmesh/mesh/chord.h"

namespace pillowmesh {

/// Tries rotations, collapses and openings, inside and at the boundary, around irregular vertices and badly sized cells, at
/// a temperature: a change that raises the energy by dE is kept with the probability exp(-dE / T) (Metropolis), where a
/// cell more counts as a little less energy, at any temperature (cell_bonus). At T = 0 only where something has changed
/// since a cell was last looked at.
class LocalSearch {
 public:
  /// Must not outlive `trial`.
  LocalSearch(Mesh<2>& mesh, Trial& trial, std::uint64_t seed) : mesh_(mesh), trial_(trial), outlook_(mesh, trial), random_(seed) {}

  /// T in units of one ideal cell. A pass is over all cells that there are when it comes to them.
  /// \param above only over those with more energy than this, where it is not 0
  void begin_pass(double temperature, double above = 0.0);
  /// Goes on with the pass for about `moves` vertex moves. \return false when it is over.
  bool continue_pass(std::int64_t moves);
  /// Changes kept since begin_pass.
  [[nodiscard]] std::int64_t kept() const { return kept_; }
  /// No pass comes any more: holds no memory for each cell.
  void release();

  /// Tries to collapse chords where there is a row too many, and to split those where there is one too few. Chords once
  /// each, where so much energy may be gained for each of their cells. \return the changes kept. Cost: all chords are
  /// walked.
  std::int64_t chord_pass(double least_gain);

  /// What a cell is worth beyond its energy; twice that in part of a row. An opening is relaxed from a sliver and judged too
  /// early more often than a collapse; without this the search loses cells. Opening and collapsing again cannot go on for
  /// ever: what one may cost the other must gain.
  double cell_bonus = 0.15;
  /// In hot passes cells with a smaller metric area, the product of their mean lengths, are only collapsed: where layers
  /// have made several times the cells that there are to be, the rest can wait.
  double crowded_area = 0.0;

 private:
  bool interesting(CellId c);
  [[nodiscard]] bool is_crowded(CellId c) const;
  void try_all(CellId c);
  double allowance(double bonus);
  [[nodiscard]] bool hopeless(double odds) const;
  bool attempt(Operator op, double allowed);
  double chord_gain();
  bool attempt_chord(Operator op);
  void try_rotations(CellId c);
  void try_collapses(CellId c);
  void try_openings(CellId c);
  void try_boundary_collapses(CellId c);
  void try_boundary_openings(CellId c);
  void try_partial_collapses(CellId c, int side);
  void try_partial_splits(CellId c, int side);

  Mesh<2>& mesh_;
  Trial& trial_;
  Outlook outlook_;
  Refusals refusals_;
  Random random_;
  double temperature_ = 0.0, above_ = 0.0;
  CellId next_ = 0;
  std::int64_t kept_ = 0;
  std::vector<Index> looked_;  ///< per cell: when its candidates were last tried
  std::vector<std::uint8_t> marks_;
  Chord chord_, across_;
  std::vector<ChordCell> part_;
  std::vector<VertexId> path_;
  int attempts_at_large_ = 0;  ///< rows that the whole mesh was relocated for
  int refused_at_large_ = 0;
};

}  // namespace pillowmesh
