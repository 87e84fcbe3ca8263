// What edges and cells cost, measured and taken back: the caches of QuadRelocator.
#include "pillowmesh/smooth/quad_relocate.h"

#include <algorithm>

namespace pillowmesh {

namespace {

/// The contents do not matter. With room for a few more: to double would be half of the memory of large meshes.
template <class T>
void renew(std::vector<T>& v, std::size_t size) {
  if (size > v.capacity()) {
    std::vector<T>().swap(v);
    v.reserve(size + size / 16);
  }
  v.resize(size);
}

}  // namespace

QuadRelocator::QuadRelocator(Mesh<2>& mesh, Background& background, const Weights& weights)
    : mesh_(mesh), background_(background) {
  measure_all(weights);
}

void QuadRelocator::measure_all(const Weights& weights) {
  weights_ = weights;
  renew(size_, mesh_.points.size());
  leaf_.resize(mesh_.points.size(), kNone);
  renew(edges_, mesh_.cells.size());
  energy_.assign(mesh_.cells.size(), 0.0);
  begin_for_good();
  for (VertexId v = 0; v < mesh_.vertex_count(); ++v)
    if (mesh_.vertex_cell[v] != kNone) size_[v] = jet_of(background_.jet(mesh_.points[v], leaf_[v]));
  for (CellId c = 0; c < mesh_.cell_count(); ++c)
    if (mesh_.alive(c)) measure_cell(c);
  begin();
}

double QuadRelocator::total_energy() const {
  double sum = 0.0;
  for (CellId c = 0; c < mesh_.cell_count(); ++c)
    if (mesh_.alive(c)) sum += energy_[c];
  return sum;
}

double QuadRelocator::misalignment() const {
  double sum = 0.0;
  std::int64_t count = 0;
  for (CellId c = 0; c < mesh_.cell_count(); ++c) {
    if (!mesh_.alive(c)) continue;
    for (const EdgeTerm& e : edges_[c]) {
      const double t = e.g11 + e.g22;  // the ratio of sizes and its reciprocal
      if (!(t > 2.5)) continue;
      sum += e.s / (1.0 - 4.0 / (t * t));
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

QuadRelocator::Indicators QuadRelocator::indicators() const {
  double sum = 0.0, squares = 0.0, sides = 0.0, lack = 0.0, cells = 0.0;
  for (CellId c = 0; c < mesh_.cell_count(); ++c) {
    if (!mesh_.alive(c)) continue;
    for (int i = 0; i < 4; ++i) {
      const double l = edges_[c][i].l, share = twin_of_side(mesh_, c, i) < 0 ? 1.0 : 0.5;  // other edges come twice
      sum += share * l, squares += share * l * l, sides += share;
    }
    lack += 1.0 - std::sqrt(std::max(least_squared_shape(c), 0.0));
    cells += 1.0;
  }
  if (cells == 0.0) return {};
  const double mean = sum / sides;
  return {std::sqrt(std::max(0.0, squares / sides - mean * mean)) / mean, lack / cells, misalignment()};
}

/// Of its corners, at the most 1.
double QuadRelocator::least_squared_shape(CellId c) const {
  double least = 1.0;
  for (int i = 0; i < 2; ++i) {
    const VertexId a = around(mesh_, c, i + 1), b = around(mesh_, c, i + 3);  // opposite to the corners i and i + 2
    const double d = length(mesh_.points[a], size_[a], mesh_.points[b], size_[b]);
    for (const int k : {i, i + 2}) {
      const double l = edges_[c][k].l, m = edges_[c][(k + 3) & 3].l;
      least = std::min(least, squared_shape(l * l, m * m, d * d));
    }
  }
  return least;
}

std::vector<CellId> QuadRelocator::cells_below(double eta) const {
  std::vector<CellId> found;
  for (CellId c = 0; c < mesh_.cell_count(); ++c)
    if (mesh_.alive(c) && least_squared_shape(c) < eta * eta) found.push_back(c);
  return found;
}

void QuadRelocator::set_alignment(double alignment) {
  weights_.alignment = alignment;
  begin_for_good();
  for (CellId c = 0; c < mesh_.cell_count(); ++c)
    if (mesh_.alive(c)) refresh(c);
  begin();
}

void QuadRelocator::begin_for_good() {
  begin();
  for_good_ = true;
}

void QuadRelocator::begin() {
  for_good_ = false;
  cell_stamp_.resize(mesh_.cells.size(), 0);
  vertex_stamp_.resize(mesh_.points.size(), 0);
  ++stamp_;
  old_cells_.clear();
  old_edges_.clear();
  old_energy_.clear();
  old_vertices_.clear();
  old_sizes_.clear();
}

void QuadRelocator::undo() {
  for (std::size_t i = 0; i < old_cells_.size(); ++i) {
    edges_[old_cells_[i]] = old_edges_[i];
    energy_[old_cells_[i]] = old_energy_[i];
  }
  for (std::size_t i = 0; i < old_vertices_.size(); ++i) size_[old_vertices_[i]] = old_sizes_[i];
}

void QuadRelocator::touch_cell(CellId c) {
  if (for_good_ || c >= static_cast<CellId>(cell_stamp_.size()) || cell_stamp_[c] == stamp_) return;
  cell_stamp_[c] = stamp_;
  old_cells_.push_back(c);
  old_edges_.push_back(edges_[c]);
  old_energy_.push_back(energy_[c]);
}

void QuadRelocator::touch_vertex(VertexId v) {
  if (for_good_ || v >= static_cast<VertexId>(vertex_stamp_.size()) || vertex_stamp_[v] == stamp_) return;
  vertex_stamp_[v] = stamp_;
  old_vertices_.push_back(v);
  old_sizes_.push_back(size_[v]);
}

void QuadRelocator::measure_vertex(VertexId v) {
  if (v >= static_cast<VertexId>(size_.size())) {
    size_.resize(mesh_.points.size());
    leaf_.resize(mesh_.points.size(), kNone);
  }
  touch_vertex(v);
  size_[v] = jet_of(background_.jet(mesh_.points[v], leaf_[v]));
}

double QuadRelocator::measure_cell(CellId c) {
  if (c >= static_cast<CellId>(energy_.size())) {
    energy_.resize(mesh_.cells.size(), 0.0);
    edges_.resize(mesh_.cells.size());
  }
  touch_cell(c);
  place_sides(c);
  for (int i = 0; i < 4; ++i) {
    const Jet& j = size_[around(mesh_, c, i)];
    sides_.jet.set(i, j);
    sides_.jet.set(i + 4, j);
  }
  const Index leaf = leaf_[mesh_.cells[c][0]];
#if defined(PILLOWMESH_WIDE)
  if (kWide)
    wide_measure_sides(leaf);
  else
#endif
    measure_sides<Pair>(leaf);
  for (int i = 0; i < 4; ++i) {
    edges_[c][i] = sides_.term.get(i);
    sides_.term.copy(i, i + 4);
  }
  return energy_[c] = add_up(c);
}

void QuadRelocator::place_sides(CellId c) {
  for (int i = 0; i < 4; ++i) {
    const Point<2>& p = mesh_.points[around(mesh_, c, i)];
    sides_.px[i] = sides_.px[i + 4] = p[0];
    sides_.py[i] = sides_.py[i + 4] = p[1];
  }
  for (int i = 0; i < 4; ++i) {
    sides_.ex[i] = sides_.ex[i + 4] = sides_.px[i + 1] - sides_.px[i];
    sides_.ey[i] = sides_.ey[i + 4] = sides_.py[i + 1] - sides_.py[i];
  }
}

template <class R>
void QuadRelocator::measure_sides(Index leaf) {
  for (int k = 0; k < 4; k += kWidth<R>)
    sides_.term.store_lanes(k, edge_term<R>(background_, leaf, weights_.rough, load<R>(&sides_.px[k]), load<R>(&sides_.py[k]),
                                            load<R>(&sides_.ex[k]), load<R>(&sides_.ey[k]), sides_.jet.lanes<R>(k),
                                            sides_.jet.lanes<R>(k + 1)));
}

template <class R>
double QuadRelocator::sum_of_cell() const {
  double sum = 0.0;
  for (int k = 0; k < 4; k += kWidth<R>) {
    const R e1x = load<R>(&sides_.ex[k]), e1y = load<R>(&sides_.ey[k]), e2x = -load<R>(&sides_.ex[k + 3]),
            e2y = -load<R>(&sides_.ey[k + 3]);
    const R E = corner_energy<R>(e1x * e2y - e1y * e2x, e1x, e1y, sides_.term.lanes<R>(k), e2x, e2y, sides_.term.lanes<R>(k + 3),
                                 weights_);
    for (int i = 0; i < kWidth<R>; ++i) sum += E[i];
  }
  return sum;
}

#if defined(PILLOWMESH_WIDE)
PILLOWMESH_WIDE void QuadRelocator::wide_measure_sides(Index leaf) { measure_sides<Four>(leaf); }
PILLOWMESH_WIDE double QuadRelocator::wide_sum_of_cell() const { return sum_of_cell<Four>(); }
#endif

/// Energy of the cell whose sides are in place, with their terms.
double QuadRelocator::add_up(CellId c) const {
  const Sides& s = sides_;
  if (weights_.delta == 0.0)
    for (int i = 0; i < 4; ++i)
      if (!(s.ex[i] * -s.ey[i + 3] + s.ey[i] * s.ex[i + 3] > 0)) return std::numeric_limits<double>::infinity();
#if defined(PILLOWMESH_WIDE)
  double sum = kWide ? wide_sum_of_cell() : sum_of_cell<Pair>();
#else
  double sum = sum_of_cell<Pair>();
#endif
  if (!shaped()) return sum;
  std::array<Point<2>, 4> p;
  std::array<Jet, 4> H;
  for (int i = 0; i < 4; ++i) p[i] = {s.px[i], s.py[i]}, H[i] = size_[around(mesh_, c, i)];
  const std::array<double, 2> across{length(p[1], H[1], p[3], H[3]), length(p[0], H[0], p[2], H[2])};
  for (int i = 0; i < 4; ++i) sum += shape_energy(s.term.l[i], s.term.l[i + 3], across[i & 1], weights_);
  return sum;
}

double QuadRelocator::length(const Point<2>& p, const Jet& P, const Point<2>& q, const Jet& Q) const {
  const Point<2> e = q - p;
  Index leaf = kNone;
  return edge_term(background_, leaf, weights_.rough, p[0], p[1], e[0], e[1], P, Q).l;
}

void QuadRelocator::refresh(CellId c) {
  touch_cell(c);
  place_sides(c);
  for (int i = 0; i < 4; ++i) {
    sides_.term.set(i, edges_[c][i]);
    sides_.term.set(i + 4, edges_[c][i]);
  }
  energy_[c] = add_up(c);
}

double QuadRelocator::refresh_changed() {
  double largest = 0.0;
  const auto refresh_one = [&](CellId c) {
    if (!mesh_.alive(c)) return;
    refresh(c);
    largest = std::max(largest, energy_[c]);
  };
  for (const CellId c : old_cells_) refresh_one(c);
  for (CellId c = static_cast<CellId>(cell_stamp_.size()); c < mesh_.cell_count(); ++c) refresh_one(c);
  return largest;
}

double QuadRelocator::longest_changed() const {
  double longest = 0.0;
  const auto look = [&](CellId c) {
    if (!mesh_.alive(c)) return;
    for (const EdgeTerm& e : edges_[c]) longest = std::max(longest, e.l);
  };
  for (const CellId c : old_cells_) look(c);
  for (CellId c = static_cast<CellId>(cell_stamp_.size()); c < mesh_.cell_count(); ++c) look(c);
  return longest;
}

void QuadRelocator::forget_cell(CellId c) {
  touch_cell(c);
  energy_[c] = 0.0;
}

double QuadRelocator::change() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < old_cells_.size(); ++i) sum += energy_[old_cells_[i]] - old_energy_[i];
  for (std::size_t c = cell_stamp_.size(); c < mesh_.cells.size(); ++c) sum += energy_[c];
  return sum;
}

}  // namespace pillowmesh
