#include "pillowmesh/adapt/local_search.h"

#include <algorithm>

#include "pillowmesh/coarsen/boundary_collapse.h"
#include "pillowmesh/coarsen/chord_collapse.h"
#include "pillowmesh/coarsen/diagonal_collapse.h"
#include "pillowmesh/coarsen/partial_chord_collapse.h"
#include "pillowmesh/reconnect/boundary_open.h"
#include "pillowmesh/reconnect/chord_split.h"
#include "pillowmesh/reconnect/open.h"
#include "pillowmesh/reconnect/partial_chord_split.h"
#include "pillowmesh/reconnect/rotate.h"

namespace pillowmesh {
namespace {

constexpr int kMostExcess = 2;        ///< changes that make more irregularity than this hardly ever pay
constexpr int kMostExcessOpened = 4;  ///< an opening among regular vertices makes two dislocations: else none would come there
constexpr int kRefusedAtLarge = 3;    ///< rows that the whole mesh was relocated for in vain
constexpr double kNoise = 0.001;      ///< a gain smaller than this is none
constexpr double kPoorCell = 0.1;     ///< energy above which a cell is looked at

/// Part of a row comes or goes in one change where up to so many cells are too wide or too narrow together; more are hardly
/// ever kept. Each of its cells is worth more than one alone, as the whole row is judged early or not at all. Tried at this
/// share of the cells: at all of them it takes a third of the time for nothing more.
constexpr int kLongestPart = 4;
constexpr double kShareOfParts = 0.3;

/// Logarithm of the odds below which a change is not tried, when hot and when cold.
constexpr double kLeastOdds = -2.2, kLeastOddsCold = -3.5;

int square(int a) { return a * a; }

/// Rows that the whole mesh is relocated for: so few that large meshes, made from coarse ones that had theirs, take no
/// longer for a cell.
int most_attempts_at_large(CellId cells) { return std::clamp(20'000 / std::max(cells, 1), 4, 12); }

}  // namespace

void LocalSearch::begin_pass(double temperature, double above) {
  temperature_ = temperature;
  above_ = above;
  next_ = 0;
  kept_ = 0;
  outlook_.forget();
  if (temperature > 0.0) refusals_.make_room(mesh_.cell_count());
}

void LocalSearch::release() {
  outlook_.release();
  refusals_.release();
  std::vector<Index>().swap(looked_);
  std::vector<std::uint8_t>().swap(marks_);
}

bool LocalSearch::interesting(CellId c) {
  if (above_ > 0.0) return trial_.relocator.energy(c) > above_;
  if (trial_.relocator.energy(c) > kPoorCell) return true;
  for (const VertexId v : mesh_.cells[c])
    if (outlook_.valence(v) != trial_.ideal(v)) return true;
  return false;
}

bool LocalSearch::is_crowded(CellId c) const {
  const auto length = [&](int side) { return 0.5 * (trial_.relocator.edge(c, side).l + trial_.relocator.edge(c, side + 2).l); };
  return temperature_ > 0.0 && length(0) * length(1) < crowded_area;
}

/// By how much a change may raise the energy, at the temperature of the pass, when `bonus` more is allowed.
double LocalSearch::allowance(double bonus) {
  return (temperature_ > 0 ? temperature_ * random_.exponential() : 0.0) - kNoise + bonus;
}

bool LocalSearch::hopeless(double odds) const { return odds < (temperature_ > 0.0 ? kLeastOdds : kLeastOddsCold); }

bool LocalSearch::attempt(Operator op, double allowed) {
  // Cold passes look at each change once.
  const bool hot = temperature_ > 0.0;
  const Refusals::Key key = hot ? Refusals::key(op, trial_.cavity) : 0;
  if (hot && refusals_.expected(key, allowed)) return false;
  if (trial_.attempt(op, allowed)) {
    ++kept_;
    return true;
  }
  if (hot) refusals_.remember(key, trial_.refused_growth);
  return false;
}

bool LocalSearch::continue_pass(std::int64_t moves) {
  const std::int64_t stop = trial_.moves + moves;
  for (; next_ < mesh_.cell_count(); ++next_) {
    if (trial_.moves > stop) return true;
    const CellId c = next_;
    if (!mesh_.alive(c)) continue;
    looked_.resize(mesh_.cells.size(), 0);
    if (temperature_ == 0.0) {
      bool news = false;
      for (const VertexId v : mesh_.cells[c]) news = news || trial_.changed(v) >= looked_[c];
      if (!news) continue;
    }
    if (!interesting(c)) continue;
    const Index now = trial_.tick();
    try_all(c);
    looked_.resize(mesh_.cells.size(), 0);
    looked_[c] = now;
  }
  return false;
}

void LocalSearch::try_all(CellId c) {
  if (is_crowded(c)) {
    for (int side = 0; side < 4; ++side)
      if (mesh_.alive(c)) try_partial_collapses(c, side);
    try_collapses(c);
    try_boundary_collapses(c);
    return;
  }
  try_rotations(c);
  try_collapses(c);
  try_openings(c);
  try_boundary_collapses(c);
  try_boundary_openings(c);
  if (random_.uniform() < kShareOfParts)
    for (int side = 0; side < 4; ++side) {
      if (mesh_.alive(c)) try_partial_collapses(c, side);
      if (mesh_.alive(c)) try_partial_splits(c, side);
    }
}

void LocalSearch::try_rotations(CellId c) {
  for (int side = 0; side < 4 && mesh_.alive(c); ++side) {
    const HalfFacetId twin = twin_of_side(mesh_, c, side);
    if (twin < 0 || mesh_.cell_of(twin) > c) continue;
    const CellId n = mesh_.cell_of(twin);
    const int j = kFacetSide[mesh_.facet_of(twin)];
    const VertexId v[] = {around(mesh_, c, side),     around(mesh_, c, side + 1), around(mesh_, c, side + 2),
                          around(mesh_, c, side + 3), around(mesh_, n, j + 2),    around(mesh_, n, j + 3)};
    for (int way = 0; way < 2; ++way) {
      const VertexId from = way == 0 ? v[2] : v[3], to = way == 0 ? v[4] : v[5];
      const int excess = outlook_.excess(v[0], -1) + outlook_.excess(v[1], -1) + outlook_.excess(from, 1) + outlook_.excess(to, 1);
      if (excess > kMostExcess) continue;
      const double allowed = allowance(0.0);
      if (hopeless(outlook_.rotation(c, side, n, j, way, excess, allowed)) || !plan_rotation(mesh_, c, side, way, trial_.cavity))
        continue;
      if (attempt(Operator::rotate, allowed)) break;
    }
  }
}

void LocalSearch::try_collapses(CellId c) {
  for (int i = 0; i < 4 && mesh_.alive(c); ++i) {
    const VertexId drop = around(mesh_, c, i), x = around(mesh_, c, i + 1), keep = around(mesh_, c, i + 2),
                   y = around(mesh_, c, i + 3);
    const bool inside = mesh_.support[keep].dim == 2;
    if (mesh_.support[drop].dim != 2 || (inside && i >= 2)) continue;  // the other way round is the same
    const int a = outlook_.valence(drop), b = outlook_.valence(keep), ideal = trial_.ideal(keep);
    const int excess =
        square(a + b - 2 - ideal) - square(a - 4) - square(b - ideal) + outlook_.excess(x, -1) + outlook_.excess(y, -1);
    if (excess > kMostExcess) continue;
    const double allowed = allowance(-cell_bonus);
    if (hopeless(outlook_.collapse(c, i, excess, allowed)) || !plan_diagonal_collapse(mesh_, c, i, trial_.cavity)) continue;
    if (attempt(Operator::collapse, allowed)) return;
  }
}

void LocalSearch::try_openings(CellId c) {
  for (int i = 0; i < 4 && mesh_.alive(c); ++i) {
    const VertexId v = around(mesh_, c, i);
    OrderedStar star;
    // Each vertex at one of its cells.
    if (mesh_.support[v].dim != 2 || mesh_.vertex_cell[v] != c || !find_star(mesh_, v, star)) continue;
    const int n = star.count;
    bool opened = false;
    for (int first = 0; first < n && !opened; ++first)
      for (int turned = 2; 2 * turned <= n && !opened; ++turned) {
        if (2 * turned == n && first >= turned) continue;
        const int last = first + turned;
        const VertexId a = around(mesh_, star.cell[first], star.place[first] + 1);
        const VertexId b = around(mesh_, star.cell[last % n], star.place[last % n] + 1);
        const int excess =
            square(n - turned - 3) + square(turned - 3) - square(n - 4) + outlook_.excess(a, 1) + outlook_.excess(b, 1);
        if (excess > kMostExcessOpened) continue;
        const double allowed = allowance(cell_bonus);
        if (hopeless(outlook_.opening(star, first, last, excess, allowed)) ||
            !plan_opening(mesh_, v, star, first, last, trial_.cavity))
          continue;
        opened = attempt(Operator::open, allowed);
      }
  }
}

void LocalSearch::try_boundary_collapses(CellId c) {
  for (int i = 0; i < 4 && mesh_.alive(c); ++i) {
    // Each vertex at the cell after it along the boundary.
    const VertexId v = around(mesh_, c, i);
    OrderedStar star;
    if (twin_of_side(mesh_, c, i) >= 0 || mesh_.support[v].dim != 1 || !find_star(mesh_, v, star) || star.count != 2) continue;
    const VertexId a = around(mesh_, star.cell[1], star.place[1] + 3), b = around(mesh_, c, i + 1), p = around(mesh_, c, i + 3);
    const int ideal = std::min(trial_.ideal(a), trial_.ideal(b)), n_a = outlook_.valence(a), n_b = outlook_.valence(b);
    if (square(n_a + n_b - 1 - ideal) - square(n_a - trial_.ideal(a)) - square(n_b - trial_.ideal(b)) +
            outlook_.excess(p, -1) >
        kMostExcess)
      continue;
    if (!plan_boundary_collapse(mesh_, v, trial_.cavity)) continue;
    if (attempt(Operator::boundary_collapse, allowance(-cell_bonus))) return;
  }
}

void LocalSearch::try_boundary_openings(CellId c) {
  for (int i = 0; i < 4 && mesh_.alive(c); ++i) {
    const VertexId v = around(mesh_, c, i);
    const int dim = mesh_.support[v].dim;
    OrderedStar star;
    if (dim > 1 || !find_star(mesh_, v, star)) continue;
    int at = 0;
    while (star.cell[at] != c) ++at;
    const int before = at + 1, after = star.count - at;
    for (int turned = 0; turned < (dim == 0 ? 2 : 1); ++turned) {
      const int ideal_a = dim == 0 && turned == 0 ? trial_.ideal(v) : 2, ideal_b = dim == 0 && turned == 1 ? trial_.ideal(v) : 2;
      if (square(after - ideal_a) + square(before - ideal_b) - square(star.count - trial_.ideal(v)) +
              outlook_.excess(around(mesh_, c, i + 2), 1) >
          kMostExcess)
        continue;
      if (!plan_boundary_opening(mesh_, c, i, turned == 1, trial_.cavity)) continue;
      if (attempt(Operator::boundary_open, allowance(cell_bonus))) return;
    }
  }
}

/// Of the cells from c on that a chord goes through which enters c through `side`.
void LocalSearch::try_partial_collapses(CellId c, int side) {
  part_.clear();
  double rungs = 0.0, sides = 0.0;
  const VertexId left = around(mesh_, c, side), right = around(mesh_, c, side + 1);
  for (CellId at = c;;) {
    part_.push_back({at, side});
    const int cells = static_cast<int>(part_.size());
    sides += 0.5 * (trial_.relocator.edge(at, side + 1).l + trial_.relocator.edge(at, side + 3).l);
    for (int way = 0; way < 2 && cells > 1; ++way) {
      const int excess = outlook_.excess(way == 0 ? left : right, -1) + outlook_.excess(around(mesh_, at, side + 2 + way), -1) + 2;
      if (excess > kMostExcess) continue;
      const double allowed = allowance(-2.0 * cell_bonus * cells);
      if (hopeless(Outlook::partial_collapse(cells, excess, allowed, rungs / (cells - 1), sides / cells)) ||
          !plan_partial_chord_collapse(mesh_, part_, way, trial_.cavity))
        continue;
      if (attempt(Operator::partial_chord_collapse, allowed)) return;
    }
    const HalfFacetId twin = twin_of_side(mesh_, at, side + 2);
    if (cells == kLongestPart || twin < 0) return;
    rungs += trial_.relocator.edge(at, side + 2).l;
    at = mesh_.cell_of(twin);
    side = kFacetSide[mesh_.facet_of(twin)];
  }
}

/// Of the paths along `side` of cell c and straight on through regular vertices.
void LocalSearch::try_partial_splits(CellId c, int side) {
  path_ = {around(mesh_, c, side), around(mesh_, c, side + 1)};
  double along = trial_.relocator.edge(c, side).l, across = 0.0;
  for (CellId at = c; static_cast<int>(path_.size()) <= kLongestPart + 1;) {
    if (mesh_.support[path_.back()].dim != 2 || outlook_.valence(path_.back()) != 4) return;
    across += 0.5 * trial_.relocator.edge(at, side + 1).l;
    const HalfFacetId ahead = twin_of_side(mesh_, at, side + 1);
    at = mesh_.cell_of(ahead);
    side = kFacetSide[mesh_.facet_of(ahead)] + 1;
    along += trial_.relocator.edge(at, side).l;
    const HalfFacetId beside = twin_of_side(mesh_, at, side);
    across += 0.5 * trial_.relocator.edge(mesh_.cell_of(beside), kFacetSide[mesh_.facet_of(beside)] + 1).l;
    path_.push_back(around(mesh_, at, side + 1));
    const int edges = static_cast<int>(path_.size()) - 1;
    const int excess = outlook_.excess(path_.front(), 1) + outlook_.excess(path_.back(), 1) + 2;
    for (int way = 0; way < 2 && edges > 2 && excess <= kMostExcess; ++way) {
      const double allowed = allowance(2.0 * cell_bonus * (edges - 1));
      if (hopeless(Outlook::partial_split(edges, excess, allowed, across / (edges - 1), along / edges)) ||
          !plan_partial_chord_split(mesh_, path_, way, trial_.cavity))
        continue;
      if (attempt(Operator::partial_chord_split, allowed)) return;
    }
  }
}

/// By how much the energy is expected to fall when chord_ is collapsed (> 0), or split (< 0), and all rows beside it
/// share what is gained: 0 when neither pays.
///
/// N rows of width l and cells of length m cost N e(l, m); with N l = W held, d(N e) / dN = e - l de/dl = m (l^3 - 1/l),
/// and the second derivative is 4 m / N near l = 1. N is the number of cells of a chord across this one.
double LocalSearch::chord_gain() {
  double first = 0.0, second = 0.0;
  for (const auto& [cell, side] : chord_.cells) {
    const double l = 0.5 * (trial_.relocator.edge(cell, side).l + trial_.relocator.edge(cell, side + 2).l);
    const double m = 0.5 * (trial_.relocator.edge(cell, side + 1).l + trial_.relocator.edge(cell, side + 3).l);
    first += m * (1.0 / l - l * l * l);
    second += 2.0 * m;
  }
  // Where the rows across are too wide together, and not this one alone: else it takes its share from them anyway.
  const ChordCell middle = chord_.cells[chord_.cells.size() / 2];
  find_chord(mesh_, middle.cell, middle.side + 1, marks_, across_);
  double width = 0.0;
  for (const auto& [cell, side] : across_.cells)
    width += 0.5 * (trial_.relocator.edge(cell, side + 1).l + trial_.relocator.edge(cell, side + 3).l);
  const double rows = static_cast<double>(across_.cells.size());
  second /= rows;
  if (first > second && width < rows - 0.5) return first - second;
  return first < -second && width > rows + 0.5 ? first + second : 0.0;
}

/// With the rows beside it; when that is not enough, and the mesh has come to rest, with all rows.
bool LocalSearch::attempt_chord(Operator op) {
  const auto plan = [&] {
    return op == Operator::chord_split ? plan_chord_split(mesh_, chord_, trial_.cavity)
                                       : plan_chord_collapse(mesh_, chord_, trial_.cavity);
  };
  if (!plan()) return false;
  if (trial_.attempt(op, -kNoise)) return true;
  const bool enough =
      refused_at_large_ == kRefusedAtLarge || attempts_at_large_ >= most_attempts_at_large(mesh_.cell_count());
  if (temperature_ > 0.0 || enough || !plan()) return false;
  ++attempts_at_large_;
  if (trial_.attempt_at_large(op, -kNoise)) return true;
  ++refused_at_large_;
  return false;
}

std::int64_t LocalSearch::chord_pass(double least_gain) {
  std::int64_t kept = 0;
  std::vector<std::uint8_t> seen(mesh_.cells.size(), 0);  // bit per axis
  for (CellId c = 0; c < mesh_.cell_count(); ++c)
    for (int axis = 0; axis < 2; ++axis) {
      if (!mesh_.alive(c)) continue;
      seen.resize(mesh_.cells.size(), 3);
      if (seen[c] & (1 << axis)) continue;
      marks_.resize(mesh_.cells.size(), 0);
      find_chord(mesh_, c, axis, marks_, chord_);
      for (const auto& [cell, side] : chord_.cells) seen[cell] |= static_cast<std::uint8_t>(1 << (side & 1));
      const double gain = chord_gain() / static_cast<double>(chord_.cells.size());
      if (gain > least_gain && attempt_chord(Operator::chord_collapse)) ++kept;
      if (gain < -least_gain && attempt_chord(Operator::chord_split)) ++kept;
    }
  return kept;
}

}  // namespace pillowmesh
