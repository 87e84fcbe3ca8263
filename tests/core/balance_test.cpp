#include "pillowmesh/adapt/balance.h"

#include "../catch.h"

namespace balance_test {

using namespace pillowmesh;

TEST_CASE("alignment weighs more where more misalignment is left, and nothing where there is nothing to align") {
  AdaptOptions options;
  options.effort = Effort::best;
  const auto settled = [&](double align, double left) {
    options.align = align;
    Balance balance(options, false);
    double weight = 0.0;
    for (int i = 0; i < 40; ++i) weight = balance.alignment_for(left);
    return weight;
  };
  CHECK(settled(1.0, 0.08) < 0.6 * settled(1.0, 0.1));
  CHECK(settled(0.5, 0.1) == Approx(0.5 * settled(1.0, 0.1)).epsilon(1e-3));
  CHECK(settled(1.0, 1e-6) > 0.0);   // the directions of a finer mesh are worth something still
  CHECK(settled(1.0, 0.9) <= 1.0);
  CHECK(settled(1.0, 0.0) == 0.0);  // isotropic
  CHECK(settled(0.0, 0.3) == 0.0);
}

TEST_CASE("weights of the end come to rest where lengths, shapes and misalignment are as even as they should be") {
  AdaptOptions options;
  options.effort = Effort::best;
  options.align = 1.0;
  Balance balance(options, false);
  balance.alignment_for(0.1);
  const EnergyWeights first = balance.last(0.1);
  CHECK(first.length > balance.first().length);
  // Misalignment 0.066 + 0.42 * 0.1, a cv of 0.0795 and as much lack of shape.
  const QuadRelocator::Indicators even{0.0795, 0.0795, 0.108};
  EnergyWeights weights = first;
  balance.adjust(weights, even);
  CHECK(weights.obtuse == Approx(first.obtuse));
  CHECK(weights.alignment == Approx(first.alignment));
  balance.adjust(weights, {0.0795, 0.09, 0.108});
  CHECK(weights.obtuse > 1.2 * first.obtuse);
  CHECK(weights.alignment == Approx(first.alignment));
  weights = first;
  balance.adjust(weights, {0.09, 0.08, 0.1});
  CHECK(weights.obtuse < 0.8 * first.obtuse);
  CHECK(weights.alignment < 0.8 * first.alignment);
  // Shapes count as much where there is nothing to align, and more where alignment was not asked for.
  for (const double align : {1.0, 0.0}) {
    options.align = align;
    weights = first;
    Balance(options, false).adjust(weights, {0.0795, 0.0795, 0.0});
    if (align > 0.0)
      CHECK(weights.obtuse == Approx(first.obtuse));
    else
      CHECK(weights.obtuse > 1.1 * first.obtuse);
  }
  // A mesh that has come out exactly is left alone.
  weights = first;
  balance.adjust(weights, {0.0, 0.0, 0.11});
  CHECK(weights.obtuse == first.obtuse);
}

TEST_CASE("shapes of best below a floor have to leave it in the end, and the floor is higher without alignment") {
  AdaptOptions options;
  options.effort = Effort::best;
  const auto settled = [&](double misalignment) {
    Balance balance(options, false);
    balance.alignment_for(misalignment);
    return balance.settled(balance.last(0.1));
  };
  options.align = 1.0;
  const EnergyWeights aligned = settled(0.1), isotropic = settled(0.0);
  options.align = 0.0;
  CHECK(aligned.shape > 10.0 * Balance(options, false).last(0.1).shape);
  CHECK(isotropic.shape_floor > aligned.shape_floor);
  CHECK(settled(0.5).shape_floor > isotropic.shape_floor);
  CHECK(aligned.rough < EnergyWeights{}.rough);
  // Coarse meshes are not polished: their shapes do not count.
  const EnergyWeights coarse = Balance(options, true).first();
  CHECK(Balance(options, true).settled(coarse).shape == 0.0);
  options.effort = Effort::normal;
  CHECK(settled(0.1).shape == Balance(options, false).last(0.1).shape);
}

TEST_CASE("a weight of alignment that was asked for is kept at the end") {
  AdaptOptions options;
  options.align = 0.3;
  Balance balance(options, false);
  balance.alignment_for(0.2);
  EnergyWeights weights = balance.last(0.1);
  const double before = weights.alignment;
  balance.adjust(weights, {0.08, 0.08, 0.4});
  CHECK(weights.alignment == before);
}

}  // namespace balance_test
