#include "pillowmesh/adapt/schedule.h"

#include <algorithm>

#include "pillowmesh/mesh/portable_math.h"

namespace pillowmesh {
namespace {

constexpr std::int64_t kMovesPerStep = 4000;

/// For rows_every: rows come and go in cold passes only. Those that end on the boundary can be joined there at any time.
constexpr int kNoRows = 1 << 20;

/// Up to so many cells rows are cheap: the whole mesh is relocated for some. Meshes with more are diced, and their coarse meshes
/// had theirs.
constexpr CellId kFewCells = 2000, kSomeCells = 10'000;

/// Effort fast, coarse meshes: rows that gain less are a tenth of the time, for fewer cells than there should be (circle2d .96
/// of them and .97 without, iso2d .98 and .99). Without any row aniso2d has 1.5 times its cells.
constexpr double kMuchGain = 0.2;

/// Effort fast, the finest mesh: where changes of topology are tried, and what shapes are mended. A fifteenth of the time;
/// circle2d, cv .161 to .149, iso2d .142 to .134, its least eta .1 to .5.
constexpr double kMuchEnergy = 0.4, kPoorShape = 0.5;

/// Effort fast: below this metric area cells are only collapsed in hot passes. A tenth of the moves; with .6 and .8 circle2d
/// has .93 and .90 of its cells, with this .95.
constexpr double kCrowdedArea = 0.4;

/// Effort fast, which judges changes after one sweep: circle2d has .96 of its cells, with what others have .92.
constexpr double kCellBonus = 0.2;

/// Of a mesh that is only mended where layers were, of a coarse mesh that will be diced, of one that was diced, and of one that
/// layers have made, or that was given. Coarse meshes are not polished: the finer ones change shapes anyway.
Budget budget_of(Effort effort, bool diced, int halvings, bool mended) {
  const bool coarse = halvings > 0;
  switch (effort) {
    case Effort::fast:
      if (mended) return {.sweeps = 1, .cold_passes = 1, .rows_up_to = 0, .least_shape = coarse ? 0.0 : kPoorShape};
      if (coarse)
        return {.sweeps = diced ? 1 : 2, .hot_passes = 3, .hot = diced ? 0.25 : 0.15, .cool = 0.1, .cold_passes = diced ? 0 : 1,
                .rows_every = kNoRows, .row_gain = kMuchGain, .rows_up_to = kFewCells};
      if (diced)
        return {.sweeps = 1, .cold_passes = 1, .cold_above = kMuchEnergy, .rows_up_to = 0, .least_shape = kPoorShape};
      return {.sweeps = 5, .relax_sweeps = 4, .hot_passes = 6, .hot = 0.3, .cool = 0.1, .cold_passes = 2, .rows_every = 3,
              .rows_up_to = kFewCells, .settle_sweeps = 2, .least_shape = kPoorShape};
    case Effort::normal:
      if (coarse)
        return {.sweeps = 5, .relax_sweeps = 10, .hot_passes = 4, .hot = 0.4, .cool = 0.1, .cold_passes = 4,
                .rows_every = kNoRows, .settle_sweeps = 20};
      if (diced)
        return {.sweeps = 5, .hot_passes = 34, .hot = 0.31, .cool = 0.13, .rows_every = kNoRows, .polish_rounds = 1,
                .settle_sweeps = 4};
      return {.sweeps = 5, .relax_sweeps = 20, .hot_passes = 30, .hot = 0.5, .cool = 0.06, .cold_passes = 4, .rows_every = 8,
              .polish_rounds = 2, .settle_sweeps = 20};
    case Effort::best: break;
  }
  if (coarse)
    return {.sweeps = 5, .relax_sweeps = 40, .hot_passes = 15, .hot = 0.6, .cool = 0.05, .cold_passes = 20,
            .rows_every = kNoRows, .settle_sweeps = 100};
  if (diced)
    return {.sweeps = 5, .relax_sweeps = 20, .hot_passes = 500, .hot = 0.4, .cool = 0.15, .hot_moves = 700.0,
            .cold_passes = 2, .rows_every = kNoRows, .rows_up_to = kSomeCells, .polish_rounds = 26, .warm_rounds = 20,
            .settle_sweeps = 48};
  return {.sweeps = 5, .relax_sweeps = 40, .hot_passes = 60, .hot = 0.6, .cool = 0.05, .cold_passes = 20,
          .rows_every = kNoRows, .polish_rounds = 6, .settle_sweeps = 100};
}

constexpr int kPassesToBalance = 5, kIterationsToBalance = 12;

}  // namespace

Schedule::Schedule(Mesh<2>& mesh, Background& background, const AdaptOptions& options, bool diced, int halvings,
                   std::span<const VertexId> mended, Recorder<2>& recorder, std::map<std::string, std::int64_t>& operations,
                   int iteration)
    : mesh_(mesh),
      options_(options),
      recorder_(recorder),
      operations_(operations),
      iteration_(iteration),
      partial_(!mended.empty() && options.effort == Effort::fast),
      budget_(budget_of(options.effort, diced, halvings, partial_)),
      balance_(options, halvings > 0),
      trial_(mesh, background, balance_.first()),
      search_(mesh, trial_, options.seed),
      descent_(mesh, trial_.relocator) {
  if (options.effort == Effort::fast) {
    trial_.least_sweeps = 1;
    search_.cell_bonus = kCellBonus;
    search_.crowded_area = kCrowdedArea;
  }
  if (partial_) trial_.touch_only(mended);
  if (options.record)
    trial_.kept = [this](Operator op, const Journal& journal) { recorder_.change(op, mesh_, journal, trial_.cavity, iteration_); };
}

double Schedule::live_cells() const {
  std::int64_t cells = 0;
  for (CellId c = 0; c < mesh_.cell_count(); ++c) cells += mesh_.alive(c) ? 1 : 0;
  return static_cast<double>(cells);
}

std::vector<unsigned char> Schedule::touched() const {
  std::vector<unsigned char> touched(partial_ ? mesh_.points.size() : 0);
  for (std::size_t v = 0; v < touched.size(); ++v) touched[v] = trial_.touched(static_cast<VertexId>(v)) ? 1 : 0;
  return touched;
}

/// How much of the time for hot passes is over.
double Schedule::cooled() const {
  const double moves = static_cast<double>(trial_.moves - moves_before_) / hot_moves_;
  return std::max(moves, static_cast<double>(pass_) / std::max(1, budget_.hot_passes - 1));
}

double Schedule::temperature() const {
  if (pass_ >= budget_.hot_passes) return 0.0;
  return budget_.hot * portable::pow(budget_.cool / budget_.hot, std::min(1.0, cooled()));
}

/// Energies of the end are about twice those before, and poor shapes cost much: only one to ten changes a round pass at this
/// temperature. circle2d with sizes halved, cv + (1 - eta) / 1.5: .1319 to .1327 with them, .1327 without; the scatter is .0006.
double Schedule::polish_temperature(int round) const {
  if (round >= budget_.warm_rounds) return 0.0;
  return 2.0 * budget_.cool * portable::pow(1.0 / 3.0, static_cast<double>(round) / std::max(1, budget_.warm_rounds - 1));
}

void Schedule::begin_sweep() {
  recorder_.before_relocation(mesh_);
  sweeping_ = true;
  next_cell_ = 0;
  trial_.begin_sweep();
  gain_ = 0.0;
}

/// \return false when the sweep is over.
bool Schedule::continue_sweep() {
  const CellId stop = std::min<CellId>(mesh_.cell_count(), next_cell_ + kMovesPerStep);
  gain_ += trial_.sweep(next_cell_, stop);
  next_cell_ = stop;
  if (stop < mesh_.cell_count()) return true;
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
  if (pass_ == 0) {
    moves_before_ = trial_.moves;
    hot_moves_ = budget_.hot_moves * live_cells();
    descent_.restart();  // passes need the memory
  }
  if (pass_ < budget_.hot_passes && cooled() > 1.0) pass_ = budget_.hot_passes;
  if (pass_ == budget_.hot_passes + budget_.cold_passes) {
    stage_ = Stage::polish;
    end_polish_round();
    return;
  }
  if (pass_ <= budget_.hot_passes && pass_ % kPassesToBalance == 0) balance_alignment();
  if (pass_ == budget_.hot_passes) {
    if (budget_.hot_passes > 0) trial_.touch_all();
    // Nothing comes after them that would shorten an edge.
    if (budget_.hot_passes == 0 && budget_.least_shape > 0.0) trial_.longest_allowed = options_.threshold;
  }
  search_.begin_pass(temperature(), pass_ < budget_.hot_passes ? 0.0 : budget_.cold_above);
  stage_ = Stage::pass;
}

void Schedule::balance_alignment() {
  const double left = pass_ > 0 ? trial_.relocator.misalignment() : 0.0;
  const double weight = balance_.alignment_for(left);
  if (weight > 0.0) trial_.relocator.set_alignment(weight);
}

void Schedule::end_pass() {
  const bool cold = pass_ >= budget_.hot_passes;
  const bool rows = (cold || (pass_ + 1) % budget_.rows_every == 0) && mesh_.cell_count() <= budget_.rows_up_to;
  const std::int64_t chords = rows ? search_.chord_pass(budget_.row_gain) : 0;
  ++pass_;
  if (cold && search_.kept() + chords == 0) pass_ = budget_.hot_passes + budget_.cold_passes;
  stage_ = Stage::after_pass;
  begin_sweep();
}

void Schedule::end_polish_round() {
  if (polish_ == budget_.polish_rounds || (polish_ > 0 && search_.kept() == 0)) {
    if (budget_.settle_sweeps == 0) return finish();
    stage_ = Stage::settle;
    sweeps_ = 0;
    search_.release();
    trial_.release();
    trial_.relocator.measure_all(balance_.settled(trial_.relocator.weights()));
    descent_.restart();
    // Single vertices first: a few that are pushed hard would hold up all.
    if (polish_ > 0) begin_sweep();
    return;
  }
  if (polish_++ == 0) {
    trial_.relocator.measure_all(balance_.last(trial_.relocator.total_energy() / live_cells()));
    trial_.touch_all();
  } else {
    adjust_balance();
  }
  search_.begin_pass(polish_temperature(polish_ - 1));
}

void Schedule::adjust_balance() {
  EnergyWeights weights = trial_.relocator.weights();
  balance_.adjust(weights, trial_.relocator.indicators());
  trial_.relocator.measure_all(weights);
}

/// Done, but for shapes.
void Schedule::finish() {
  stage_ = Stage::done;
  if (budget_.least_shape == 0.0) return;
  recorder_.before_relocation(mesh_);
  trial_.longest_allowed = options_.threshold;
  trial_.mend_shapes(budget_.least_shape);
  if (options_.record) recorder_.relocation(mesh_, iteration_, trial_.relocator.total_energy());
}

/// An iteration of the end. \return false when there is nothing left to gain.
bool Schedule::settle() {
  const bool more = descend(budget_.settle_sweeps);
  // Weights change while there is time to follow them.
  if (budget_.polish_rounds == 0 || sweeps_ > budget_.settle_sweeps / 2 || (more && sweeps_ % kIterationsToBalance != 0))
    return more;
  sweeps_ += kIterationsToBalance - 1 - (sweeps_ - 1) % kIterationsToBalance;
  adjust_balance();
  descent_.restart();
  return true;
}

bool Schedule::step() {
  switch (stage_) {
    case Stage::relax:
      // Sweeps take out what is crumpled, descent then moves whole rows.
      if (sweeps_ < budget_.sweeps) {
        if (!sweeping_) begin_sweep();
        continue_sweep();
      } else if (budget_.relax_sweeps == 0 || !descend(budget_.sweeps + budget_.relax_sweeps)) {
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
      if (sweeping_)
        continue_sweep();
      else if (!settle())
        finish();
      break;
    case Stage::done: break;
  }
  count();
  return stage_ != Stage::done;
}

void Schedule::count() {
  constexpr const char* names[kOperators] = {"rotations",    "collapses",          "openings",         "chord_collapses",
                                               "chord_splits", "boundary_collapses", "boundary_openings", "partial_chord_collapses",
                                               "partial_chord_splits"};
  std::int64_t tried = 0;
  for (int i = 0; i < kOperators; ++i) {
    count(names[i], trial_.counts[i].kept);
    tried += trial_.counts[i].tried;
  }
  count("trials", tried);
  count("relocations", trial_.moves);
}

/// Coarser meshes have been counted before.
void Schedule::count(const std::string& name, std::int64_t total) {
  operations_[name] += total - counted_[name];
  counted_[name] = total;
}

double Schedule::share() const {
  switch (stage_) {
    case Stage::relax: return 0.0;
    case Stage::pass:
    case Stage::after_pass: return pass_ < budget_.hot_passes ? 0.05 + 0.8 * std::min(1.0, cooled()) : 0.85;
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
