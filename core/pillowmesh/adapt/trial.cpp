#include "pillowmesh/adapt/trial.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "pillowmesh/coarsen/diagonal_collapse.h"
#include "pillowmesh/mesh/overlap.h"
#include "pillowmesh/mesh/portable_math.h"
#include "pillowmesh/smooth/quad_descent.h"

namespace pillowmesh {
namespace {

constexpr double kInverted = 1e100;
constexpr int kMostCells = 7;  ///< at a vertex

/// How long a change is relaxed, and how much more than in the last sweep it may still gain.
struct Patience {
  int near_sweeps, rings, far_sweeps;
  double near_hope, far_hope;
};
Patience patience(Operator op) {
  switch (op) {
    case Operator::rotate:
    case Operator::collapse: return {4, 1, 2, 0.3, 0.5};
    case Operator::open:
    case Operator::boundary_collapse:
    case Operator::boundary_open:
    case Operator::partial_chord_collapse:
    case Operator::partial_chord_split: return {4, 1, 2, 0.5, 0.5};  // starts from a sliver
    case Operator::chord_collapse:
    case Operator::chord_split: break;
  }
  return {0, 3, 6, 0.0, 2.0};  // the rows beside it have to give way, and those beside them
}

}  // namespace

Trial::Trial(Mesh<2>& mesh, Background& background, const QuadRelocator::Weights& weights)
    : relocator(mesh, background, weights), mesh_(mesh), journal_(mesh) {
  relocator.journal = &journal_;
  relocator.rest = 1e-4;
  relocator.relaxation = 1.3;
  ideal_.assign(mesh.points.size(), 4);
  changed_.assign(mesh.points.size(), clock_);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.support[v].dim == 1) ideal_[v] = 2;
    if (mesh.support[v].dim != 0 || !find_star(mesh, v, star_)) continue;
    double angle = 0.0;
    for (int k = 0; k < star_.count; ++k) {
      const Point<2> a = mesh.points[around(mesh, star_.cell[k], star_.place[k] + 1)] - mesh.points[v];
      const Point<2> b = mesh.points[around(mesh, star_.cell[k], star_.place[k] + 3)] - mesh.points[v];
      angle += portable::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    }
    ideal_[v] = static_cast<std::int8_t>(std::max(1.0, portable::floor(angle / 1.5707963267948966 + 0.5)));
  }
}

void Trial::touch_all() {
  ++clock_;
  changed_.assign(mesh_.points.size(), clock_);
  partial_ = false;
}

void Trial::touch_only(std::span<const VertexId> vertices) {
  static_assert(kUntouched != kNone, "what Outlook has not seen yet");
  partial_ = true;
  changed_.assign(mesh_.points.size(), kUntouched);
  for (const VertexId v : vertices) changed_[v] = clock_;
}

void Trial::release() {
  for (std::vector<Index>* v : {&stamp_, &changed_}) std::vector<Index>().swap(*v);
  std::vector<std::int8_t>().swap(ideal_);
}

bool Trial::remove_doublets() {
  for (std::size_t i = 0; i < cavity.around.size(); ++i) {
    const VertexId v = cavity.around[i];
    if (mesh_.vertex_cell[v] == kNone || mesh_.support[v].dim != 2) continue;
    const int n = valence(v);
    if (n >= 3) continue;
    if (n != 2 || !plan_doublet_removal(mesh_, v, doublet_)) return false;
    if (!journal_.apply(doublet_, doublet_ids_)) return false;
    cavity.around.insert(cavity.around.end(), doublet_.around.begin(), doublet_.around.end());
    new_ids_.push_back(doublet_ids_[0]);
  }
  return true;
}

bool Trial::valences_allow() {
  for (const VertexId v : near_) {
    const int n = valence(v), dim = mesh_.support[v].dim;
    if (n > kMostCells || n < (dim == 2 ? 3 : (dim == 1 ? 2 : 1))) return false;
  }
  return true;
}

bool Trial::change_topology() {
  if (!journal_.apply(cavity, new_ids_) || !remove_doublets()) return false;
  collect_near();
  return valences_allow();
}

/// Measures what is new. \return false when a cell is inverted.
bool Trial::measure() {
  ideal_.resize(mesh_.points.size(), 4);
  changed_.resize(mesh_.points.size(), 0);
  const bool moved = !cavity.moved.empty() || !cavity.new_vertices.empty();
  for (const VertexId v : near_) {
    if (mesh_.support[v].dim > 0) ideal_[v] = mesh_.support[v].dim == 2 ? 4 : 2;
    if (moved) relocator.measure_vertex(v);
  }
  for (const CellId c : journal_.cells())
    if (!mesh_.alive(c)) relocator.forget_cell(c);
  bool good = true;
  const auto measure_cell = [&](CellId c) {
    if (mesh_.alive(c) && !(relocator.measure_cell(c) < kInverted)) good = false;
  };
  for (const CellId c : new_ids_) measure_cell(c);
  for (const VertexId v : cavity.moved) {
    if (mesh_.vertex_cell[v] == kNone || !find_star(mesh_, v, star_)) continue;
    for (int k = 0; k < star_.count; ++k) measure_cell(star_.cell[k]);
  }
  return good;
}

/// Gives inverted corners an energy for a few sweeps over the changed vertices. \return true when nothing is inverted
/// any more.
bool Trial::untangle() {
  for (const double delta : {0.3, 0.1, 0.03}) {
    relocator.set_delta(delta);
    relax(near_);
    relocator.set_delta(0.0);
    if (relocator.refresh_changed() < kInverted) return true;
  }
  return false;
}

/// Whether the mesh lies over itself at one of the vertices: untangled corners may be positive, and go around it twice.
bool Trial::folded(const std::vector<VertexId>& vertices) const {
  return std::any_of(vertices.begin(), vertices.end(), [&](VertexId v) { return folded_at(mesh_, v); });
}

void Trial::collect_near() {
  stamp_.resize(mesh_.points.size(), 0);
  ++stamp_now_;
  near_.clear();
  const auto add = [&](VertexId v) {
    if (mesh_.vertex_cell[v] == kNone || stamp_[v] == stamp_now_) return;
    stamp_[v] = stamp_now_;
    near_.push_back(v);
  };
  for (const VertexId v : cavity.around) add(v);
  for (const VertexId v : cavity.moved) add(v);
}

void Trial::collect_far(int rings) {
  far_ = near_;
  std::size_t first = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t last = far_.size();
    for (; first < last; ++first) {
      if (!find_star(mesh_, far_[first], star_)) continue;
      for (int k = 0; k < star_.count; ++k)
        for (const VertexId w : mesh_.cells[star_.cell[k]]) {
          if (stamp_[w] == stamp_now_) continue;
          stamp_[w] = stamp_now_;
          far_.push_back(w);
        }
    }
  }
}

double Trial::relax(const std::vector<VertexId>& vertices) {
  double gain = 0.0;
  for (const VertexId v : vertices) gain += relocator.relocate(v);
  moves += static_cast<std::int64_t>(vertices.size());
  return gain;
}

bool Trial::attempt(Operator op, double threshold) {
  Count& count = counts[static_cast<int>(op)];
  const Patience patient = patience(op);
  journal_.begin();
  relocator.begin();
  const auto refuse = [&](std::int64_t& why) {
    ++why;
    journal_.undo();
    relocator.undo();
    return false;
  };
  // What a sweep gains, times its hope, is all that may still come.
  double change = 0.0;
  const auto hopeless = [&](double gain, double hope) {
    change -= gain;
    refused_growth = change - hope * gain;
    return refused_growth > threshold;
  };
  std::int64_t illegal = 0;
  refused_growth = -std::numeric_limits<double>::infinity();  // what is around may come to allow it
  if (!change_topology()) return refuse(illegal);
  ++count.tried;
  refused_growth = std::numeric_limits<double>::infinity();
  if (!measure() && !untangle()) return refuse(count.tangled);
  change = relocator.change();
  for (int k = 0; k < patient.near_sweeps; ++k) {
    const double gain = relax(near_);
    if (hopeless(gain, patient.near_hope)) return refuse(count.hopeless);
    if (gain < 1e-3 || (change < threshold && k + 1 >= least_sweeps)) break;
  }
  collect_far(patient.rings);
  for (int k = 0; k < patient.far_sweeps && change > threshold; ++k) {
    if (hopeless(relax(far_), patient.far_hope)) return refuse(count.hopeless);
  }
  refused_growth = change;
  if (change > threshold || relocator.longest_changed() > longest_allowed || folded(near_)) return refuse(count.hopeless);
  keep(op, far_);
  return true;
}

void Trial::keep(Operator op, const std::vector<VertexId>& changed) {
  ++counts[static_cast<int>(op)].kept;
  ++clock_;
  for (const VertexId v : changed) changed_[v] = clock_;
  if (kept) kept(op, journal_);
}

bool Trial::attempt_at_large(Operator op, double threshold) {
  constexpr int kIterations = 60, kHope = 12;  // how many times the gain of an iteration may still be to come
  const double before = relocator.total_energy();
  journal_.begin();
  relocator.begin();
  Count& count = counts[static_cast<int>(op)];
  bool good = change_topology();
  if (good) ++count.tried;
  good = good && (measure() || untangle());
  if (good) {
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v)
      if (mesh_.vertex_cell[v] != kNone) journal_.touch(v);
    QuadDescent descent(mesh_, relocator);
    double left = relocator.total_energy() - (before + threshold), gain = left;
    for (int i = 0; i < kIterations && left > 0.0 && gain > 0.0 && left < kHope * gain; ++i) left -= gain = descent.iterate();
    good = left < 0.0 && !folded(journal_.vertices());
  }
  if (good) {
    keep(op, journal_.vertices());
  } else {
    ++count.hopeless;
    journal_.undo();
    relocator.measure_all(relocator.weights());
  }
  return good;
}

void Trial::mend_shapes(double eta) {
  constexpr int kRounds = 4;
  constexpr double kWeight = 30.0;  // as in the polish
  const double before = relocator.weights().shape;
  for (const CellId c : relocator.cells_below(eta)) {
    if (std::none_of(mesh_.cells[c].begin(), mesh_.cells[c].end(), [&](VertexId v) { return touched(v); })) continue;
    journal_.begin();
    relocator.begin();
    relocator.set_shape(kWeight);
    for (int k = 0; k < kRounds; ++k)
      for (const VertexId v : mesh_.cells[c]) relocator.relocate(v), ++moves;
    relocator.set_shape(before);
    relocator.refresh_changed();
    if (relocator.longest_changed() > longest_allowed) {
      journal_.undo();
      relocator.undo();
    } else if (partial_) {
      for (const VertexId v : journal_.vertices()) changed_[v] = clock_;
    }
  }
}

void Trial::begin_sweep() {
  swept_.resize(mesh_.points.size(), 0);
  ++sweep_;
}

/// By cells, since what belongs to neighbours lies together there: after dicing, vertices with neighbouring numbers do not.
double Trial::sweep(CellId first, CellId last) {
  relocator.begin_for_good();
  relocator.journal = nullptr;
  // A displacement of the whole mesh is little at each vertex: here small gains count.
  const double relaxation = std::exchange(relocator.relaxation, 1.5), rest = std::exchange(relocator.rest, 1e-9);
  double gain = 0.0;
  for (CellId c = first; c < last; ++c) {
    if (!mesh_.alive(c)) continue;
    for (const VertexId v : mesh_.cells[c])
      if (std::exchange(swept_[v], sweep_) != sweep_ && touched(v)) gain += relocator.relocate(v), ++moves;
  }
  relocator.relaxation = relaxation;
  relocator.rest = rest;
  relocator.journal = &journal_;
  relocator.begin();
  return gain;
}

}  // namespace pillowmesh
