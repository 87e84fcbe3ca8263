#include "pillowmesh/adapt/schedule.h"

#include <algorithm>

#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh {
namespace {

constexpr std::int64_t kMovesPerStep = 4000;
constexpr int kRelaxSweeps = 5;

/// How much is spent. Temperatures fall geometrically.
struct Budget {
  int hot_passes;
  double hot, cool;
  int rows_every;  ///< hot pass rows are removed and doubled
  int cold_passes, polish_rounds;
  int relax_sweeps, settle_sweeps;
};
Budget budget_of(Effort effort) {
  switch (effort) {
    case Effort::fast: return {2, 0.3, 0.15, 1, 1, 0, 4, 6};
    case Effort::normal: return {12, 0.4, 0.1, 2, 6, 2, 20, 40};
    case Effort::best: break;
  }
  return {100, 0.6, 0.1, 5, 20, 6, 40, 150};
}

/// Weight of alignment in the energy when the option asks for all of it.
constexpr double kAlignment = 0.5;

Background background_of(const Mesh<2>& mesh, const MetricField<2>& field) {
  Point<2> low = mesh.points[0], high = low;
  for (const Point<2>& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {field, low, high};
}

}  // namespace

Schedule::Schedule(Mesh<2>& mesh, const MetricField<2>& field, const AdaptOptions& options, Recorder<2>& recorder,
                   std::map<std::string, std::int64_t>& operations, int iteration)
    : mesh_(mesh),
      options_(options),
      recorder_(recorder),
      operations_(operations),
      iteration_(iteration),
      background_(background_of(mesh, field)),
      trial_(mesh, background_, {.alignment = kAlignment * options.align}),
      search_(mesh, trial_, options.seed),
      descent_(mesh, trial_.relocator) {
  if (options.record)
    trial_.kept = [this](Operator op, const Journal& journal) { recorder_.change(op, mesh_, journal, trial_.cavity, iteration_); };
  hot_passes_ = budget_of(options.effort).hot_passes;
  cold_passes_ = budget_of(options.effort).cold_passes;
}

double Schedule::temperature(int pass) const {
  const Budget e = budget_of(options_.effort);
  if (pass >= hot_passes_) return 0.0;
  if (hot_passes_ == 1) return e.hot;
  return e.hot * portable::pow(e.cool / e.hot, static_cast<double>(pass) / (hot_passes_ - 1));
}

void Schedule::begin_sweep() {
  recorder_.before_relocation(mesh_);
  sweeping_ = true;
  next_vertex_ = 0;
  gain_ = 0.0;
}

/// \return false when the sweep is over.
bool Schedule::continue_sweep() {
  const VertexId stop = std::min<VertexId>(mesh_.vertex_count(), next_vertex_ + kMovesPerStep);
  gain_ += trial_.sweep(next_vertex_, stop);
  next_vertex_ = stop;
  if (stop < mesh_.vertex_count()) return true;
  end_sweep();
  return false;
}

void Schedule::end_sweep() {
  sweeping_ = false;
  ++sweeps_;
  ++operations_["sweeps"];
  if (options_.record) recorder_.relocation(mesh_, iteration_, trial_.relocator.total_energy());
}

/// One iteration over all vertices at once. \return false when there is nothing left to gain.
bool Schedule::descend(int most) {
  recorder_.before_relocation(mesh_);
  gain_ = descent_.iterate();
  end_sweep();
  return sweeps_ < most && gain_ > 1e-5 * trial_.relocator.total_energy();
}

void Schedule::next_pass() {
  if (pass_ == hot_passes_ + cold_passes_) {
    stage_ = Stage::polish;
    end_polish_round();
    return;
  }
  if (pass_ == hot_passes_) trial_.touch_all();
  search_.begin_pass(temperature(pass_));
  stage_ = Stage::pass;
}

void Schedule::end_pass() {
  const bool cold = pass_ >= hot_passes_;
  const bool rows = cold || pass_ % budget_of(options_.effort).rows_every == 0;
  const std::int64_t chords = rows ? search_.chord_pass() : 0;
  ++pass_;
  if (cold && search_.kept() + chords == 0) pass_ = hot_passes_ + cold_passes_;
  stage_ = Stage::after_pass;
  begin_sweep();
}

void Schedule::end_polish_round() {
  if (polish_ == budget_of(options_.effort).polish_rounds || (polish_ > 0 && search_.kept() == 0)) {
    stage_ = Stage::settle;
    sweeps_ = 0;
    return;
  }
  if (polish_++ == 0) {
    trial_.relocator.measure_all({.alignment = kAlignment * options_.align, .shape = 10.0, .shape_floor = 0.65});
    trial_.touch_all();
  }
  search_.begin_pass(0.0);
}

bool Schedule::step() {
  const Budget budget = budget_of(options_.effort);
  switch (stage_) {
    case Stage::relax:
      // Sweeps take out what is crumpled, descent then moves whole rows.
      if (sweeps_ < kRelaxSweeps) {
        if (!sweeping_) begin_sweep();
        continue_sweep();
      } else if (!descend(kRelaxSweeps + budget.relax_sweeps)) {
        next_pass();
      }
      break;
    case Stage::pass:
      if (!search_.continue_pass(kMovesPerStep)) end_pass();
      break;
    case Stage::after_pass:
      if (!continue_sweep()) next_pass();
      break;
    case Stage::polish:
      if (sweeping_) {
        if (!continue_sweep()) end_polish_round();
      } else if (!search_.continue_pass(kMovesPerStep)) {
        begin_sweep();
      }
      break;
    case Stage::settle:
      if (!descend(budget.settle_sweeps)) stage_ = Stage::done;
      break;
    case Stage::done: break;
  }
  count();
  return stage_ != Stage::done;
}

void Schedule::count() {
  constexpr const char* names[kOperators] = {"rotations",    "collapses",          "openings",         "chord_collapses",
                                               "chord_splits", "boundary_collapses", "boundary_openings"};
  std::int64_t tried = 0;
  for (int i = 0; i < kOperators; ++i) {
    operations_[names[i]] = trial_.counts[i].kept;
    tried += trial_.counts[i].tried;
  }
  operations_["trials"] = tried;
  operations_["relocations"] = trial_.moves;
}

double Schedule::share() const {
  switch (stage_) {
    case Stage::relax: return 0.0;
    case Stage::pass:
    case Stage::after_pass: return 0.05 + 0.85 * pass_ / (hot_passes_ + cold_passes_);
    case Stage::polish: return 0.9;
    case Stage::settle: return 0.95;
    case Stage::done: break;
  }
  return 1.0;
}

std::string_view Schedule::activity() const {
  switch (stage_) {
    case Stage::relax:
    case Stage::settle: return "smoothing";
    case Stage::polish: return "polishing shapes";
    default: return "reconnecting";
  }
}

}  // namespace pillowmesh
