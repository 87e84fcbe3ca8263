// recover_hessian of hessian.h: a quadratic fitted to the values around each vertex.
#include <algorithm>
#include <cmath>

#include "pillowmesh/metric/hessian.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

/// Vertex to neighbours, without itself.
struct Adjacency {
  std::vector<Index> first;
  std::vector<VertexId> neighbours;
};

template <int Dim>
Adjacency adjacency_of(std::size_t points, std::span<const Simplex<Dim>> simplices) {
  std::vector<std::array<VertexId, 2>> pairs;
  pairs.reserve(simplices.size() * Dim * (Dim + 1));
  for (const Simplex<Dim>& s : simplices)
    for (const VertexId a : s)
      for (const VertexId b : s)
        if (a != b) pairs.push_back({a, b});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Adjacency out;
  out.first.assign(points + 1, 0);
  for (const auto& [a, b] : pairs) {
    ++out.first[a + 1];
    out.neighbours.push_back(b);
  }
  for (std::size_t v = 1; v < out.first.size(); ++v) out.first[v] += out.first[v - 1];
  return out;
}

/// Solves min |A x - b| by Householder's QR, A with `rows` rows of N entries. \return false when A has not full rank.
template <int N>
bool least_squares(std::vector<std::array<double, N>>& A, std::vector<double>& b, std::array<double, N>& x) {
  const std::size_t rows = A.size();
  double largest = 0.0;
  for (int k = 0; k < N; ++k) {
    double norm = 0.0;
    for (std::size_t r = k; r < rows; ++r) norm += A[r][k] * A[r][k];
    norm = std::sqrt(norm);
    largest = std::max(largest, norm);
    if (!(norm > 1e-6 * largest)) return false;
    // v = a + sign(a_k) |a| e_k, in place of the column; R's diagonal goes to x for now.
    const double diagonal = A[k][k] > 0.0 ? -norm : norm;
    A[k][k] -= diagonal;
    double square = 0.0;
    for (std::size_t r = k; r < rows; ++r) square += A[r][k] * A[r][k];
    const auto reflect = [&](auto&& entry) {
      double dot = 0.0;
      for (std::size_t r = k; r < rows; ++r) dot += A[r][k] * entry(r);
      for (std::size_t r = k; r < rows; ++r) entry(r) -= 2.0 * dot / square * A[r][k];
    };
    for (int c = k + 1; c < N; ++c) reflect([&](std::size_t r) -> double& { return A[r][c]; });
    reflect([&](std::size_t r) -> double& { return b[r]; });
    x[k] = diagonal;
  }
  for (int k = N - 1; k >= 0; --k) {
    double sum = b[k];
    for (int c = k + 1; c < N; ++c) sum -= A[k][c] * x[c];
    x[k] = sum / x[k];
  }
  return true;
}

template <int Dim>
class Recovery {
 public:
  Recovery(std::span<const Point<Dim>> points, std::span<const Simplex<Dim>> simplices, std::span<const double> values)
      : points_(points),
        values_(values),
        adjacency_(adjacency_of<Dim>(points.size(), simplices)),
        mark_(points.size(), kNone) {}

  SymTensor<Dim> at(VertexId v) {
    constexpr std::size_t kEnough = Dim == 2 ? 9 : 16;
    constexpr int kMostRings = 6;
    patch_.assign(1, v);
    mark_[v] = v;
    std::size_t ring = 0;
    SymTensor<Dim> H;
    for (int rings = 1; rings <= kMostRings; ++rings) {
      const std::size_t end = patch_.size();
      for (; ring < end; ++ring)
        for (Index k = adjacency_.first[patch_[ring]]; k < adjacency_.first[patch_[ring] + 1]; ++k) {
          const VertexId w = adjacency_.neighbours[k];
          if (mark_[w] == v) continue;
          mark_[w] = v;
          patch_.push_back(w);
        }
      if (rings >= 2 && patch_.size() >= kEnough && fit(v, H)) return H;
      if (patch_.size() == end) break;
    }
    return {};
  }

 private:
  static constexpr int kTerms = 1 + Dim + SymTensor<Dim>::size;

  bool fit(VertexId v, SymTensor<Dim>& H) {
    // Coordinates in which the patch is round, W (p - p_v): stretched meshes are fitted as well as others.
    SymTensor<Dim> spread;
    for (const VertexId w : patch_) {
      const Point<Dim> e = points_[w] - points_[v];
      for (int j = 0; j < Dim; ++j)
        for (int i = 0; i <= j; ++i) spread(i, j) += e[i] * e[j] / static_cast<double>(patch_.size());
    }
    const Spectrum<Dim> s = spectrum(spread);
    if (!(s.value[0] > 1e-24 * s.value[Dim - 1])) return false;
    std::array<Point<Dim>, Dim> W;
    for (int i = 0; i < Dim; ++i) W[i] = s.vector[i] / std::sqrt(s.value[i]);
    rows_.clear();
    right_.clear();
    for (const VertexId w : patch_) {
      const Point<Dim> e = points_[w] - points_[v];
      double u[Dim], square = 0.0;
      for (int i = 0; i < Dim; ++i) {
        u[i] = 0.0;
        for (int d = 0; d < Dim; ++d) u[i] += W[i][d] * e[d];
        square += u[i] * u[i];
      }
      const double weight = 1.0 / (0.25 + square);  // near vertices know better
      std::array<double, kTerms> row;
      int k = 0;
      row[k++] = weight;
      for (int i = 0; i < Dim; ++i) row[k++] = weight * u[i];
      for (int j = 0; j < Dim; ++j)
        for (int i = 0; i <= j; ++i) row[k++] = weight * u[i] * u[j] * (i == j ? 0.5 : 1.0);
      rows_.push_back(row);
      right_.push_back(weight * (values_[w] - values_[v]));
    }
    std::array<double, kTerms> x;
    if (!least_squares<kTerms>(rows_, right_, x)) return false;
    SymTensor<Dim> round;
    std::copy(x.begin() + 1 + Dim, x.end(), round.m.begin());
    H = {};
    for (int b = 0; b < Dim; ++b)
      for (int a = 0; a <= b; ++a)
        for (int j = 0; j < Dim; ++j)
          for (int i = 0; i < Dim; ++i) H(a, b) += W[i][a] * round(i, j) * W[j][b];
    return true;
  }

  std::span<const Point<Dim>> points_;
  std::span<const double> values_;
  Adjacency adjacency_;
  std::vector<VertexId> mark_, patch_;
  std::vector<std::array<double, kTerms>> rows_;
  std::vector<double> right_;
};

}  // namespace

template <int Dim>
std::vector<SymTensor<Dim>> recover_hessian(std::span<const Point<Dim>> points, std::span<const Simplex<Dim>> simplices,
                                            std::span<const double> values) {
  Recovery<Dim> recovery(points, simplices, values);
  std::vector<SymTensor<Dim>> out(points.size());
  for (VertexId v = 0; v < static_cast<VertexId>(points.size()); ++v) out[v] = recovery.at(v);
  return out;
}

template std::vector<SymTensor<2>> recover_hessian(std::span<const Point<2>>, std::span<const Simplex<2>>,
                                                   std::span<const double>);
template std::vector<SymTensor<3>> recover_hessian(std::span<const Point<3>>, std::span<const Simplex<3>>,
                                                   std::span<const double>);

}  // namespace pillowmesh
