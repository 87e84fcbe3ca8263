#include "pillowmesh/refine/untangle.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/refine/untangle_energy.h"

namespace pillowmesh {
namespace {

constexpr int memory = 10;          ///< steps that the descent direction remembers
constexpr int most_rounds = 40;     ///< values of eps
constexpr int steps_per_round = 30;

template <int Dim>
class Untangler {
 public:
  Untangler(Mesh<Dim>& mesh, const TangledPatch<Dim>& patch, double floor, std::int64_t& work_left)
      : mesh_(mesh),
        patch_(patch),
        floor_(floor),
        work_left_(work_left),
        energy_(mesh, patch),
        n_(patch.free.size()) {}

  bool run() {
    PatchEnergy now = evaluate(1.0, nullptr);
    double eps = std::max(0.05, now.lowest < 0 ? -now.lowest : 0.0);
    int stuck = 0;
    for (int round = 0; round < most_rounds && work_left_ > 0; ++round) {
      const double before = evaluate(eps, nullptr).value;
      now = descend(eps);
      if (now.lowest > 0) {
        const Verdict verdict = judge();
        if (verdict == Verdict::good) return true;
        if (verdict == Verdict::inverted_inside && !energy_.looks_inside()) {
          energy_.look_inside();
          now = evaluate(1.0, nullptr);
          eps = std::max(0.05, now.lowest < 0 ? -now.lowest : 0.0);
          continue;
        }
      }
      // The next eps: such that the lowest chi falls by as much as the energy did, a tenth at least.
      const double decrease = std::max(1.0 - now.value / before, 0.1);
      const double root = std::sqrt(now.lowest * now.lowest + eps * eps);
      const double chi = now.lowest > 0 ? 0.5 * (now.lowest + root) : 0.5 * eps * eps / (root - now.lowest);
      const double mu = (1.0 - decrease) * chi;
      eps = mu > now.lowest ? std::max(1e-9, 2.0 * std::sqrt(mu * (mu - now.lowest))) : 1e-9;
      stuck = 1.0 - now.value / before < 1e-3 ? stuck + 1 : 0;
      if (stuck == 3 && eps < 1e-3) return false;
    }
    return false;
  }

 private:
  PatchEnergy evaluate(double eps, std::vector<Point<Dim>>* gradient) {
    work_left_ -= static_cast<std::int64_t>(patch_.cells.size());
    return energy_.evaluate(eps, gradient);
  }

  enum class Verdict { good, inverted, inverted_inside, below_floor };

  Verdict judge() const {
    Verdict verdict = Verdict::good;
    for (std::size_t i = 0; i < patch_.cells.size(); ++i) {
      const CellId c = patch_.cells[i];
      if (!(min_corner_jacobian(mesh_, c) > 0)) return Verdict::inverted;
      const auto form = [&](int k) -> const Point<Dim>& { return patch_.shapes[i][k]; };
      // Above the floor, or no worse than it came.
      if (floor_ > 0 && !(min_scaled_jacobian(mesh_, c) > std::min(floor_, min_scaled_jacobian<Dim>(form))))
        verdict = Verdict::below_floor;
      if constexpr (Dim == 3) {
        const auto now = [&](int k) -> const Point<3>& { return mesh_.points[mesh_.cells[c][k]]; };
        if (!(min_lattice_jacobian(now) > 0) && min_lattice_jacobian(form) > 0) return Verdict::inverted_inside;
      }
    }
    return verdict;
  }

  /// L-BFGS in coordinates that are scaled by the size of the cells around each vertex.
  PatchEnergy descend(double eps) {
    history_.clear();
    PatchEnergy now = evaluate(eps, &gradient_);
    to_tangent();
    double recent = now.value;
    for (int step = 0; step < steps_per_round && work_left_ > 0; ++step) {
      find_direction();
      if (!line_search(eps, now)) {
        if (history_.empty()) break;
        history_.clear();
        continue;
      }
      if (step % 5 == 4) {
        if (now.value > (1 - 1e-3) * recent) break;
        recent = now.value;
      }
    }
    return now;
  }

  /// Scales the gradient, and takes off what points out of a boundary vertex's curve or patch.
  void to_tangent() {
    for (std::size_t i = 0; i < n_; ++i) {
      const VertexId v = patch_.free[i];
      Point<Dim>& slope = gradient_[i];
      slope *= energy_.size(i);
      const VertexSupport support = mesh_.support[v];
      if (support.dim == Dim) continue;
      const auto along = tangents(mesh_, v);
      if (support.dim == 1) {
        slope = (slope.dot(along[0]) / along[0].squaredNorm()) * along[0];
      } else if constexpr (Dim == 3) {
        const Point<3> normal = vector_product(along[0], along[1]);
        slope -= (slope.dot(normal) / normal.squaredNorm()) * normal;
      }
    }
  }

  double inner(const std::vector<Point<Dim>>& a, const std::vector<Point<Dim>>& b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < n_; ++i) sum += a[i].dot(b[i]);
    return sum;
  }

  void find_direction() {
    direction_ = gradient_;
    std::array<double, memory> alpha{};
    for (std::size_t k = history_.size(); k-- > 0;) {
      alpha[k] = inner(history_[k].move, direction_) / history_[k].product;
      for (std::size_t i = 0; i < n_; ++i) direction_[i] -= alpha[k] * history_[k].turn[i];
    }
    if (!history_.empty()) {
      const auto& last = history_.back();
      const double scale = last.product / inner(last.turn, last.turn);
      for (std::size_t i = 0; i < n_; ++i) direction_[i] *= scale;
    }
    for (std::size_t k = 0; k < history_.size(); ++k) {
      const double beta = inner(history_[k].turn, direction_) / history_[k].product;
      for (std::size_t i = 0; i < n_; ++i) direction_[i] += (alpha[k] - beta) * history_[k].move[i];
    }
  }

  /// Steps along -direction_ until the energy has fallen enough. False if it does not.
  bool line_search(double eps, PatchEnergy& now) {
    double longest = 0.0, slope = inner(gradient_, direction_);
    if (!(slope > 0)) return false;
    for (std::size_t i = 0; i < n_; ++i) longest = std::max(longest, direction_[i].squaredNorm());
    longest = std::sqrt(longest);
    // No vertex by more than its cells' size; without a memory a tenth of that.
    const double most = history_.empty() ? 0.1 : 0.7;
    double t = history_.empty() ? most / longest : std::min(1.0, most / longest);
    from_.resize(n_);
    anchors_.resize(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      from_[i] = mesh_.points[patch_.free[i]];
      anchors_[i] = mesh_.anchor[patch_.free[i]];
    }
    old_gradient_ = gradient_;
    for (int attempt = 0; attempt < 15; ++attempt) {
      move_.resize(n_);
      for (std::size_t i = 0; i < n_; ++i) {
        const VertexId v = patch_.free[i];
        mesh_.anchor[v] = anchors_[i];
        mesh_.points[v] = slide(*mesh_.geometry, mesh_.support[v], mesh_.anchor[v],
                                Point<Dim>(from_[i] - (t * energy_.size(i)) * direction_[i]));
        if (mesh_.support[v].dim < Dim) keep_off_end(i);
        move_[i] = (mesh_.points[v] - from_[i]) / energy_.size(i);
      }
      const PatchEnergy there = evaluate(eps, &gradient_);
      if (there.value < now.value - 1e-4 * t * slope) {
        now = there;
        to_tangent();
        remember();
        return true;
      }
      // The lowest point of the parabola through both values and the slope.
      const double bend = 2 * (there.value - now.value + t * slope);
      const double best = bend > 0 ? slope * t / bend : 0.5;
      t *= std::min(std::max(best, 0.1), 0.5);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      mesh_.points[patch_.free[i]] = from_[i];
      mesh_.anchor[patch_.free[i]] = anchors_[i];
    }
    gradient_ = old_gradient_;
    return false;
  }

  /// Distance of a boundary vertex from the end of its curve or patch, where that is an end of the piece that it is on.
  double distance_to_end(VertexId v, const Point<Dim>& at) const {
    const Geometry<Dim>& g = *mesh_.geometry;
    const Index piece = mesh_.anchor[v];
    double nearest2 = INFINITY;
    const auto consider = [&](Index a, Index b) {
      const Point<Dim> along = g.points[b] - g.points[a];
      const double length2 = along.squaredNorm();
      const double t = length2 > 0 ? along.dot(at - g.points[a]) / length2 : 0.0;
      nearest2 = std::min(nearest2, (at - g.points[a] - std::min(std::max(t, 0.0), 1.0) * along).squaredNorm());
    };
    if (mesh_.support[v].dim == 1) {
      for (int end = 0; end < 2; ++end) {
        const Index last = Dim == 2 ? g.facets[piece][end] : g.segments[piece][end];
        if ((Dim == 2 ? g.neighbours[piece][end] : g.segment_neighbours[piece][end]) == kNone) consider(last, last);
      }
    } else {
      for (int side = 0; side < Geometry<Dim>::facet_sides; ++side)
        if (g.neighbours[piece][side] == kNone)
          consider(g.facets[piece][Cell<2>::facet_corner(side, 0)], g.facets[piece][Cell<2>::facet_corner(side, 1)]);
    }
    return std::sqrt(nearest2);
  }

  /// A vertex that has come to the end of its curve stays there, since all slopes at an edge of no length vanish: it is
  /// not let nearer than a tenth of its cells' size.
  void keep_off_end(std::size_t i) {
    const VertexId v = patch_.free[i];
    const double distance = distance_to_end(v, mesh_.points[v]);
    if (!(distance < 0.1 * energy_.size(i))) return;
    mesh_.anchor[v] = anchors_[i];
    const bool nearer = distance < distance_to_end(v, from_[i]);
    if (!nearer) {
      mesh_.points[v] = slide(*mesh_.geometry, mesh_.support[v], mesh_.anchor[v], mesh_.points[v]);
      return;
    }
    mesh_.points[v] = from_[i];
  }

  void remember() {
    for (std::size_t i = 0; i < n_; ++i) old_gradient_[i] = gradient_[i] - old_gradient_[i];
    const double product = inner(move_, old_gradient_);
    if (!(product > 1e-12 * std::sqrt(inner(move_, move_) * inner(old_gradient_, old_gradient_)))) return;
    if (history_.size() == memory) {
      std::rotate(history_.begin(), history_.begin() + 1, history_.end());
      history_.pop_back();
    }
    history_.push_back({move_, old_gradient_, product});
  }

  struct Step {
    std::vector<Point<Dim>> move, turn;  ///< of the position and of the gradient
    double product;
  };

  Mesh<Dim>& mesh_;
  const TangledPatch<Dim>& patch_;
  double floor_;
  std::int64_t& work_left_;
  UntangleEnergy<Dim> energy_;
  std::size_t n_;
  std::vector<Point<Dim>> gradient_, old_gradient_, direction_, move_, from_;
  std::vector<Index> anchors_;
  std::vector<Step> history_;
};

}  // namespace

template <int Dim>
void extend(TangledPatch<Dim>& patch, const Mesh<Dim>& mesh, std::span<const VertexId> vertices) {
  std::vector<VertexId> fresh;
  for (const VertexId v : vertices)
    if (mesh.support[v].dim > 0 && !std::binary_search(patch.free.begin(), patch.free.end(), v)) fresh.push_back(v);
  std::sort(fresh.begin(), fresh.end());
  fresh.erase(std::unique(fresh.begin(), fresh.end()), fresh.end());
  std::vector<CellCorner> star;
  std::vector<CellId> cells;
  for (const VertexId v : fresh) {
    vertex_star(mesh, v, star);
    for (const CellCorner& at : star)
      if (!std::binary_search(patch.known.begin(), patch.known.end(), at.cell)) cells.push_back(at.cell);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  for (const CellId c : cells) {
    patch.cells.push_back(c);
    auto& shape = patch.shapes.emplace_back();
    for (int k = 0; k < Cell<Dim>::corners; ++k) shape[k] = mesh.points[mesh.cells[c][k]];
  }
  const auto merge = [](std::vector<Index>& into, const std::vector<Index>& more) {
    const auto middle = static_cast<std::ptrdiff_t>(into.size());
    into.insert(into.end(), more.begin(), more.end());
    std::inplace_merge(into.begin(), into.begin() + middle, into.end());
  };
  merge(patch.known, cells);
  merge(patch.free, fresh);
}

template <int Dim>
bool untangle(Mesh<Dim>& mesh, const TangledPatch<Dim>& patch, double floor, std::int64_t& most_work) {
  return Untangler<Dim>(mesh, patch, floor, most_work).run();
}

template void extend(TangledPatch<2>&, const Mesh<2>&, std::span<const VertexId>);
template void extend(TangledPatch<3>&, const Mesh<3>&, std::span<const VertexId>);
template bool untangle(Mesh<2>&, const TangledPatch<2>&, double, std::int64_t&);
template bool untangle(Mesh<3>&, const TangledPatch<3>&, double, std::int64_t&);

}  // namespace pillowmesh
