#include "pillowmesh/metric/gradation.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "pillowmesh/mesh/portable_math.h"
#include "pillowmesh/metric/intersection.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

constexpr double kTolerance = 0.01;  ///< of M: half of it in sizes
constexpr int kMostChanges = 200;

double eighth_root(double x) { return std::sqrt(std::sqrt(std::sqrt(x))); }

template <int Dim>
class Gradation {
 public:
  Gradation(NodalMetric<Dim>& metric, double growth)
      : metric_(metric), log_growth_(portable::log(growth)), changes_(metric.points.size(), 0) {
    find_neighbours();
    for (const SymTensor<Dim>& M : metric_.tensors) most_ = std::max(most_, spectrum(M).value[Dim - 1]);
  }

  std::int64_t run() {
    std::int64_t total = 0;
    for (VertexId v = 0; v < static_cast<VertexId>(changes_.size()); ++v) push(v);
    for (bool again = true; again;) {
      while (!queue_.empty()) {
        const auto [density, v] = queue_.top();
        queue_.pop();
        if (density == determinant(metric_.tensors[v]))
          total += spread(v, true);  // else it waits elsewhere as it is now
      }
      // Intersections are rounded: what was met before may be missed by a hair since.
      again = false;
      for (VertexId v = 0; v < static_cast<VertexId>(changes_.size()); ++v) {
        if (spread(v, false) == 0) continue;
        push(v);
        again = true;
      }
    }
    return total;
  }

 private:
  void find_neighbours() {
    std::vector<std::array<VertexId, 2>> pairs;
    pairs.reserve(metric_.simplices.size() * Dim * (Dim + 1));
    for (const Simplex<Dim>& s : metric_.simplices)
      for (const VertexId a : s)
        for (const VertexId b : s)
          if (a != b) pairs.push_back({a, b});
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    first_.assign(metric_.points.size() + 1, 0);
    for (const auto& [a, b] : pairs) {
      ++first_[a + 1];
      neighbours_.push_back(b);
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  }

  void push(VertexId v) { queue_.push({determinant(metric_.tensors[v]), v}); }

  /// The metric at v grown along the edge to another vertex.
  SymTensor<Dim> grown(const Spectrum<Dim>& at_v, VertexId v, const Point<Dim>& edge) const {
    double square = 0.0;
    for (int d = 0; d < Dim; ++d) square += edge[d] * edge[d];
    const double length = std::sqrt(dot(metric_.tensors[v], edge, edge)), euclidean = std::sqrt(square);
    const double in_metric = 1.0 + length * log_growth_;
    const double common = in_metric / eighth_root(in_metric);
    Spectrum<Dim> s = at_v;
    for (double& value : s.value) {
      const double factor = common * eighth_root(1.0 + std::sqrt(value) * euclidean * log_growth_);
      value /= factor * factor;
    }
    return compose(s);
  }

  /// A metric that is at least A and N, no finer than the finest of the input.
  SymTensor<Dim> join(const SymTensor<Dim>& A, const SymTensor<Dim>& N) const {
    const SymTensor<Dim> both = intersect(A, N);
    Spectrum<Dim> s = spectrum(both);
    if (s.value[Dim - 1] <= most_) return both;
    for (double& v : s.value) v = std::min(v, most_);
    const SymTensor<Dim> cut = compose(s);
    if (dominated(A, (1.0 + 1e-6) * cut) && dominated(N, (1.0 + 0.5 * kTolerance) * cut)) return cut;
    return SymTensor<Dim>::isotropic(1.0 / std::sqrt(most_));
  }

  /// \return the number of neighbours that v's metric is too fine for; changes them if asked to.
  int spread(VertexId v, bool change) {
    const Spectrum<Dim> at_v = spectrum(metric_.tensors[v]);
    int count = 0;
    for (Index k = first_[v]; k < first_[v + 1]; ++k) {
      const VertexId w = neighbours_[k];
      SymTensor<Dim>& M = metric_.tensors[w];
      if (changes_[w] > kMostChanges) continue;
      const SymTensor<Dim> least = grown(at_v, v, metric_.points[w] - metric_.points[v]);
      if (dominated(least, (1.0 + kTolerance) * M)) continue;
      ++count;
      if (!change) continue;
      M = ++changes_[w] > kMostChanges ? SymTensor<Dim>::isotropic(1.0 / std::sqrt(most_)) : join(M, least);
      push(w);
    }
    return count;
  }

  struct Waiting {
    double density;
    VertexId vertex;
    bool operator<(const Waiting& o) const { return density != o.density ? density < o.density : vertex > o.vertex; }
  };

  NodalMetric<Dim>& metric_;
  double log_growth_;
  double most_ = 0.0;
  std::vector<int> changes_;
  std::vector<Index> first_;
  std::vector<VertexId> neighbours_;
  std::priority_queue<Waiting> queue_;
};

}  // namespace

template <int Dim>
std::int64_t limit_gradation(NodalMetric<Dim>& metric, double growth) {
  return Gradation<Dim>(metric, growth).run();
}

template std::int64_t limit_gradation(NodalMetric<2>&, double);
template std::int64_t limit_gradation(NodalMetric<3>&, double);

}  // namespace pillowmesh
