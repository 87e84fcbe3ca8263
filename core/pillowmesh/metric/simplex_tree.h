// Finds the simplex that a point lies in, or the nearest one: a tree of boxes around simplices.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pillowmesh/mesh/ids.h"

namespace pillowmesh {

/// The vertices of a triangle or tetrahedron.
template <int Dim>
using Simplex = std::array<VertexId, Dim + 1>;

/// Barycentric coordinates: not negative, their sum is 1.
template <int Dim>
using Weights = std::array<double, Dim + 1>;

/// A place in a mesh of simplices.
template <int Dim>
struct SimplexPlace {
  Index simplex = kNone;
  Weights<Dim> weights{};
};

/// A binary tree of bounding boxes, split at the median of the longest side of their centres: as good for meshes whose
/// sizes vary by orders of magnitude. Immutable once made, safe to read from several threads.
template <int Dim>
class SimplexTree {
 public:
  /// Puts `simplices` in the order of the tree's leaves, so that neighbours in space are near in memory. Cost: n log n.
  /// \pre all have a volume
  SimplexTree(std::span<const Point<Dim>> points, std::vector<Simplex<Dim>>& simplices);

  /// The simplex that contains p or, for a point outside of all, the place nearest to it. Depends on p alone. Does not
  /// allocate. Cost: logarithmic; p is assumed finite.
  [[nodiscard]] SimplexPlace<Dim> nearest(std::span<const Point<Dim>> points, std::span<const Simplex<Dim>> simplices,
                                          const Point<Dim>& p) const;

 private:
  static constexpr Index kLeaf = 4;  ///< simplices in a leaf at the most

  /// Node k has the children `left` and k + 1, or, when left < 0, the simplices ~left ... ~left + count - 1.
  struct Node {
    Point<Dim> low, high;
    Index left;
    Index count;
  };
  Index build(std::span<const Point<Dim>> points, std::span<const Simplex<Dim>> simplices,
              std::span<const Point<Dim>> centres, std::span<Index> order, Index first);

  std::vector<Node> nodes_;
};

/// Barycentric coordinates, with any sign, of p in the simplex; its edges are those from vertex 0.
template <int Dim>
Weights<Dim> barycentric(std::span<const Point<Dim>> points, const Simplex<Dim>& simplex, const Point<Dim>& p);

/// The place in the simplex that is nearest to p, which lies outside of it; returns the squared distance. \pre a barycentric
/// coordinate of p is negative
template <int Dim>
double nearest_in_simplex(std::span<const Point<Dim>> points, const Simplex<Dim>& simplex, const Weights<Dim>& barycentric,
                          const Point<Dim>& p, Weights<Dim>& nearest);

/// Dim! times the signed volume.
template <int Dim>
double simplex_determinant(std::span<const Point<Dim>> points, const Simplex<Dim>& simplex);

}  // namespace pillowmesh
