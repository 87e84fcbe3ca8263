#include "pillowmesh/metric/sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

template <int Dim>
class Sampling {
 public:
  Sampling(const Evaluate<Dim>& metric, const SampleOptions& options) : metric_(metric), options_(options) {}

  NodalMetric<Dim> run(const Point<Dim>& low, const Point<Dim>& high) {
    make_grid(low, high);
    evaluate_new();
    constexpr int kPasses = 60;
    for (int pass = 0; pass < kPasses && points_.size() < options_.max_points; ++pass) {
      if (!mark()) break;
      close();
      evaluate_new();
    }
    fill();
    NodalMetric<Dim> out{std::move(points_), {}, {}};
    for (const Piece& p : pieces_) out.simplices.push_back(p.vertices);
    for (std::size_t v = 0; v < logs_.size(); ++v)
      out.tensors.push_back(valid_[v] ? exp_tensor(logs_[v]) : SymTensor<Dim>{});
    return out;
  }

 private:
  /// Bisected at the edge from vertex 0 to vertex `tag`.
  struct Piece {
    Simplex<Dim> vertices;
    std::int8_t tag = Dim;
    bool settled = false;
    bool marked = false;
  };

  /// Cubes of Kuhn's simplices: paths along the axes from the lowest corner to the highest.
  void make_grid(const Point<Dim>& low, const Point<Dim>& high) {
    constexpr double kAlong = Dim == 2 ? 32.0 : 10.0;
    double longest = 0.0;
    for (int d = 0; d < Dim; ++d) longest = std::max(longest, high[d] - low[d]);
    const double along = std::clamp(longest / options_.finest_start, kAlong, 8.0 * kAlong);
    std::array<Index, Dim> n;
    std::array<Index, Dim + 1> stride{1};
    for (int d = 0; d < Dim; ++d) {
      n[d] = std::max<Index>(2, static_cast<Index>(std::ceil(along * (high[d] - low[d]) / longest)));
      stride[d + 1] = stride[d] * (n[d] + 1);
    }
    for (Index i = 0; i < stride[Dim]; ++i) {
      Point<Dim> p;
      bool last = false;
      for (int d = 0; d < Dim; ++d) {
        const Index k = i / stride[d] % (n[d] + 1);
        p[d] = low[d] + (high[d] - low[d]) * k / n[d];
        last = last || k == n[d];
      }
      points_.push_back(p);
      if (last) continue;
      std::array<int, Dim> axes;
      std::iota(axes.begin(), axes.end(), 0);
      do {
        Piece piece;
        piece.vertices[0] = i;
        for (int k = 0; k < Dim; ++k) piece.vertices[k + 1] = piece.vertices[k] + stride[axes[k]];
        pieces_.push_back(piece);
      } while (std::next_permutation(axes.begin(), axes.end()));
    }
  }

  void evaluate_new() {
    const std::size_t first = logs_.size();
    std::vector<SymTensor<Dim>> tensors(points_.size() - first);
    metric_(std::span(points_).subspan(first), tensors);
    for (const SymTensor<Dim>& M : tensors) {
      valid_.push_back(positive_definite(M));
      logs_.push_back(valid_.back() ? log_tensor(M) : SymTensor<Dim>{});
    }
  }

  /// Marks the pieces in which interpolation is not good enough. \return whether there are any
  bool mark() {
    constexpr int kEdges = Dim * (Dim + 1) / 2, kProbes = kEdges + 1;
    std::vector<std::size_t> open;
    std::vector<Point<Dim>> probes;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Simplex<Dim>& v = pieces_[i].vertices;
      const bool usable = std::all_of(v.begin(), v.end(), [&](VertexId k) { return valid_[k] != 0; });
      if (pieces_[i].settled || !usable) continue;
      open.push_back(i);
      Point<Dim> centre = Point<Dim>::Zero();
      for (int a = 0; a <= Dim; ++a) {
        centre += points_[v[a]] / (Dim + 1);
        for (int b = a + 1; b <= Dim; ++b) probes.push_back(0.5 * (points_[v[a]] + points_[v[b]]));
      }
      probes.push_back(centre);
    }
    std::vector<SymTensor<Dim>> found(probes.size());
    metric_(probes, found);
    bool any = false;
    for (std::size_t k = 0; k < open.size(); ++k) {
      Piece& piece = pieces_[open[k]];
      const SymTensor<Dim>* M = found.data() + k * kProbes;
      piece.settled = !rough(piece.vertices, M);
      piece.marked = !piece.settled;
      any = any || piece.marked;
    }
    return any;
  }

  bool rough(const Simplex<Dim>& v, const SymTensor<Dim>* M) const {
    bool bad = false;
    double longest = 0.0;
    SymTensor<Dim> mean;
    for (int a = 0; a <= Dim; ++a) {
      mean = mean + (1.0 / (Dim + 1)) * logs_[v[a]];
      for (int b = a + 1; b <= Dim; ++b, ++M) {
        if (!positive_definite(*M)) continue;
        const Point<Dim> e = points_[v[b]] - points_[v[a]];
        longest = std::max(longest, dot(*M, e, e));
        bad = bad || distance(log_tensor(*M), 0.5 * (logs_[v[a]] + logs_[v[b]])) > options_.tolerance;
      }
    }
    bad = bad || (positive_definite(*M) && distance(log_tensor(*M), mean) > options_.tolerance);
    return bad && longest > options_.shortest * options_.shortest;
  }
  static double distance(const SymTensor<Dim>& a, const SymTensor<Dim>& b) {
    double sum = 0.0;
    for (int j = 0; j < Dim; ++j)
      for (int i = 0; i < Dim; ++i) sum += (a(i, j) - b(i, j)) * (a(i, j) - b(i, j));
    return std::sqrt(sum);
  }

  static std::uint64_t key(VertexId a, VertexId b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
  }

  /// Bisects the marked pieces, then those that have a vertex in the middle of an edge, until there are none.
  void close() {
    std::vector<std::uint8_t> touched(points_.size(), 0);  // ends of an edge that was bisected in this call
    for (bool more = true; more;) {
      const std::size_t count = pieces_.size();
      for (std::size_t i = 0; i < count; ++i)
        if (pieces_[i].marked) bisect(i, touched);
      touched.resize(points_.size(), 0);
      more = false;
      for (Piece& p : pieces_) {
        for (int a = 0; a <= Dim && !p.marked; ++a)
          for (int b = a + 1; b <= Dim && touched[p.vertices[a]]; ++b)
            if (touched[p.vertices[b]] && middles_.count(key(p.vertices[a], p.vertices[b])) > 0) p.marked = true;
        more = more || p.marked;
      }
    }
  }

  void bisect(std::size_t i, std::vector<std::uint8_t>& touched) {
    Piece& piece = pieces_[i];
    const int k = piece.tag;
    const VertexId a = piece.vertices[0], b = piece.vertices[k];
    const auto [at, is_new] = middles_.try_emplace(key(a, b), static_cast<VertexId>(points_.size()));
    if (is_new) points_.push_back(0.5 * (points_[a] + points_[b]));
    touched[a] = touched[b] = 1;
    Piece other;
    other.tag = piece.tag = static_cast<std::int8_t>(k > 1 ? k - 1 : Dim);
    piece.settled = piece.marked = false;
    other.vertices = piece.vertices;
    for (int j = 0; j < k; ++j) other.vertices[j] = piece.vertices[j + 1];
    other.vertices[k] = piece.vertices[k] = at->second;
    pieces_.push_back(other);
  }

  /// Gives vertices without a metric the mean of their neighbours', from those that have one outward.
  void fill() {
    const auto count = static_cast<std::size_t>(std::count(valid_.begin(), valid_.end(), 0));
    if (count == 0 || count == valid_.size()) return;
    for (bool more = true; more;) {
      more = false;
      std::vector<SymTensor<Dim>> sum(points_.size());
      std::vector<int> terms(points_.size(), 0);
      for (const Piece& p : pieces_)
        for (const VertexId v : p.vertices)
          for (const VertexId w : p.vertices)
            if (!valid_[v] && valid_[w]) {
              sum[v] = sum[v] + logs_[w];
              ++terms[v];
            }
      for (std::size_t v = 0; v < points_.size(); ++v) {
        if (terms[v] == 0) continue;
        logs_[v] = (1.0 / terms[v]) * sum[v];
        valid_[v] = 1;
        more = true;
      }
    }
  }

  const Evaluate<Dim>& metric_;
  SampleOptions options_;
  std::vector<Point<Dim>> points_;
  std::vector<SymTensor<Dim>> logs_;
  std::vector<std::uint8_t> valid_;
  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, VertexId> middles_;
};

}  // namespace

template <int Dim>
NodalMetric<Dim> sample(const Evaluate<Dim>& metric, const Point<Dim>& low, const Point<Dim>& high,
                        const SampleOptions& options) {
  return Sampling<Dim>(metric, options).run(low, high);
}

template NodalMetric<2> sample(const Evaluate<2>&, const Point<2>&, const Point<2>&, const SampleOptions&);
template NodalMetric<3> sample(const Evaluate<3>&, const Point<3>&, const Point<3>&, const SampleOptions&);

}  // namespace pillowmesh
