#include "pillowmesh/adapt/full_adaptation.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "pillowmesh/adapt/halving.h"
#include "pillowmesh/adapt/longest_edge.h"
#include "pillowmesh/mesh/compact.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/volume.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace pillowmesh {
namespace {

/// Rounds of layers for edges that have become too long. Four meet a fifth of the runs that two do not (coarse rings with
/// steep sizes); with effort best a round takes too long for that.
int most_mended(Effort effort) { return effort == Effort::best ? 2 : 4; }

/// Times the threshold: a coarse mesh with a longer edge than that has lost cells that finer ones would not find again.
constexpr double kMuchTooLong = 1.4;

/// Effort fast: the coarsest mesh is to have less than so many times the cells that are given. Layers start one that is to have
/// more well, with rows that follow the metric, but make several times those cells, and to take them out takes time: circle2d, 13
/// moves a cell from about as many cells as were given, cv .16; 22 from four times as many, cv .14.
constexpr double kFewTimes = 2.0;

/// A coarse mesh with so many of the cells that it is to have needs no more layers. Where these go through the whole mesh
/// for a few long edges, the next would make several times as many cells, and to take them out takes time (shock2d, normal:
/// 120 moves a cell for 150). Best takes the rows that the last layers make.
double enough(Effort effort) {
  if (effort == Effort::fast) return 2.0;
  return effort == Effort::normal ? 0.9 : std::numeric_limits<double>::infinity();
}

/// How often sizes can be doubled until edges are about as long as they are asked to be; fast, until cells are about as many.
int halvings_to_come(const Mesh<2>& mesh, const MetricField<2>& field, double ideal, const AdaptOptions& options) {
  if (mesh.frozen) return 0;
  double l = mean_edge_length(mesh, field);
  const auto most = static_cast<double>(options.max_cells);
  if (!(ideal <= most && l * l * mesh.cell_count() <= most)) return 0;  // layers stop before that many
  const double many = options.effort == Effort::fast ? kFewTimes * mesh.cell_count() : ideal;
  int n = 0;
  for (; l >= 2.0 || ideal > many; l *= 0.5, ideal *= 0.25) ++n;
  return n;
}

/// Where lengths scatter by a tenth, an error of a fiftieth does not show: circle2d and shock2d are no better with a
/// quarter of that error. Best takes a quarter while meshes are small. In large ones kinks would have three leaves for each
/// cell (shock2d, 58 000 cells: 1000 bytes for each, and 610 without; cv .0472 and .0468, eta .961 both times).
constexpr double kManyCells = 20'000;
BackgroundOptions background_options(Effort effort, double cells) {
  if (effort == Effort::best && cells < kManyCells) return {.tolerance = 5e-3, .smallest = 0.5};
  return {.tolerance = 2e-2, .smallest = 1.0};
}

/// Around new cells, around vertices that layers have moved, and around edges that they did not reach.
constexpr int kMendedRings = 2;

/// The vertices there. \param before the points as they were; new cells are those from `first` on
std::vector<VertexId> touched_by_layers(const Mesh<2>& mesh, const std::vector<Point<2>>& before, CellId first,
                                        const std::vector<std::array<VertexId, 2>>& too_long) {
  std::vector<unsigned char> near(mesh.points.size(), 0);
  for (CellId c = first; c < mesh.cell_count(); ++c)
    if (mesh.alive(c))
      for (const VertexId v : mesh.cells[c]) near[v] = 1;
  for (std::size_t v = 0; v < before.size(); ++v)
    if (before[v] != mesh.points[v]) near[v] = 1;
  for (const auto& edge : too_long) near[edge[0]] = near[edge[1]] = 1;
  std::vector<unsigned char> touched = near;
  for (int ring = 0; ring < kMendedRings; ++ring, near = touched)
    for (CellId c = 0; c < mesh.cell_count(); ++c) {
      const Corners<2>& v = mesh.cells[c];
      if (mesh.alive(c) && (near[v[0]] | near[v[1]] | near[v[2]] | near[v[3]]) != 0)
        for (const VertexId w : v) touched[w] = 1;
    }
  std::vector<VertexId> vertices;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (touched[v] != 0) vertices.push_back(v);
  return vertices;
}

/// What coarse meshes leave behind lies between what is in use, where the larger arrays of finer ones do not fit: it would be a
/// sixth of the memory at the peak.
void give_memory_back() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace

FullAdaptation::FullAdaptation(const Mesh<2>& mesh, const MetricField<2>& field, const AdaptOptions& options,
                               Recorder<2>& recorder, std::map<std::string, std::int64_t>& operations)
    : options_(options),
      recorder_(recorder),
      operations_(operations),
      ideal_cells_(mesh.frozen ? 0.0 : complexity(mesh, field, {.tolerance = 1e-2})),
      halvings_(halvings_to_come(mesh, field, ideal_cells_, options)) {}

bool FullAdaptation::has_enough(const Mesh<2>& mesh) const {
  return halvings_ > 0 &&
         static_cast<double>(live_cells(mesh).size()) >= enough(options_.effort) * ideal_cells_ / (coarser() * coarser());
}

void FullAdaptation::begin(const Mesh<2>& mesh) {
  diced_ = 10 * mesh.cell_count() < 11 * cells_before_layers_;  // a few layers more only have to be mended
  const std::vector<Point<2>> before = std::exchange(points_before_layers_, {});
  if (diced_ && options_.effort == Effort::fast)
    mended_vertices_ = touched_by_layers(mesh, before, cells_before_layers_, too_long_);
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
    background_ = std::make_unique<Background>(
        target, low, high, background_options(options_.effort, std::max<double>(ideal_cells_, mesh.cell_count())));
  }
  background_coarser_ = coarser();
  return *background_;
}

FullAdaptation::Next FullAdaptation::step(Mesh<2>& mesh, const MetricField<2>& field, const MetricField<2>& target,
                                          int iteration) {
  if (!schedule_)
    schedule_ = std::make_unique<Schedule>(mesh, look_up(mesh, target), options_, diced_, halvings_,
                                           std::exchange(mended_vertices_, {}), recorder_, operations_, iteration);
  const bool more = schedule_->step();
  activity_ = schedule_->activity();
  if (more) return Next::step;
  const std::vector<unsigned char> touched = schedule_->touched();
  schedule_.reset();
  // What the layers could not shorten the operators may have, and the other way round.
  const double limit = halvings_ > 0 ? kMuchTooLong * options_.threshold : options_.threshold * (1.0 + kLongestEdgeTolerance);
  std::vector<std::array<VertexId, 2>> too_long = longer_edges(mesh, target, limit, touched);
  const bool met = too_long.empty();
  if (!met && mended_++ < most_mended(options_.effort)) return insert_layers(mesh, std::move(too_long));
  if (halvings_ > 0) return halve(mesh, field, iteration);
  outcome_ = met ? Status{} : Status::limit_not_met("edges longer than the threshold remain");
  background_.reset();
  return Next::done;
}

/// Every cell in four, for sizes half as large. What is too long then is relocated first: layers through cells that are out
/// of shape would go everywhere.
FullAdaptation::Next FullAdaptation::halve(Mesh<2>& mesh, const MetricField<2>& field, int iteration) {
  give_memory_back();
  recorder_.before_dice(mesh);
  compact(mesh);
  diced_ = 4 * static_cast<std::int64_t>(mesh.cell_count()) <= options_.max_cells && halve_sizes(mesh, field).ok();
  halvings_ = diced_ ? halvings_ - 1 : 0;
  mended_ = 0;
  recorder_.dice(mesh, iteration);
  return diced_ ? Next::finer : insert_layers(mesh, {});
}

FullAdaptation::Next FullAdaptation::insert_layers(const Mesh<2>& mesh, std::vector<std::array<VertexId, 2>> too_long) {
  too_long_ = std::move(too_long);
  cells_before_layers_ = diced_ ? mesh.cell_count() : 0;
  if (options_.effort == Effort::fast) points_before_layers_ = mesh.points;
  return Next::layers;
}

/// Each mesh takes four times as long as the coarser one before it.
double FullAdaptation::share() const {
  const double share = schedule_ ? schedule_->share() : 1.0;
  return (diced_ ? 0.25 + 0.75 * share : share) / static_cast<double>(std::int64_t{1} << (2 * halvings_));
}

}  // namespace pillowmesh
