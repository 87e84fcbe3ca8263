// A metric field looked up in tensors at the vertices of a background mesh.
#pragma once

#include <memory>
#include <vector>

#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/field.h"
#include "pillowmesh/metric/simplex_tree.h"

namespace pillowmesh {

/// Log-Euclidean interpolation: the logarithms of the tensors are interpolated linearly in each triangle or tetrahedron.
/// Sizes between two vertices are geometric means, determinants too, and no tensor is less than positive definite.
/// [V. Arsigny, P. Fillard, X. Pennec, N. Ayache, Log-Euclidean metrics for fast and simple calculus on diffusion
/// tensors, Magnetic Resonance in Medicine 56 (2006)]
///
/// Points outside of the background take the value of its nearest point. Immutable, safe to read from several threads.
template <int Dim>
class DiscreteMetric {
 public:
  /// \param logs log M of each point. Simplices without volume are left out; any orientation will do.
  /// \return bad_input when none is left, or one names a point that is not there. Cost: n log^2 n.
  static Expected<std::shared_ptr<const DiscreteMetric>> make(std::vector<Point<Dim>> points,
                                                              std::vector<Simplex<Dim>> simplices,
                                                              std::vector<SymTensor<Dim>> logs);

  /// Tensors at lanes 0 .. count - 1. The value depends on the point alone. Does not allocate. Cost: about 50 ns (2D) for
  /// a point near the one before, the tree's logarithmic search for one that is not.
  void evaluate(const PointLanes<Dim>& points, int count, TensorLanes<Dim>& out) const;

 private:
  /// What a walk from simplex to simplex reads, side by side.
  struct Room {
    Point<Dim> origin;                            ///< vertex 0
    std::array<std::array<double, Dim>, Dim> rows;  ///< weight k + 1 = rows[k] . (p - origin)
    Simplex<Dim> vertices;
    std::array<Index, Dim + 1> neighbours;  ///< across the facet opposite of each vertex
  };

  DiscreteMetric(std::vector<Point<Dim>> points, std::vector<Simplex<Dim>> simplices, std::vector<SymTensor<Dim>> logs);
  void find_neighbours();
  [[nodiscard]] SimplexPlace<Dim> locate(const Point<Dim>& p, Index hint) const;

  std::vector<Point<Dim>> points_;
  std::vector<SymTensor<Dim>> logs_;
  std::vector<Simplex<Dim>> simplices_;  // declared before tree_, which puts them in order
  SimplexTree<Dim> tree_;
  std::vector<Room> rooms_;
};

/// out = exp(out), lane by lane: tensors from their logarithms.
template <int Dim>
void exp_lanes(int count, TensorLanes<Dim>& out);

}  // namespace pillowmesh
