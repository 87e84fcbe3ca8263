#include "pillowmesh/adapt/balance.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh {
namespace {

/// Weight of alignment when the option asks for all of it, to begin with. In coarse meshes the directions of the metric turn
/// more from cell to cell: there it draws less, and weighs more.
constexpr double kAlignment = 0.4, kCoarseAlignment = 0.6;
/// Afterwards it is kAlignment times this power of the misalignment that is left, over the one below: where the metric turns
/// little, alignment is had for less, and where it turns much, it is not given up. With little time the sizes come first.
constexpr double kAlignmentPower = 4.0;
double common_misalignment(Effort effort) { return effort == Effort::best ? 0.105 : 0.12; }
constexpr double kLeastAlignment = 0.05, kMostAlignment = 1.0;

/// Weights of the end; that of alignment is in proportion to the one before, that of obtuse corners to the energy of a cell
/// to the power 3/2. These are guesses that `adjust` makes good.
constexpr double kLastLength = 0.4, kLastShape = 30.0, kLastAlignment = 1.6;
/// When topology is settled, what is below this floor has to leave it. Alignment costs shapes: without it the floor is higher, and
/// between where there is nothing to align. That takes more iterations than other efforts have.
constexpr double kFloorWeight = 1000.0, kFloor = 0.57, kFloorIsotropic = 0.62, kFloorUnaligned = 0.656;
/// At kinks lengths may be off by so many parts in a hundred: in the polish, and when topology is settled.
constexpr double kRough = 4.0, kFine = 0.2;
double last_obtuse(Effort effort) { return effort == Effort::best ? 6.0 : 9.0; }
/// Of misalignment there may be left: this, and so much more for each unit of energy.
constexpr double kLeftAlways = 0.066, kLeftByEnergy = 0.42;
/// Of shapes 1 - eta may be left in the mean: as much as the cv of lengths where that is kEven, and a little more than in
/// proportion. Without alignment more is given to shapes.
constexpr double kEven = 0.0795, kEvenUnaligned = 0.1, kEvenPower = 1.34;
/// A part in a hundred of one takes so many parts in a hundred of its weight.
constexpr double kResponse = 4.0, kMostAtOnce = 1.6;

double corrected(double weight, double ratio) {
  return weight * std::clamp(portable::pow(ratio, kResponse), 1.0 / kMostAtOnce, kMostAtOnce);
}

}  // namespace

Balance::Balance(const AdaptOptions& options, bool coarse)
    : options_(options), alignment_((coarse ? kCoarseAlignment : kAlignment) * options.align) {}

double Balance::alignment_for(double misalignment) {
  if (misalignment == 0.0 || options_.align == 0.0) return 0.0;
  aligned_ = options_.align;
  const double drawn = kAlignment * portable::pow(misalignment / common_misalignment(options_.effort), kAlignmentPower);
  const double weight = options_.align * std::clamp(drawn, kLeastAlignment, kMostAlignment);
  alignment_ *= portable::pow(weight / alignment_, 1.0 / 3.0);
  return alignment_;
}

EnergyWeights Balance::last(double energy) {
  misalignment_ = kLeftAlways + kLeftByEnergy * energy;
  return {.alignment = kLastAlignment * alignment_,
          .shape = kLastShape,
          .obtuse = last_obtuse(options_.effort) * energy * std::sqrt(energy),
          .length = kLastLength,
          .rough = kRough};
}

EnergyWeights Balance::settled(EnergyWeights last) const {
  last.rough = kFine;
  if (last.shape > 0.0 && options_.effort == Effort::best) {
    last.shape = kFloorWeight;
    last.shape_floor = aligned_ > 0.0 ? kFloor : (options_.align > 0.0 ? kFloorIsotropic : kFloorUnaligned);
  }
  return last;
}

void Balance::adjust(EnergyWeights& last, const QuadRelocator::Indicators& left) const {
  if (left.spread > 0.0) {
    const double even = options_.align > 0.0 ? kEven : kEvenUnaligned, lack = even * portable::pow(left.spread / even, kEvenPower);
    last.obtuse = corrected(last.obtuse, left.lack / lack);
  }
  if (aligned_ == 1.0) last.alignment = corrected(last.alignment, left.misalignment / misalignment_);
}

}  // namespace pillowmesh
