// What alignment, lengths and shapes weigh against each other in the energy, told from what is left of each.
#pragma once

#include "pillowmesh/adapt/options.h"
#include "pillowmesh/smooth/quad_relocate.h"

namespace pillowmesh {

/// Where the metric turns much from cell to cell, alignment, lengths and shapes cannot all be had, and fixed weights would
/// spend everything on one of them: weights follow the mesh instead, a bit at a time.
class Balance {
 public:
  Balance(const AdaptOptions& options, bool coarse);

  /// To begin with: lengths hardly weigh more than the energy of corners has it, shapes nothing.
  [[nodiscard]] EnergyWeights first() const { return {.alignment = alignment_, .length = kLength}; }
  /// While cells are reconnected: the weight of alignment that goes with what is left of misalignment, a third of the way
  /// to it. \return 0 where there is nothing to align.
  double alignment_for(double misalignment);

  /// At the end it is lengths and shapes that count. `energy`: of a cell, which tells how much the metric turns.
  [[nodiscard]] EnergyWeights last(double energy);
  /// Of these, when only positions are left to change.
  [[nodiscard]] EnergyWeights settled(EnergyWeights last) const;
  /// Corrects weights of the end by what a mesh has left that they have shaped.
  void adjust(EnergyWeights& last, const QuadRelocator::Indicators& left) const;

 private:
  static constexpr double kLength = 0.05;

  const AdaptOptions& options_;
  double alignment_;
  double aligned_ = 0.0;  ///< the option, 0 where the metric is isotropic
  double misalignment_ = 0.0;  ///< to be left at the end
};

}  // namespace pillowmesh
