#include "pillowmesh/adapt/transfer.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/metric/nodal.h"

namespace pillowmesh {
namespace {

/// Local coordinates in a cell, and how far outside of the unit box they are before being cut off.
template <int Dim>
struct CellPlace {
  CellId cell = kNone;
  std::array<double, Dim> at{};
  double outside2 = INFINITY;  ///< squared distance from the point sought
};

template <int Dim>
double weight(const std::array<double, Dim>& at, int corner) {
  double w = 1.0;
  for (int d = 0; d < Dim; ++d) w *= (corner >> d) & 1 ? at[d] : 1.0 - at[d];
  return w;
}

/// The multilinear map of a cell: position at `at`, and the derivatives.
template <int Dim>
Point<Dim> map(const std::vector<Point<Dim>>& points, const Corners<Dim>& cell, const std::array<double, Dim>& at,
               std::array<Point<Dim>, Dim>& slope) {
  Point<Dim> x = Point<Dim>::Zero();
  slope.fill(x);
  for (int k = 0; k < Cell<Dim>::corners; ++k) {
    const Point<Dim>& p = points[cell[k]];
    x += weight<Dim>(at, k) * p;
    for (int d = 0; d < Dim; ++d) {
      double w = (k >> d) & 1 ? 1.0 : -1.0;
      for (int o = 0; o < Dim; ++o)
        if (o != d) w *= (k >> o) & 1 ? at[o] : 1.0 - at[o];
      slope[d] += w * p;
    }
  }
  return x;
}

double determinant(const std::array<Point<2>, 2>& e) { return cross(e[0], e[1]); }
double determinant(const std::array<Point<3>, 3>& e) { return triple(e[0], e[1], e[2]); }

/// Cramer's rule. \pre the determinant is not 0
template <int Dim>
std::array<double, Dim> solve(const std::array<Point<Dim>, Dim>& columns, const Point<Dim>& right) {
  const double all = determinant(columns);
  std::array<double, Dim> out;
  for (int d = 0; d < Dim; ++d) {
    auto changed = columns;
    changed[d] = right;
    out[d] = determinant(changed) / all;
  }
  return out;
}

template <int Dim>
class Locator {
 public:
  explicit Locator(const Solution<Dim>& from)
      : points_(from.points), cells_(from.cells), simplices_(simplices_of(from)), tree_(from.points, simplices_) {
    // Cells at each vertex.
    first_.assign(points_.size() + 1, 0);
    for (const auto& cell : cells_)
      for (const VertexId v : cell) ++first_[v + 1];
    for (std::size_t v = 0; v < points_.size(); ++v) first_[v + 1] += first_[v];
    at_vertex_.resize(static_cast<std::size_t>(first_.back()));
    auto next = first_;
    for (CellId c = 0; c < static_cast<CellId>(cells_.size()); ++c)
      for (const VertexId v : cells_[c]) at_vertex_[next[v]++] = c;
  }
  [[nodiscard]] bool empty() const { return simplices_.empty(); }

  /// The simplex says where to look: hexahedra whose facets are not flat are not the union of their tetrahedra, but
  /// what contains the point is around one of the vertices.
  CellPlace<Dim> find(const Point<Dim>& p) const {
    const auto near = tree_.nearest(points_, simplices_, p);
    const CellPlace<Dim> place = find_around(near, p);
    if (is_inside(place)) return place;
    Point<Dim> nearest = Point<Dim>::Zero();  // p is outside of all
    for (int k = 0; k <= Dim; ++k) nearest += near.weights[k] * points_[simplices_[near.simplex][k]];
    return find_around(near, nearest);
  }

 private:
  [[nodiscard]] bool is_inside(const CellPlace<Dim>& place) const {
    const auto& cell = cells_[place.cell];
    return place.outside2 <= 1e-24 * (points_[cell[0]] - points_[cell[Cell<Dim>::corners - 1]]).squaredNorm();
  }
  CellPlace<Dim> find_around(const SimplexPlace<Dim>& near, const Point<Dim>& p) const {
    CellPlace<Dim> best;
    for (const bool owner : {true, false}) {
      for (const VertexId v : simplices_[near.simplex])
        for (Index i = first_[v]; i < first_[v + 1]; ++i) {
          const CellId c = at_vertex_[i];
          if (owns(c, simplices_[near.simplex]) != owner) continue;
          const CellPlace<Dim> place = place_in(c, p);
          if (place.outside2 < best.outside2 || (place.outside2 == best.outside2 && c < best.cell)) best = place;
        }
      if (best.cell != kNone && is_inside(best)) break;
    }
    return best;
  }
  static std::vector<Simplex<Dim>> simplices_of(const Solution<Dim>& from) {
    auto all = divide<Dim>(from.points, from.cells);
    std::erase_if(all, [&](const Simplex<Dim>& s) { return !(simplex_determinant<Dim>(from.points, s) != 0.0); });
    return all;
  }
  [[nodiscard]] bool owns(CellId c, const Simplex<Dim>& s) const {
    return std::all_of(s.begin(), s.end(),
                       [&](VertexId v) { return std::find(cells_[c].begin(), cells_[c].end(), v) != cells_[c].end(); });
  }
  /// Newton on the multilinear map, from the middle; then cut off at the cell.
  CellPlace<Dim> place_in(CellId c, const Point<Dim>& p) const {
    CellPlace<Dim> place;
    place.cell = c;
    place.at.fill(0.5);
    std::array<Point<Dim>, Dim> slope;
    for (int i = 0; i < 20; ++i) {
      const Point<Dim> gap = p - map<Dim>(points_, cells_[c], place.at, slope);
      if (determinant(slope) == 0.0) break;
      const auto step = solve<Dim>(slope, gap);
      double longest = 0.0;
      for (int d = 0; d < Dim; ++d) {
        // No farther than a cell beyond: the map may fold there.
        place.at[d] = std::min(std::max(place.at[d] + step[d], -1.0), 2.0);
        longest = std::max(longest, std::abs(step[d]));
      }
      if (longest < 1e-14) break;
    }
    for (double& t : place.at) t = std::min(std::max(t, 0.0), 1.0);
    place.outside2 = (p - map<Dim>(points_, cells_[c], place.at, slope)).squaredNorm();
    return place;
  }

  const std::vector<Point<Dim>>& points_;
  const std::vector<Corners<Dim>>& cells_;
  std::vector<Simplex<Dim>> simplices_;
  SimplexTree<Dim> tree_;
  std::vector<Index> first_, at_vertex_;
};

template <int Dim>
Status check(const Solution<Dim>& from) {
  for (const FieldArray& f : from.fields) {
    const std::size_t count = f.of_cells ? from.cells.size() : from.points.size();
    if (f.components < 1 || f.values.size() != count * static_cast<std::size_t>(f.components))
      return Status::bad_input("the array '" + f.name + "' has " + std::to_string(f.values.size()) + " values, not " +
                               std::to_string(f.components) + " for each of the " + std::to_string(count) +
                               (f.of_cells ? " cells" : " points"));
  }
  return {};
}

}  // namespace

template <int Dim>
Expected<std::vector<FieldArray>> carry(const Solution<Dim>& from, const Mesh<Dim>& to) {
  if (Status s = check(from); !s.ok()) return s;
  const Locator<Dim> locator(from);
  if (locator.empty()) return Status::bad_input("the old mesh has no cell with a volume");
  std::vector<FieldArray> out;
  bool points = false, cells = false;
  for (const FieldArray& f : from.fields) {
    out.push_back({f.name, f.of_cells, f.whole, f.components, {}});
    (f.of_cells ? cells : points) = true;
  }
  for (VertexId v = 0; points && v < to.vertex_count(); ++v) {
    if (to.vertex_cell[v] == kNone) continue;
    const CellPlace<Dim> place = locator.find(to.points[v]);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const FieldArray& f = from.fields[i];
      for (int n = 0; n < f.components && !f.of_cells; ++n) {
        double sum = 0.0, largest = -1.0, there = 0.0;
        for (int k = 0; k < Cell<Dim>::corners; ++k) {
          const double w = weight<Dim>(place.at, k);
          const double value = f.values[static_cast<std::size_t>(from.cells[place.cell][k]) * f.components + n];
          if (w > largest) largest = w, there = value;
          if (w != 0.0) sum += w * value;
        }
        out[i].values.push_back(f.whole ? there : sum);
      }
    }
  }
  constexpr double gauss[3] = {0.1127016653792583, 0.5, 0.8872983346207417}, shares[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  constexpr int samples = Dim == 2 ? 9 : 27;
  for (CellId c = 0; cells && c < to.cell_count(); ++c) {
    if (!to.alive(c)) continue;
    std::array<CellId, samples> inside;
    std::array<double, samples> share;
    double volume = 0.0;
    for (int q = 0; q < samples; ++q) {
      std::array<double, Dim> at;
      share[q] = 1.0;
      for (int d = 0, rest = q; d < Dim; ++d, rest /= 3) {
        at[d] = gauss[rest % 3];
        share[q] *= shares[rest % 3];
      }
      std::array<Point<Dim>, Dim> slope;
      const Point<Dim> x = map<Dim>(to.points, to.cells[c], at, slope);
      share[q] *= std::max(0.0, determinant(slope));
      volume += share[q];
      inside[q] = locator.find(x).cell;
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
      const FieldArray& f = from.fields[i];
      for (int n = 0; n < f.components && f.of_cells; ++n) {
        const auto value = [&](int q) { return f.values[static_cast<std::size_t>(inside[q]) * f.components + n]; };
        double sum = 0.0;
        for (int q = 0; q < samples; ++q) sum += share[q] / volume * value(q);
        out[i].values.push_back(f.whole ? value(samples / 2) : sum);
      }
    }
  }
  return out;
}

std::string_view carried_how(const FieldArray& field) {
  if (field.whole) return field.of_cells ? "the old value at the cell's middle" : "the old value at the nearest vertex";
  return field.of_cells ? "mean over the new cell by 3 Gauss points per axis; constants exact, integrals kept to that rule"
                        : "multilinear interpolation; error at most h^2/8 times the sum of the pure second derivatives, "
                          "h: size of the old cells";
}

template <int Dim>
Solution<Dim> solution_on(const Mesh<Dim>& mesh) {
  Solution<Dim> out;
  std::vector<Index> renumbered(mesh.points.size(), kNone);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.vertex_cell[v] == kNone) continue;
    renumbered[v] = static_cast<Index>(out.points.size());
    out.points.push_back(mesh.points[v]);
  }
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    auto cell = mesh.cells[c];
    for (VertexId& v : cell) v = renumbered[v];
    out.cells.push_back(cell);
  }
  return out;
}

template Expected<std::vector<FieldArray>> carry(const Solution<2>&, const Mesh<2>&);
template Expected<std::vector<FieldArray>> carry(const Solution<3>&, const Mesh<3>&);
template Solution<2> solution_on(const Mesh<2>&);
template Solution<3> solution_on(const Mesh<3>&);

}  // namespace pillowmesh
