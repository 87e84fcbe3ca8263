#include "pillowmesh/metric/simplex_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace pillowmesh {
namespace {

template <int Dim>
double dot(const Point<Dim>& a, const Point<Dim>& b) {
  double sum = 0.0;
  for (int d = 0; d < Dim; ++d) sum += a[d] * b[d];
  return sum;
}

template <int Dim>
double determinant_of(const std::array<Point<Dim>, Dim>& e) {
  if constexpr (Dim == 2) {
    return e[0][0] * e[1][1] - e[0][1] * e[1][0];
  } else {
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
  }
}

/// Squared distance from p to the segment or triangle with these corners, and the weights of the nearest point.
template <int Dim>
double nearest_on_segment(const Point<Dim>& a, const Point<Dim>& b, const Point<Dim>& p, double* w) {
  const Point<Dim> e = b - a;
  const double square = dot<Dim>(e, e);
  const double t = square > 0.0 ? std::clamp(dot<Dim>(p - a, e) / square, 0.0, 1.0) : 0.0;
  w[0] = 1.0 - t;
  w[1] = t;
  const Point<Dim> gap = a + t * e - p;
  return dot<Dim>(gap, gap);
}
template <int Dim>
double nearest_on_triangle(const std::array<Point<Dim>, 3>& v, const Point<Dim>& p, double* w) {
  const Point<Dim> e = v[1] - v[0], f = v[2] - v[0], q = p - v[0];
  const double ee = dot<Dim>(e, e), ef = dot<Dim>(e, f), ff = dot<Dim>(f, f), eq = dot<Dim>(e, q), fq = dot<Dim>(f, q);
  const double det = ee * ff - ef * ef;
  const double s = ff * eq - ef * fq, t = ee * fq - ef * eq;
  if (det > 0.0 && s >= 0.0 && t >= 0.0 && s + t <= det) {
    w[1] = s / det;
    w[2] = t / det;
    w[0] = 1.0 - w[1] - w[2];
    const Point<Dim> gap = w[1] * e + w[2] * f - q;
    return dot<Dim>(gap, gap);
  }
  double best = 1e300;
  for (int k = 0; k < 3; ++k) {
    double side[2];
    const double square = nearest_on_segment<Dim>(v[k], v[(k + 1) % 3], p, side);
    if (!(square < best)) continue;
    best = square;
    w[k] = side[0];
    w[(k + 1) % 3] = side[1];
    w[(k + 2) % 3] = 0.0;
  }
  return best;
}

/// Squared distance to a facet of a simplex.
double nearest_on_facet(std::span<const Point<2>> points, const Simplex<2>& s, int opposite, const Point<2>& p,
                        Weights<2>& weights) {
  const int i = (opposite + 1) % 3, j = (opposite + 2) % 3;
  double w[2];
  const double square = nearest_on_segment<2>(points[s[i]], points[s[j]], p, w);
  weights = {};
  weights[i] = w[0];
  weights[j] = w[1];
  return square;
}
double nearest_on_facet(std::span<const Point<3>> points, const Simplex<3>& s, int opposite, const Point<3>& p,
                        Weights<3>& weights) {
  const int corner[3] = {(opposite + 1) % 4, (opposite + 2) % 4, (opposite + 3) % 4};
  double w[3];
  const double square =
      nearest_on_triangle<3>({points[s[corner[0]]], points[s[corner[1]]], points[s[corner[2]]]}, p, w);
  weights = {};
  for (int k = 0; k < 3; ++k) weights[corner[k]] = w[k];
  return square;
}

}  // namespace

template <int Dim>
double simplex_determinant(std::span<const Point<Dim>> points, const Simplex<Dim>& simplex) {
  std::array<Point<Dim>, Dim> e;
  for (int k = 0; k < Dim; ++k) e[k] = points[simplex[k + 1]] - points[simplex[0]];
  return determinant_of<Dim>(e);
}

template <int Dim>
Weights<Dim> barycentric(std::span<const Point<Dim>> points, const Simplex<Dim>& simplex, const Point<Dim>& p) {
  std::array<Point<Dim>, Dim> e;
  for (int k = 0; k < Dim; ++k) e[k] = points[simplex[k + 1]] - points[simplex[0]];
  const double inverse = 1.0 / determinant_of<Dim>(e);
  Weights<Dim> w;
  w[0] = 1.0;
  for (int k = 0; k < Dim; ++k) {  // Cramer's rule
    std::array<Point<Dim>, Dim> replaced = e;
    replaced[k] = p - points[simplex[0]];
    w[k + 1] = determinant_of<Dim>(replaced) * inverse;
    w[0] -= w[k + 1];
  }
  return w;
}

template <int Dim>
double nearest_in_simplex(std::span<const Point<Dim>> points, const Simplex<Dim>& simplex, const Weights<Dim>& barycentric,
                          const Point<Dim>& p, Weights<Dim>& nearest) {
  double best = std::numeric_limits<double>::infinity();
  for (int f = 0; f <= Dim; ++f) {  // it lies on a facet that p is beyond
    if (barycentric[f] >= 0.0) continue;
    Weights<Dim> on_facet;
    const double square = nearest_on_facet(points, simplex, f, p, on_facet);
    if (!(square < best)) continue;
    best = square;
    nearest = on_facet;
  }
  return best;
}

template <int Dim>
SimplexTree<Dim>::SimplexTree(std::span<const Point<Dim>> points, std::vector<Simplex<Dim>>& simplices) {
  std::vector<Point<Dim>> centres(simplices.size(), Point<Dim>::Zero());
  for (std::size_t i = 0; i < simplices.size(); ++i)
    for (const VertexId v : simplices[i]) centres[i] += points[v] / (Dim + 1);
  std::vector<Index> order(simplices.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(simplices.size());
  build(points, simplices, centres, order, 0);
  std::vector<Simplex<Dim>> sorted(simplices.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = simplices[order[i]];
  simplices = std::move(sorted);
}

template <int Dim>
Index SimplexTree<Dim>::build(std::span<const Point<Dim>> points, std::span<const Simplex<Dim>> simplices,
                              std::span<const Point<Dim>> centres, std::span<Index> order, Index first) {
  const auto id = static_cast<Index>(nodes_.size());
  nodes_.push_back({});
  Point<Dim> low = points[simplices[order[0]][0]], high = low, low_centre = centres[order[0]], high_centre = low_centre;
  for (const Index i : order) {
    for (int d = 0; d < Dim; ++d) {
      for (const VertexId v : simplices[i]) {
        low[d] = std::min(low[d], points[v][d]);
        high[d] = std::max(high[d], points[v][d]);
      }
      low_centre[d] = std::min(low_centre[d], centres[i][d]);
      high_centre[d] = std::max(high_centre[d], centres[i][d]);
    }
  }
  nodes_[id].low = low;
  nodes_[id].high = high;
  if (order.size() <= static_cast<std::size_t>(kLeaf)) {
    std::sort(order.begin(), order.end());  // their order must not depend on the library's nth_element
    nodes_[id].left = ~first;
    nodes_[id].count = static_cast<Index>(order.size());
    return id;
  }
  int axis = 0;
  for (int d = 1; d < Dim; ++d)
    if (high_centre[d] - low_centre[d] > high_centre[axis] - low_centre[axis]) axis = d;
  const std::size_t middle = order.size() / 2;
  // The id breaks ties: which of two simplices that share a place is found must not depend on the library.
  const auto at_middle = order.begin() + static_cast<std::ptrdiff_t>(middle);
  std::nth_element(order.begin(), at_middle, order.end(), [&](Index a, Index b) {
    return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
  });
  build(points, simplices, centres, order.first(middle), first);  // becomes node id + 1
  const Index right = build(points, simplices, centres, order.subspan(middle), first + static_cast<Index>(middle));
  nodes_[id].left = right;
  return id;
}

template <int Dim>
SimplexPlace<Dim> SimplexTree<Dim>::nearest(std::span<const Point<Dim>> points, std::span<const Simplex<Dim>> simplices,
                                            const Point<Dim>& p) const {
  const auto box_distance = [&](Index n) {
    double sum = 0.0;
    for (int d = 0; d < Dim; ++d) {
      const double gap = std::max({nodes_[n].low[d] - p[d], p[d] - nodes_[n].high[d], 0.0});
      sum += gap * gap;
    }
    return sum;
  };
  struct Waiting {
    Index node;
    double distance;
  };
  std::array<Waiting, 64> stack;  // deeper than log2 of any number of simplices
  int depth = 0;
  stack[depth++] = {0, box_distance(0)};
  // Most points lie inside: first only look for the simplex that holds p.
  while (depth > 0) {
    const Waiting at = stack[--depth];
    if (at.distance > 0.0) continue;
    const Node& node = nodes_[at.node];
    if (node.left >= 0) {
      stack[depth++] = {node.left, box_distance(node.left)};
      stack[depth++] = {at.node + 1, box_distance(at.node + 1)};
      continue;
    }
    for (Index i = ~node.left; i < ~node.left + node.count; ++i) {
      const Weights<Dim> w = barycentric<Dim>(points, simplices[i], p);
      if (*std::min_element(w.begin(), w.end()) >= 0.0) return {i, w};
    }
  }
  SimplexPlace<Dim> best;
  double best_square = 1e300;
  stack[depth++] = {0, box_distance(0)};
  while (depth > 0) {
    const Waiting at = stack[--depth];
    if (at.distance >= best_square && best.simplex != kNone) continue;
    const Node& node = nodes_[at.node];
    if (node.left >= 0) {
      const Waiting a{at.node + 1, box_distance(at.node + 1)}, b{node.left, box_distance(node.left)};
      const bool a_first = a.distance <= b.distance;
      stack[depth++] = a_first ? b : a;
      stack[depth++] = a_first ? a : b;
      continue;
    }
    for (Index i = ~node.left; i < ~node.left + node.count; ++i) {
      Weights<Dim> nearest;
      const double square =
          nearest_in_simplex<Dim>(points, simplices[i], barycentric<Dim>(points, simplices[i], p), p, nearest);
      if (square < best_square || best.simplex == kNone) {
        best_square = square;
        best = {i, nearest};
      }
    }
  }
  return best;
}

#define PILLOWMESH_INSTANTIATE(D)                                                                    \
  template class SimplexTree<D>;                                                                     \
  template Weights<D> barycentric<D>(std::span<const Point<D>>, const Simplex<D>&, const Point<D>&); \
  template double nearest_in_simplex<D>(std::span<const Point<D>>, const Simplex<D>&, const Weights<D>&, const Point<D>&, \
                                        Weights<D>&); \
  template double simplex_determinant<D>(std::span<const Point<D>>, const Simplex<D>&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
