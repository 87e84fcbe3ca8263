#include "pillowmesh/adapt/local_search.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/coarsen/chord_collapse.h"
#include "pillowmesh/coarsen/diagonal_collapse.h"
#include "pillowmesh/reconnect/chord_split.h"
#include "pillowmesh/reconnect/open.h"
#include "pillowmesh/reconnect/rotate.h"

namespace pillowmesh {

LocalSearch::LocalSearch(Mesh<2>& mesh, Background& background, const Options& options)
    : mesh_(mesh),
      options_(options),
      relocator_(mesh, background, {.alignment = options.alignment}),
      journal_(mesh),
      random_(options.seed) {
  relocator_.journal = &journal_;
  ideal_.assign(mesh.points.size(), 4);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.support[v].dim == 1) ideal_[v] = 2;
    if (mesh.support[v].dim != 0 || !find_star(mesh, v, star_)) continue;
    // A corner is best filled by right angles.
    double angle = 0.0;
    for (int k = 0; k < star_.count; ++k) {
      const Point<2> a = mesh.points[around(mesh, star_.cell[k], star_.place[k] + 1)] - mesh.points[v];
      const Point<2> b = mesh.points[around(mesh, star_.cell[k], star_.place[k] + 3)] - mesh.points[v];
      angle += portable::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    }
    ideal_[v] = static_cast<std::int8_t>(std::max(1.0, portable::floor(angle / 1.5707963267948966 + 0.5)));
  }
}

int LocalSearch::valence(VertexId v) { return find_star(mesh_, v, star_) ? star_.count : 0; }

/// By how much (valence - ideal)^2 grows when the valence changes.
int LocalSearch::excess(VertexId v, int change) {
  const int off = valence(v) - ideal_[v];
  return change * (2 * off + change);
}

bool LocalSearch::interesting(CellId c) {
  if (relocator_.energy(c) > 0.1) return true;
  for (const VertexId v : mesh_.cells[c])
    if (valence(v) != ideal_[v]) return true;
  return false;
}

bool LocalSearch::legal() {
  for (const VertexId v : cavity_.around) {
    if (mesh_.vertex_cell[v] == kNone) continue;
    const int n = valence(v);
    const int dim = mesh_.support[v].dim;
    if (n > 7 || n < (dim == 2 ? 3 : (dim == 1 ? 2 : 1))) return false;
  }
  return true;
}

bool LocalSearch::remove_doublets() {
  for (std::size_t i = 0; i < cavity_.around.size(); ++i) {
    const VertexId v = cavity_.around[i];
    if (mesh_.vertex_cell[v] == kNone || mesh_.support[v].dim != 2) continue;
    const int n = valence(v);
    if (n >= 3) continue;
    if (n != 2 || !plan_doublet_removal(mesh_, v, doublet_)) return false;
    if (!journal_.apply(doublet_, doublet_ids_)) return false;
    cavity_.around.insert(cavity_.around.end(), doublet_.around.begin(), doublet_.around.end());
    new_ids_.push_back(doublet_ids_[0]);
  }
  return true;
}

/// near_: the vertices of the change, each once.
void LocalSearch::collect_near() {
  stamp_.resize(mesh_.points.size(), 0);
  ++stamp_now_;
  near_.clear();
  const auto add = [&](VertexId v) {
    if (mesh_.vertex_cell[v] == kNone || stamp_[v] == stamp_now_) return;
    stamp_[v] = stamp_now_;
    near_.push_back(v);
  };
  for (const VertexId v : cavity_.around) add(v);
  for (const VertexId v : cavity_.moved) add(v);
}

/// `to`: the vertices of the cells at `from`, but not those already stamped.
void LocalSearch::grow(const std::vector<VertexId>& from, std::vector<VertexId>& to) {
  to.clear();
  for (const VertexId v : from) {
    if (!find_star(mesh_, v, star_)) continue;
    for (int k = 0; k < star_.count; ++k)
      for (const VertexId w : mesh_.cells[star_.cell[k]]) {
        if (stamp_[w] == stamp_now_) continue;
        stamp_[w] = stamp_now_;
        to.push_back(w);
      }
  }
}

double LocalSearch::relax(const std::vector<VertexId>& vertices) {
  double gain = 0.0;
  for (const VertexId v : vertices) {
    gain += relocator_.relocate(v);
    ++moves;
  }
  return gain;
}

/// Gives inverted corners an energy for a few sweeps over the changed vertices. \return true when nothing is inverted
/// any more.
bool LocalSearch::untangle() {
  bool good = false;
  for (const double delta : {0.3, 0.1, 0.03}) {
    relocator_.set_delta(delta);
    for (const VertexId v : near_) relocator_.relocate(v), ++moves;
    relocator_.set_delta(0.0);
    good = true;
    for (const VertexId v : near_) {
      if (!find_star(mesh_, v, star_)) return false;
      for (int k = 0; k < star_.count; ++k) {
        relocator_.refresh(star_.cell[k]);
        good = good && relocator_.energy(star_.cell[k]) < 1e100;
      }
    }
    if (good) break;
  }
  return good;
}

bool LocalSearch::attempt(Operator op, double threshold) {
  if (op == Operator::open) threshold += potential;
  if (op == Operator::collapse) threshold -= potential;
  Count& count = counts[static_cast<int>(op)];
  ++count.planned;
  journal_.begin();
  relocator_.begin();
  const auto refuse = [&] {
    journal_.undo();
    relocator_.undo();
    return false;
  };
  if (!journal_.apply(cavity_, new_ids_) || !remove_doublets() || !legal()) return refuse();
  ++count.tried;
  ideal_.resize(mesh_.points.size(), 4);
  collect_near();
  for (const VertexId v : near_) {
    if (mesh_.support[v].dim > 0) ideal_[v] = mesh_.support[v].dim == 2 ? 4 : 2;
    if (v >= journal_.vertices_before() || !cavity_.moved.empty() || !cavity_.new_vertices.empty())
      relocator_.measure_vertex(v);
  }
  for (const CellId c : journal_.cells())
    if (!mesh_.alive(c)) relocator_.forget_cell(c);
  bool good = true;
  const auto measure = [&](CellId c) {
    if (mesh_.alive(c) && !(relocator_.measure_cell(c) < 1e100)) good = false;
  };
  for (const CellId c : new_ids_) measure(c);
  for (const VertexId v : cavity_.moved) {
    if (mesh_.vertex_cell[v] == kNone || !find_star(mesh_, v, star_)) continue;
    for (int k = 0; k < star_.count; ++k) measure(star_.cell[k]);
  }
  if (!good && !untangle()) {
    ++count.tangled;
    return refuse();
  }
  double change = relocator_.change();
  const bool whole = op == Operator::chord_collapse || op == Operator::chord_split;
  const int sweeps_near = whole ? 10 : this->sweeps_near, sweeps_far = whole ? 10 : this->sweeps_far;
  const double hope_near = whole ? 8.0 : op == Operator::open ? hope_open : this->hope_near, hope_far = whole ? 6.0 : this->hope_far;
  for (int k = 0; k < sweeps_near; ++k) {
    const double gain = relax(near_);
    change -= gain;
    if (change - hope_near * gain > threshold) {
      ++count.early;
      return refuse();
    }
    if (gain < 1e-3) break;
  }
  grow(near_, far_);
  far_.insert(far_.end(), near_.begin(), near_.end());
  for (int k = 0; k < sweeps_far && change > threshold; ++k) {
    const double gain = relax(far_);
    change -= gain;
    if (change - hope_far * gain > threshold) return refuse();
  }
  if (change > threshold) return refuse();
  ++count.done;
  ++clock_;
  changed_.resize(mesh_.points.size(), 0);
  for (const VertexId v : near_) changed_[v] = clock_;
  for (const VertexId v : far_) changed_[v] = clock_;
  return true;
}

std::int64_t LocalSearch::pass(double temperature) {
  std::int64_t done = 0;
  changed_.resize(mesh_.points.size(), 0);
  const auto threshold = [&] { return -0.001 + (temperature > 0 ? temperature * random_.exponential() : 0.0); };
  const auto skip = [&](int worse) {
    return worse > 2 || (temperature > 0 && ((worse == 2 && random_.uniform() > chance2) || (worse == 0 && random_.uniform() > chance0)));
  };
  for (CellId c = 0; c < mesh_.cell_count(); ++c) {
    if (!mesh_.alive(c)) continue;
    looked_.resize(mesh_.cells.size(), 0);
    if (temperature == 0.0) {
      bool news = false;
      for (const VertexId v : mesh_.cells[c]) news = news || changed_[v] >= looked_[c];
      if (!news) continue;
    }
    if (!interesting(c)) continue;
    const Index now = ++clock_;
    for (int side = 0; side < 4 && mesh_.alive(c); ++side) {
      const HalfFacetId twin = twin_of_side(mesh_, c, side);
      if (twin < 0 || mesh_.cell_of(twin) > c) continue;
      for (int way = 0; way < 2; ++way) {
        if (!plan_rotation(mesh_, c, side, way, cavity_)) continue;
        const auto& r = cavity_.around;
        const VertexId from = way == 0 ? r[2] : r[3], to = way == 0 ? r[4] : r[5];
        if (skip(excess(r[0], -1) + excess(r[1], -1) + excess(from, 1) + excess(to, 1))) continue;
        if (attempt(Operator::rotate, threshold())) {
          ++done;
          break;
        }
      }
    }
    if (!mesh_.alive(c)) continue;
    for (int i = 0; i < 4; ++i) {
      const VertexId d = around(mesh_, c, i), x = around(mesh_, c, i + 1), k = around(mesh_, c, i + 2),
                     y = around(mesh_, c, i + 3);
      if (mesh_.support[d].dim != 2 || (mesh_.support[k].dim == 2 && i >= 2)) continue;
      const int joined = mesh_.support[k].dim == 2 ? valence(d) + valence(k) - 2 : valence(d) + valence(k) - 2;
      const int off = joined - ideal_[k], before_d = valence(d) - 4, before_k = valence(k) - ideal_[k];
      if (skip(off * off - before_d * before_d - before_k * before_k + excess(x, -1) + excess(y, -1))) continue;
      if (!plan_diagonal_collapse(mesh_, c, i, cavity_)) continue;
      if (attempt(Operator::collapse, threshold())) {
        ++done;
        break;
      }
    }
    if (!mesh_.alive(c)) continue;
    for (int i = 0; i < 4 && mesh_.alive(c); ++i) {
      const VertexId v = around(mesh_, c, i);
      if (mesh_.support[v].dim != 2 || mesh_.vertex_cell[v] != c) continue;
      QuadStar star;
      if (!find_star(mesh_, v, star)) continue;
      const int n = star.count;
      bool opened = false;
      for (int first = 0; first < n && !opened; ++first)
        for (int turned = 2; 2 * turned <= n && !opened; ++turned) {
          if (2 * turned == n && first >= turned) continue;
          const int last = first + turned;
          const VertexId a = around(mesh_, star.cell[first], star.place[first] + 1);
          const VertexId b = around(mesh_, star.cell[last % n], star.place[last % n] + 1);
          const int v1 = n - turned + 1 - 4, v2 = turned + 1 - 4, v0 = n - 4;
          if (skip(v1 * v1 + v2 * v2 - v0 * v0 + excess(a, 1) + excess(b, 1))) continue;
          if (!plan_opening(mesh_, v, star, first, last, cavity_)) continue;
          if (attempt(Operator::open, threshold())) {
            ++done;
            opened = true;
          }
        }
    }
    looked_.resize(mesh_.cells.size(), 0);
    looked_[c] = now;
  }
  return done;
}

std::int64_t LocalSearch::chord_pass() {
  std::int64_t done = 0;
  std::vector<std::uint8_t> seen(mesh_.cells.size(), 0);  // bit per axis
  for (CellId c = 0; c < mesh_.cell_count(); ++c)
    for (int axis = 0; axis < 2; ++axis) {
      if (!mesh_.alive(c)) continue;
      seen.resize(mesh_.cells.size(), 3);
      if (seen[c] & (1 << axis)) continue;
      marks_.resize(mesh_.cells.size(), 0);
      find_chord(mesh_, c, axis, marks_, chord_);
      double sum = 0.0;
      for (std::size_t k = 0; k < chord_.cells.size(); ++k) {
        const auto [cell, side] = chord_.cells[k];
        seen[cell] |= static_cast<std::uint8_t>(1 << (side & 1));
        sum += relocator_.edge(cell, side).l;
      }
      const double mean = sum / static_cast<double>(chord_.cells.size());
      ++chords_seen; if (chord_.crosses) ++chords_crossing;
      if (mean < chord_low && plan_chord_collapse(mesh_, chord_, cavity_) && attempt(Operator::chord_collapse, -0.001)) ++done;
      else if (mean > chord_high && plan_chord_split(mesh_, chord_, cavity_) && attempt(Operator::chord_split, -0.001)) ++done;
    }
  return done;
}

double LocalSearch::sweep() {
  journal_.begin();
  relocator_.begin();
  double gain = 0.0;
  for (VertexId v = 0; v < mesh_.vertex_count(); ++v)
    if (mesh_.vertex_cell[v] != kNone) gain += relocator_.relocate(v), ++moves;
  journal_.begin();
  relocator_.begin();
  return gain;
}

}  // namespace pillowmesh
