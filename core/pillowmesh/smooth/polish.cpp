#include "pillowmesh/smooth/polish.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/portable_math.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/metric/volume.h"
#include "pillowmesh/quality/corner_simplex.h"
#include "pillowmesh/quality/shape.h"

namespace pillowmesh {
namespace {

using C = Cell<3>;
constexpr SimplexPairs<3> kTable;
constexpr int kPairs = SimplexPairs<3>::count;

/// eta of the flat simplex; below 0 where there is none, the more the further the lengths miss one.
double signed_shape(const SimplexLengths<3>& l) {
  double squares = 0.0;
  for (const double x : l) squares += x * x;
  const double a = l[0] * l[0], b = l[1] * l[1], c = l[2] * l[2];
  const double ab = 0.5 * (a + b - l[3] * l[3]), ac = 0.5 * (a + c - l[4] * l[4]), bc = 0.5 * (b + c - l[5] * l[5]);
  const double det = c * (a * b - ab * ab) - a * bc * bc - b * ac * ac + 2.0 * ab * ac * bc;
  const double size = 9.0 * portable::pow(std::fabs(det), 1.0 / 3.0) / squares;
  const double minor = std::min(1.0 - ab * ab / (a * b), std::min(1.0 - ac * ac / (a * c), 1.0 - bc * bc / (b * c)));
  if (minor <= 0.0) return std::max(minor, -2.0) - size;
  return det > 0.0 ? size : -size;
}

class Polisher {
 public:
  Polisher(Mesh<3>& mesh, const MetricField<3>& field, const PolishOptions& options)
      : mesh_(mesh),
        field_(field),
        options_(options),
        panel_(default_panel<3>(mesh.points)),
        slot_(mesh.cells.size(), kNone) {}

  PolishResult run() {
    constexpr int patience = 5;  // sweeps: each tries other places
    PolishResult result;
    const Index cells = find_poor();
    result.poor_before = result.poor_after = static_cast<Index>(poor_.size());
    if (result.poor_before > options_.most_poor * cells) return result;
    double last = total();
    for (int sweep = 1; sweep <= options_.max_sweeps && !poor_.empty(); ++sweep) {
      result.moved += move_all();
      find_still_poor();
      if (sweep % patience != 0) continue;
      const double now = total();
      if (now > 0.95 * last) break;
      last = now;
    }
    shake_loose(result);
    result.poor_after = static_cast<Index>(poor_.size());
    return result;
  }

 private:
  /// What has been measured of a cell.
  struct Measured {
    std::array<double, kPairs> length;
    std::array<double, C::corners> volume;  ///< of the corner simplices
    double shortfall;
  };

  /// Looks at all cells, roughly, and closely at those that may be poor. \return the number of all
  Index find_poor() {
    constexpr double roughly = 1.5;
    const std::vector<CellId> cells = live_cells(mesh_);
    std::vector<double> flat(cells.size()), integral(cells.size());
    cell_shapes<3>(mesh_, field_, cells, flat, integral, {.tolerance = 1e-3});
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (std::min(flat[i], integral[i]) < roughly * options_.shape && known(cells[i]).shortfall > 0.0)
        poor_.push_back(cells[i]);
    return static_cast<Index>(cells.size());
  }

  /// Neighbours of poor cells may have become poor.
  void find_still_poor() {
    poor_.clear();
    for (CellId c = 0; c < mesh_.cell_count(); ++c)
      if (slot_[c] != kNone && known_[slot_[c]].shortfall > 0.0) poor_.push_back(c);
  }

  /// Cells that are still hardly a simplex, or none, are shaken in turns.
  void shake_loose(PolishResult& result) {
    constexpr int most = 48;
    const double hardly = 0.25 * options_.shape * options_.shape;
    std::vector<CellId> loose;
    for (int i = 0; i < most; ++i) {
      loose.clear();
      for (const CellId c : poor_)
        if (known_[slot_[c]].shortfall > hardly) loose.push_back(c);
      if (loose.empty()) return;
      result.moved += shake(loose[static_cast<std::size_t>(i) % loose.size()], i % 2 == 0 ? 0.8 : 0.4);
      find_still_poor();
    }
  }

  /// Where descent has come to rest: the corners of a poor cell are displaced, worse or not, and the descent begins
  /// anew from there. What ends with a greater shortfall is taken back. \param reach in units of the shortest edge
  /// \return the moves kept
  Index shake(CellId c, double reach) {
    constexpr int sweeps = 12;
    journal_.clear();
    saved_.clear();
    touched_.clear();
    change_ = 0.0;
    journaling_ = true;
    for (const VertexId v : mesh_.cells[c]) {
      if (mesh_.support[v].dim == 0) continue;
      const double length = take_up(v);
      shortfall_ = INFINITY;
      attempt(v, reach * length * next_direction());
    }
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      vertices_.clear();
      for (const CellId t : touched_)
        if (known_[slot_[t]].shortfall > 0.0) add_vertices(t);
      if (visit_all() == 0) break;
    }
    journaling_ = false;
    if (change_ < 0.0) return static_cast<Index>(journal_.size());
    for (std::size_t i = journal_.size(); i-- > 0;) {
      mesh_.points[journal_[i].vertex] = journal_[i].from;
      mesh_.anchor[journal_[i].vertex] = journal_[i].anchor;
    }
    for (std::size_t i = saved_.size(); i-- > 0;) known_[saved_[i].first] = saved_[i].second;
    return 0;
  }

  [[nodiscard]] double total() const {
    double sum = 0.0;
    for (const CellId c : poor_) sum += known_[slot_[c]].shortfall;
    return sum;
  }

  const Measured& known(CellId c) {
    if (slot_[c] == kNone) {
      Measured m;
      measure_lengths(c, kNone, m);
      measure_volumes(c, kNone, m);
      m.shortfall = flat_shortfall(m) + integral_shortfall(m);
      slot_[c] = static_cast<Index>(known_.size());
      known_.push_back(m);
    }
    return known_[slot_[c]];
  }

  /// Measures the lengths that depend on corner k, or all of them when k is kNone.
  void measure_lengths(CellId c, int k, Measured& m) {
    std::array<std::array<VertexId, 2>, kPairs> pairs;
    std::array<int, kPairs> at;
    std::array<double, kPairs> found;
    std::size_t n = 0;
    for (int j = 0; j < kPairs; ++j) {
      const auto [a, b] = kTable.pair[j];
      if (k != kNone && a != k && b != k) continue;
      pairs[n] = {mesh_.cells[c][a], mesh_.cells[c][b]};
      at[n++] = j;
    }
    edge_lengths<3>(field_, mesh_.points, std::span(pairs).first(n), std::span(found).first(n),
                    {.tolerance = 1e-5, .panel = panel_});
    for (std::size_t i = 0; i < n; ++i) m.length[at[i]] = found[i];
  }

  void measure_volumes(CellId c, int k, Measured& m) {
    std::array<SimplexPoints<3>, C::corners> simplices;
    std::array<int, C::corners> at;
    std::array<double, C::corners> found;
    std::size_t n = 0;
    for (int i = 0; i < C::corners; ++i) {
      const int bits = i ^ k;
      if (k != kNone && (bits & (bits - 1)) != 0) continue;
      simplices[n] = corner_simplex(mesh_, c, i);
      at[n++] = i;
    }
    simplex_volumes(field_, std::span(simplices).first(n), std::span(found).first(n), {.tolerance = 2e-2});
    for (std::size_t i = 0; i < n; ++i) m.volume[at[i]] = found[i];
  }

  static SimplexLengths<3> lengths_of(const Measured& m, int k) {
    SimplexLengths<3> l;
    for (int i = 0; i < 6; ++i) l[i] = m.length[kTable.place[k][i]];
    return l;
  }
  [[nodiscard]] double square_below(double eta) const {
    const double d = options_.shape - eta;
    return d > 0.0 ? d * d : 0.0;
  }
  [[nodiscard]] double flat_shortfall(const Measured& m) const {
    double sum = 0.0;
    for (int k = 0; k < C::corners; ++k) sum += square_below(signed_shape(lengths_of(m, k)));
    return sum;
  }
  [[nodiscard]] double integral_shortfall(const Measured& m) const {
    double sum = 0.0;
    for (int k = 0; k < C::corners; ++k) sum += square_below(simplex_shape<3>(lengths_of(m, k), m.volume[k]));
    return sum;
  }

  /// One visit of every vertex of a poor cell. \return how often one moved
  Index move_all() {
    vertices_.clear();
    for (const CellId c : poor_) add_vertices(c);
    return visit_all();
  }

  void add_vertices(CellId c) {
    for (const VertexId v : mesh_.cells[c])
      if (mesh_.support[v].dim > 0) vertices_.push_back(v);
  }

  Index visit_all() {
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    Index moved = 0;
    for (const VertexId v : vertices_) moved += visit(v);
    return moved;
  }

  /// Gathers what is around vertex v. \return the length of the shortest edge there
  double take_up(VertexId v) {
    vertex_star(mesh_, v, star_);
    shortfall_ = 0.0;
    double shortest2 = INFINITY;
    for (const auto& [c, corner] : star_) {
      shortfall_ += known(c).shortfall;
      for (int d = 0; d < 3; ++d)
        shortest2 =
            std::min(shortest2, (mesh_.points[mesh_.cells[c][corner ^ (1 << d)]] - mesh_.points[v]).squaredNorm());
    }
    before_ = shortfall_;
    lowest_ = least_scaled_jacobian();
    return std::sqrt(shortest2);
  }

  /// Tries places around vertex v, the nearer the later, and goes on from each that is better.
  Index visit(VertexId v) {
    constexpr std::array<double, 8> reach{0.6, 0.3, 0.15, 0.08, 0.04, 0.2, 0.02, 0.01};
    const double shortest = take_up(v);
    Index moved = 0;
    for (std::size_t i = 0; i < reach.size() && shortfall_ > 0.0; ++i)
      moved += attempt(v, reach[i] * shortest * next_direction());
    return moved;
  }

  /// Points in the cube from -1 to 1, evenly spread: the additive recurrence whose shares are the powers of the root of
  /// x^4 = x + 1. [M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018]
  Point<3> next_direction() {
    constexpr std::array<double, 3> share{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    ++tried_;
    Point<3> direction;
    for (int d = 0; d < 3; ++d) {
      const double x = tried_ * share[d];
      direction[d] = 2.0 * (x - std::floor(x)) - 1.0;
    }
    return direction;
  }

  /// 0 or less when a cell of the star is inverted inside.
  [[nodiscard]] double least_scaled_jacobian() const {
    double least = 1.0;
    for (const CellCorner& s : star_) {
      const auto& cell = mesh_.cells[s.cell];
      const LatticeJacobians found = lattice_jacobians([&](int i) -> const Point<3>& { return mesh_.points[cell[i]]; });
      least = std::min(least, found.lowest > 0.0 ? found.scaled : std::min(found.scaled, 0.0));
    }
    return least;
  }

  bool attempt(VertexId v, const Point<3>& step) {
    const Point<3> from = mesh_.points[v];
    Index anchor = mesh_.anchor[v];
    mesh_.points[v] = slide(*mesh_.geometry, mesh_.support[v], anchor, Point<3>(from + step));
    const double lowest = least_scaled_jacobian();
    const bool sound = lowest > 0.0 && (lowest > options_.quality_guard || lowest >= lowest_);
    double shortfall = 0.0;
    if (!sound || !better(shortfall)) {
      mesh_.points[v] = from;
      return false;
    }
    if (journaling_) remember(v, from);
    mesh_.anchor[v] = anchor;
    for (std::size_t i = 0; i < star_.size(); ++i) known_[slot_[star_[i].cell]] = trial_[i];
    change_ += shortfall - before_;
    shortfall_ = before_ = shortfall;
    lowest_ = lowest;
    return true;
  }

  void remember(VertexId v, const Point<3>& from) {
    journal_.push_back({v, from, mesh_.anchor[v]});
    for (const CellCorner& s : star_) {
      const Index slot = slot_[s.cell];
      saved_.emplace_back(slot, known_[slot]);
      if (std::find(touched_.begin(), touched_.end(), s.cell) == touched_.end()) touched_.push_back(s.cell);
    }
  }

  /// Measures the star as it is now, first what is cheap. False as soon as it is no better than it was.
  bool better(double& shortfall) {
    trial_.clear();
    for (const auto& [c, corner] : star_) {
      const Measured& before = known_[slot_[c]];
      Measured& now = trial_.emplace_back(before);
      measure_lengths(c, corner, now);
      for (int j = 0; j < kPairs; ++j)
        if (kTable.is_edge(j) && now.length[j] > 0.9999 * options_.threshold && now.length[j] > before.length[j])
          return false;
      now.shortfall = flat_shortfall(now);
      shortfall += now.shortfall;
      if (!(shortfall < shortfall_)) return false;
    }
    for (std::size_t i = 0; i < star_.size(); ++i) {
      measure_volumes(star_[i].cell, star_[i].corner, trial_[i]);
      const double integral = integral_shortfall(trial_[i]);
      trial_[i].shortfall += integral;
      shortfall += integral;
      if (!(shortfall < shortfall_)) return false;
    }
    return true;
  }

  Mesh<3>& mesh_;
  const MetricField<3>& field_;
  PolishOptions options_;
  double panel_;             ///< lengths as the report sees them: narrow features must not fall between samples
  std::vector<Index> slot_;  ///< per cell: its place in known_
  std::vector<Measured> known_, trial_;
  std::vector<CellId> poor_;
  std::vector<VertexId> vertices_;
  std::vector<CellCorner> star_;
  double shortfall_ = 0.0, lowest_ = 0.0;  ///< of the star
  double before_ = 0.0;                    ///< the star's shortfall as it is, where shortfall_ tells what is allowed
  /// What a shake has done, to be taken back.
  struct Step {
    VertexId vertex;
    Point<3> from;
    Index anchor;
  };
  bool journaling_ = false;
  std::vector<Step> journal_;
  std::vector<std::pair<Index, Measured>> saved_;  ///< places in known_, what was there
  std::vector<CellId> touched_;
  double change_ = 0.0;  ///< of the shortfall of all cells
  double tried_ = 0.0;
};

}  // namespace

PolishResult polish_shapes(Mesh<3>& mesh, const MetricField<3>& field, const PolishOptions& options) {
  return Polisher(mesh, field, options).run();
}

}  // namespace pillowmesh
