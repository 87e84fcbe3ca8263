// This work is based on: "Conformal Refinement of All-Quadrilateral and All-Hexahedral Meshes According to an
// Anisotropic Metric" ([Paper]); `step` below is the loop of its section 4.
#include "pillowmesh/adapt/adapter.h"

#include <algorithm>
#include <optional>

#include "pillowmesh/adapt/continuation.h"
#include "pillowmesh/adapt/full_adaptation.h"
#include "pillowmesh/adapt/longest_edge.h"
#include "pillowmesh/adapt/recorder.h"
#include "pillowmesh/adapt/stopwatch.h"
#include "pillowmesh/adapt/tagging.h"
#include "pillowmesh/mesh/frozen.h"
#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/smooth_geometry.h"
#include "pillowmesh/refine/balance.h"
#include "pillowmesh/refine/dice.h"
#include "pillowmesh/refine/layer.h"
#include "pillowmesh/refine/tag_inheritance.h"
#include "pillowmesh/smooth/polish.h"
#include "pillowmesh/smooth/relocate.h"

namespace pillowmesh {
namespace {

constexpr std::int64_t kMostUntangling = 300'000;  ///< for a layer, in evaluations of the energy of a cell

enum class Stage { tag, layers, smooth_between, dice, smooth_end, polish, improve, done };

}  // namespace

template <int Dim>
struct Adapter<Dim>::State {
  Mesh<Dim> mesh;
  MetricField<Dim> field;
  MetricField<Dim> target;  ///< the metric that refinement aims at: coarser than `field` before dicing and continuation
  AdaptOptions options;
  Context context;

  Stage stage = Stage::tag;
  Status outcome;
  int iteration = 0;
  Continuation<Dim> continuation;
  int first_iteration = 0;  ///< of this step of continuation
  int augment = 0;
  CellId first_new = 0;  ///< cells from here on were made in this iteration
  Tagging<Dim> tagging;
  EdgeTags<Dim> tags;
  std::vector<CellId> seeds;  ///< cells that may carry tags, in the order in which layers are sought
  std::size_t next_seed = 0;
  std::int64_t inserted = 0;  ///< layers in this iteration
  std::optional<double> longest;  ///< of the edges, for events: since the last iteration, while nothing has changed
  bool woken = false;         ///< layers that were refused have been tried once more since the last was inserted
  LayerMarks layer_marks;
  Layer layer;
  PillowWorkspace<Dim> pillow;
  BufferLayer<Dim> buffer_layer;
  std::optional<Relocator<Dim>> relocator;
  std::unique_ptr<FullAdaptation> improvement;  ///< full adaptation only
  int sweeps = 0;
  double energy = 0.0;  ///< after the last of them
  bool smoothed = false;  ///< the last smoothing is done; only a look at the lengths is left
  int rounds = 0;         ///< of refinement and last smoothing
  double requested;       ///< threshold; that in the options may be lower
  double share = 0.0;     ///< of the work, as last reported

  Recorder<Dim> recorder;
  std::map<std::string, double> seconds;
  std::map<std::string, std::int64_t> operations;
  double &refine_seconds = seconds["refine"], &smooth_seconds = seconds["smooth"], &improve_seconds = seconds["improve"];
  std::int64_t &layers = operations["layers"], &iterations = operations["iterations"],
               &relocations = operations["relocations"], &refusals = operations["refused_layers"],
               &sweep_count = operations["sweeps"];

  State(Mesh<Dim> m, MetricField<Dim> f, AdaptOptions o, Context c)
      : mesh(std::move(m)),
        field(std::move(f)),
        target(field),
        options(o),
        context(std::move(c)),
        continuation(mesh, field, full() ? 0 : options.continuation),
        augment(options.augment >= 0 ? options.augment : (Dim == 2 ? 1 : 0)),
        tagging(mesh, options.threshold),
        requested(options.threshold),
        recorder(options.record) {
    if (options.geometry == BoundaryShape::smooth) mesh.geometry = smooth_geometry(std::move(mesh.geometry));
    outcome = field.check(mesh.points);
    if constexpr (Dim == 2 && kHasFullAdaptation)
      if (outcome.ok() && full_adaptation(options))
        improvement = std::make_unique<FullAdaptation>(mesh, field, options, recorder, operations);
    target = aim();
    if constexpr (Dim == 3)
      if (outcome.ok() && continuation.steep() && options.continuation < 0 && options.smoothing != Smoothing::none) {
        options.threshold = threshold_for(mesh, field, requested);
        tagging = Tagging<Dim>(mesh, options.threshold);
      }
    if (outcome.ok() && mesh.frozen && options.dice > 1)
      outcome = Status::usage("dicing would split what is frozen; leave out one of them");
    if (!outcome.ok()) stage = Stage::done;
    pillow.most_untangling = kMostUntangling;
    if constexpr (Dim == 3) {  // no layer may leave a worse cell than the input has, nor a bad one
      pillow.quality_floor = 0.02;
      for (CellId c = 0; c < mesh.cell_count(); ++c)
        pillow.quality_floor = std::min(pillow.quality_floor, min_scaled_jacobian(mesh, c));
    }
  }

  bool step() {
    if (stage == Stage::done) return false;
    if (context.cancelled && context.cancelled()) {
      outcome = Status::cancelled("cancelled: the mesh is valid as it is, but not adapted to the end");
      stage = Stage::done;
      return false;
    }
    switch (stage) {
      case Stage::tag: find_tags(); break;
      case Stage::layers: insert_next_layer(); break;
      case Stage::smooth_between: smooth(Stage::tag); break;
      case Stage::dice: dice_all(); break;
      case Stage::smooth_end: smooth(Stage::done); break;
      case Stage::polish: polish(); break;
      case Stage::improve: improve(); break;
      case Stage::done: break;
    }
    if (stage == Stage::done && outcome.ok()) outcome = check_frozen_edges(mesh, target, requested);
    return stage != Stage::done;
  }

  [[nodiscard]] MetricField<Dim> aim() const {
    const int coarser = improvement ? improvement->coarser() : options.dice;
    return continuation.approach(coarser > 1 ? field.scaled(coarser) : field);
  }

  /// The next step of continuation: smaller sizes, all edges to be looked at again, after smoothing for them.
  void lower_floor() {
    continuation.next();
    target = aim();
    tagging.look_at_all(mesh);
    first_iteration = iteration;
    stage = options.smoothing == Smoothing::none ? Stage::tag : Stage::smooth_between;
    begin_smoothing();
  }

  /// Step 1: tag the edges that are too long; balance.
  void find_tags() {
    const Stopwatch watch(refine_seconds);
    report_progress("finding long edges");
    seeds = tagging.tag_long_edges(mesh, target, tags);
    drop_frozen_tags(mesh, tags, seeds);
    if (smoothed && seeds.empty()) {
      stage = Stage::done;
      report_progress("done");
      return;
    }
    bool again = iteration == first_iteration || inserted > 0;
    if (inserted > 0) woken = false;
    if ((seeds.empty() || !again) && !woken && tagging.wake()) {  // before it is over
      woken = again = true;
      const std::vector<CellId> more = tagging.tag_long_edges(mesh, target, tags);
      seeds.insert(seeds.end(), more.begin(), more.end());
      drop_frozen_tags(mesh, tags, seeds);
    }
    const bool over = seeds.empty() || !again || iteration - first_iteration == options.max_iterations;
    if (over && !continuation.done()) return lower_floor();
    if (over || (iteration > first_iteration && has_enough())) {
      if ((!seeds.empty() || tagging.waiting()) && !meets_request())
        outcome = Status::limit_not_met(
            again ? "edges longer than the threshold remain after " + std::to_string(iteration) + " iterations"
                  : "edges longer than the threshold remain where no layer can be inserted");
      if (smoothed) {
        stage = Stage::done;
        return;
      }
      if constexpr (Dim == 2 && kHasFullAdaptation)
        if (improvement) {
          improvement->begin(mesh);
          stage = Stage::improve;
          return;
        }
      stage = options.dice > 1 ? Stage::dice : Stage::smooth_end;
      begin_smoothing();
      return;
    }
    smoothed = false;
    balance_tags<Dim>(mesh, tags, seeds);
    tagging.collect_tagged_cells(mesh, tags, seeds);
    drop_frozen_tags(mesh, tags, seeds);
    if (options.record && !longest) longest = longest_edge(mesh, target);
    recorder.tags(mesh, tags, iteration, longest.value_or(0.0));
    longest.reset();
    next_seed = 0;
    first_new = mesh.cell_count();
    inserted = 0;
    layer_marks.refined.clear();
    stage = Stage::layers;
  }

  [[nodiscard]] bool has_enough() const {
    if constexpr (Dim == 2 && kHasFullAdaptation) return improvement && improvement->has_enough(mesh);
    return false;
  }

  /// Where the threshold is lower than asked for, edges above it are no failure.
  [[nodiscard]] bool meets_request() const {
    return options.threshold < requested && short_enough();
  }
  [[nodiscard]] bool short_enough() const {
    return longest_edge(mesh, target) <= requested * (1.0 + kLongestEdgeTolerance);
  }

  /// Steps 2 and 3: form a layer, shrink it, connect it. Step 4 is the repetition until no tag is left.
  void insert_next_layer() {
    const Stopwatch watch(refine_seconds);
    while (next_seed < seeds.size() && tags.mask[seeds[next_seed]] == 0) ++next_seed;
    if (next_seed == seeds.size()) return end_iteration();
    const CellId c = seeds[next_seed];
    int e = 0;
    while (!tags.has(c, e)) ++e;
    find_layer(mesh, tags, {c, e}, {augment, options.thickness, first_new}, layer_marks, layer);
    if (mesh.cell_count() + static_cast<std::int64_t>(Cell<Dim>::facets * layer.cells.size()) > options.max_cells) {
      outcome = Status::limit_not_met("stopped before the mesh would have had more than " +
                                      std::to_string(options.max_cells) + " cells");
      stage = Stage::done;
      return;
    }
    recorder.layer(mesh, layer, pillow.hull, iteration);
    Status s = insert_buffer_layer<Dim>(mesh, layer.cells, {}, pillow, buffer_layer);
    if (!s.ok() && pillow.hull.facets.empty()) {
      // The layer is the whole mesh: split it off the boundary that it lies on.
      s = insert_buffer_layer<Dim>(mesh, layer.cells, boundary_below(), pillow, buffer_layer);
    }
    if (!s.ok()) {  // its edges are looked at again in a later iteration, when the mesh around has changed
      ++refusals;
      for (const LayerCell& visit : layer.visits) tagging.look_again_later(visit.cell);
      recorder.drop_last();
      return;
    }
    inherit_tags<Dim>(mesh, buffer_layer, pillow.hull.facets, tags);
    if (options.thickness > 1) mark_refined<Dim>(mesh, layer, buffer_layer, pillow.hull.facets, layer_marks);
    for (Index i = 0; i < buffer_layer.cell_count; ++i) {
      tagging.look_again(buffer_layer.first_cell + i);
      seeds.push_back(buffer_layer.first_cell + i);
    }
    // The cells of the layer too: one that is inside a thick or winding layer lost its tags without being refined.
    for (const CellId c : layer.cells) tagging.look_again(c);
    for (std::size_t i = 0; i < buffer_layer.changed.size(); ++i) {  // those outside have new neighbours, but the same edges
      const CellId changed = buffer_layer.changed[i];
      if (mesh.cells[changed] != buffer_layer.old_corners[i]) tagging.look_again(changed);
    }
    for (const VertexId v : buffer_layer.moved) {  // made room: all edges there have changed
      vertex_star(mesh, v, pillow.plan.star);
      for (const CellCorner& at : pillow.plan.star) tagging.look_again(at.cell);
    }
    recorder.buffer_layer(mesh, buffer_layer, iteration);
    ++inserted;
    if (++layers % 64 == 0) report_progress("inserting layers");
  }

  std::vector<HalfFacetId> boundary_below() const {
    std::vector<HalfFacetId> facets;
    for (const LayerCell& v : layer.visits) {
      const int f = Cell<Dim>::facet(v.axis, 1 - v.up);
      if (mesh.on_boundary(v.cell, f)) facets.push_back(mesh.half_facet(v.cell, f));
    }
    return facets;
  }

  /// Step 5: again from step 1, after smoothing if asked for.
  void end_iteration() {
    ++iteration;
    ++iterations;
    if (options.record) longest = longest_edge(mesh, target);
    recorder.iteration(mesh, iteration, longest.value_or(0.0));
    if (smooths_between() && inserted > 0) {
      stage = Stage::smooth_between;
      begin_smoothing();
    } else {
      stage = Stage::tag;
    }
  }

  /// Hexahedra that approach their metric in steps are smoothed for each of them, in each iteration.
  [[nodiscard]] bool smooths_between() const {
    return options.smoothing == Smoothing::between ||
           (Dim == 3 && options.smoothing == Smoothing::end && continuation.steep());
  }

  void begin_smoothing() {
    longest.reset();
    relocator.reset();
    sweeps = 0;
  }

  void smooth(Stage next) {
    const Stopwatch watch(smooth_seconds);
    if (options.smoothing == Smoothing::none || sweeps == options.max_sweeps) return end_smoothing(next);
    report_progress("smoothing");
    if (!relocator) relocator.emplace(mesh, next == Stage::done ? field : target);
    recorder.before_relocation(mesh);
    const SweepResult result = relocator->sweep();
    energy = result.energy - result.decrease;
    recorder.relocation(mesh, iteration, energy);
    relocations += result.moved;
    ++sweeps;
    ++sweep_count;
    if (result.converged) end_smoothing(next);
  }

  void end_smoothing(Stage next) {
    const bool moved = sweeps > 0;
    if (moved) tagging.look_at_all(mesh);
    relocator.reset();
    stage = next;
    if (next != Stage::done) return;
    // The last smoothing may have made edges too long again: then once more from step 1, a few times at the most. Or it has
    // made room for layers that were refused, or what they were for shorter.
    if (moved && rounds++ < (outcome.ok() ? 3 : 1)) {
      outcome = {};
      smoothed = true;
      inserted = 1;
      stage = Stage::tag;
    } else if (moved && !outcome.ok() && short_enough()) {
      outcome = {};
    }
    if (Dim == 3 && moved && continuation.steep()) stage = Stage::polish;
    if (stage == Stage::done) report_progress("done");
  }

  /// Where sizes change fast, the few cells that the smoother leaves poor.
  void polish() {
    stage = smoothed ? Stage::tag : Stage::done;
    if constexpr (Dim == 3) {
      const Stopwatch watch(seconds["polish"]);
      recorder.before_relocation(mesh);
      if (polish_shapes(mesh, field, {.threshold = options.threshold}).moved > 0)
        recorder.relocation(mesh, iteration, energy);
    }
    if (stage == Stage::done) report_progress("done");
  }

  [[nodiscard]] bool full() const { return Dim == 2 && kHasFullAdaptation && full_adaptation(options); }

  /// Full adaptation, after the layers: coarsen, reconnect, relocate.
  void improve() {
    if constexpr (Dim == 2 && kHasFullAdaptation) {
      const Stopwatch watch(improve_seconds);
      using Next = FullAdaptation::Next;
      const Next next = improvement->step(mesh, field, target, iteration);
      if (next == Next::finer || next == Next::layers) {
        target = aim();
        longest.reset();
      }
      if (next == Next::layers) insert_layers();
      if (next == Next::done) {
        outcome = improvement->outcome();
        stage = Stage::done;
      }
      report_progress(stage == Stage::done ? "done" : improvement->activity());
    }
  }

  /// Again from step 1, on a mesh that operators have changed.
  void insert_layers() {
    tags.mask.assign(mesh.cells.size(), 0);
    tagging = Tagging<Dim>(mesh, options.threshold);
    if constexpr (Dim == 2)
      if (!improvement->too_long().empty()) tagging.look_at(mesh, improvement->too_long());
    first_iteration = iteration;
    stage = Stage::tag;
  }

  void dice_all() {
    const Stopwatch watch(refine_seconds);
    report_progress("dicing");
    std::int64_t pieces = 1;
    for (int d = 0; d < Dim; ++d) pieces *= options.dice;
    if (mesh.cell_count() * pieces > options.max_cells) {
      outcome = Status::limit_not_met("not diced: the mesh would have more than " + std::to_string(options.max_cells) +
                                      " cells");
    } else {
      recorder.before_dice(mesh);
      const Status s = dice(mesh, options.dice);
      if (s.ok())
        recorder.dice(mesh, iteration);
      else
        outcome = Status::limit_not_met("not diced: " + s.message);
      tags.mask.assign(mesh.cells.size(), 0);
    }
    options.dice = 1;
    target = aim();
    stage = Stage::smooth_end;
    begin_smoothing();
  }

  void report_progress(std::string_view activity) {
    if (!context.progress) return;
    double improved = 0.0;
    if constexpr (Dim == 2 && kHasFullAdaptation)
      if (improvement) improved = improvement->share();
    const double estimate = stage == Stage::done         ? 1.0
                         : stage == Stage::improve    ? 0.1 + 0.9 * improved
                         : full()                     ? 0.1 * (1.0 - 1.0 / (1.0 + 0.5 * iteration))
                         : stage == Stage::smooth_end ? 0.7 + 0.3 * sweeps / std::max(1, options.max_sweeps)
                                                      : 0.7 * (1.0 - 1.0 / (1.0 + 0.5 * iteration));
    share = std::max(share, estimate);  // work that turns out to be left must not turn it back
    context.progress(share, activity);
  }
};

template <int Dim>
Adapter<Dim>::Adapter(Mesh<Dim> mesh, MetricField<Dim> field, AdaptOptions options, Context context)
    : state_(std::make_unique<State>(std::move(mesh), std::move(field), options, std::move(context))) {}
template <int Dim>
Adapter<Dim>::~Adapter() = default;
template <int Dim>
Adapter<Dim>::Adapter(Adapter&&) noexcept = default;
template <int Dim>
Adapter<Dim>& Adapter<Dim>::operator=(Adapter&&) noexcept = default;

template <int Dim>
bool Adapter<Dim>::step() {
  return state_->step();
}
template <int Dim>
Status Adapter<Dim>::run() {
  while (step()) {
  }
  return outcome();
}
template <int Dim>
const Status& Adapter<Dim>::outcome() const {
  return state_->outcome;
}
template <int Dim>
const Mesh<Dim>& Adapter<Dim>::mesh() const {
  return state_->mesh;
}
template <int Dim>
const MetricField<Dim>& Adapter<Dim>::field() const {
  return state_->field;
}
template <int Dim>
std::vector<Event<Dim>> Adapter<Dim>::take_events() {
  return state_->recorder.take();
}
template <int Dim>
const std::map<std::string, double>& Adapter<Dim>::seconds() const {
  return state_->seconds;
}
template <int Dim>
const std::map<std::string, std::int64_t>& Adapter<Dim>::operations() const {
  return state_->operations;
}

template class Adapter<2>;
template class Adapter<3>;

}  // namespace pillowmesh
