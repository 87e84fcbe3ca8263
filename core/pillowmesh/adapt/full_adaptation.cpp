#include "pillowmesh/adapt/full_adaptation.h"

#include "pillowmesh/adapt/halving.h"
#include "pillowmesh/adapt/longest_edge.h"
#include "pillowmesh/mesh/compact.h"
#include "pillowmesh/metric/volume.h"

namespace pillowmesh {
namespace {

constexpr int kMostMended = 2;

/// The coarsest mesh is to have less than so many times the cells that are given. Layers start it well, but with several times
/// the cells it is to have, which takes time; where they have nothing to do, the search starts from squares: fast, rows that
/// follow the metric are fewer then (circle2d, fast: 13 moves a cell for 22, cv .16 for .14).
constexpr double kFewTimes = 2.0, kSeveralTimes = 6.0;

/// Share of the cells that a coarse mesh is to have from which on there are enough: where layers go through the whole mesh for
/// a few long edges the next would make several times as many, which the search takes long to remove (shock2d, normal: 120
/// moves a cell for 150).
constexpr double kEnough = 0.9;

/// How often sizes can be doubled until the cells that are given are about as many as there are to be.
int halvings_to_come(const Mesh<2>& mesh, double ideal, const AdaptOptions& options) {
  if (mesh.frozen) return 0;
  if (ideal > static_cast<double>(options.max_cells)) return 0;  // layers stop before that many
  int n = 0;
  const double times = options.effort == Effort::fast ? kFewTimes : kSeveralTimes;
  for (double cells = ideal; cells >= times * mesh.cell_count(); cells *= 0.25) ++n;
  return n;
}

}  // namespace

FullAdaptation::FullAdaptation(const Mesh<2>& mesh, const MetricField<2>& field, const AdaptOptions& options,
                               Recorder<2>& recorder, std::map<std::string, std::int64_t>& operations)
    : options_(options),
      recorder_(recorder),
      operations_(operations),
      ideal_cells_(complexity(mesh, field, {.tolerance = 1e-2})),
      halvings_(halvings_to_come(mesh, ideal_cells_, options)) {}

bool FullAdaptation::has_enough(const Mesh<2>& mesh) const {
  // The last layers are the best: rows along the feature where it is sharpest.
  if (halvings_ == 0 || options_.effort == Effort::best) return false;
  return mesh.cell_count() >= kEnough * ideal_cells_ / (coarser() * coarser());
}

void FullAdaptation::begin(const Mesh<2>& mesh) {
  diced_ = 10 * mesh.cell_count() < 11 * cells_before_layers_;  // a few layers more only have to be mended
}

/// Lookups of the target. A mesh that was diced asks for much of what the coarse one has asked for.
Background& FullAdaptation::look_up(const Mesh<2>& mesh, const MetricField<2>& target) {
  Point<2> low = mesh.points[0], high = low;
  for (const Point<2>& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  if (background_ && background_->is_for(low, high) && background_coarser_ == 2 * coarser()) {
    background_->halve_sizes(target);
  } else if (!background_ || !background_->is_for(low, high) || background_coarser_ != coarser()) {
    const double smallest = options_.effort == Effort::best ? 0.5 : 1.0;
    background_ = std::make_unique<Background>(target, low, high, BackgroundOptions{.tolerance = 5e-3, .smallest = smallest});
  }
  background_coarser_ = coarser();
  return *background_;
}

FullAdaptation::Next FullAdaptation::step(Mesh<2>& mesh, const MetricField<2>& field, const MetricField<2>& target,
                                          int iteration) {
  if (!schedule_)
    schedule_ = std::make_unique<Schedule>(mesh, look_up(mesh, target), options_, diced_, halvings_, recorder_,
                                           operations_, iteration);
  const bool more = schedule_->step();
  activity_ = schedule_->activity();
  if (more) return Next::step;
  schedule_.reset();
  if (halvings_ > 0) return halve(mesh, field, iteration);
  // What the layers could not shorten the operators may have, and the other way round.
  const bool met = longest_edge(mesh, target) <= options_.threshold * (1.0 + kLongestEdgeTolerance);
  if (!met && mended_++ < kMostMended) return insert_layers(mesh);
  outcome_ = met ? Status{} : Status::limit_not_met("edges longer than the threshold remain");
  background_.reset();
  return Next::done;
}

/// Every cell in four, for sizes half as large. What is too long then is relocated first: layers through cells that are out
/// of shape would go everywhere.
FullAdaptation::Next FullAdaptation::halve(Mesh<2>& mesh, const MetricField<2>& field, int iteration) {
  recorder_.before_dice(mesh);
  compact(mesh);
  diced_ = 4 * static_cast<std::int64_t>(mesh.cell_count()) <= options_.max_cells && halve_sizes(mesh, field).ok();
  halvings_ = diced_ ? halvings_ - 1 : 0;
  recorder_.dice(mesh, iteration);
  return diced_ ? Next::finer : insert_layers(mesh);
}

FullAdaptation::Next FullAdaptation::insert_layers(const Mesh<2>& mesh) {
  cells_before_layers_ = diced_ ? mesh.cell_count() : 0;
  return Next::layers;
}

/// Each mesh takes four times as long as the coarser one before it.
double FullAdaptation::share() const {
  const double share = schedule_ ? schedule_->share() : 1.0;
  return (diced_ ? 0.25 + 0.75 * share : share) / static_cast<double>(std::int64_t{1} << (2 * halvings_));
}

}  // namespace pillowmesh
