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

  /// Tensors at lanes 0 .. count - 1. The value depends on the point alone. Does not allocate. Cost: about 60 ns (2D)
  /// where points are near each other; in space a place in memory that nobody has asked lately takes ten times that.
  void evaluate(const PointLanes<Dim>& points, int count, TensorLanes<Dim>& out) const;

  /// The lowest and the highest corner of the box around the background.
  [[nodiscard]] std::array<Point<Dim>, 2> box() const { return {bins_.low, bins_.high}; }

 private:
  /// What a walk from simplex to simplex reads, side by side.
  struct Room {
    Point<Dim> origin;                            ///< vertex 0
    std::array<std::array<double, Dim>, Dim> rows;  ///< weight k + 1 = rows[k] . (p - origin)
    Simplex<Dim> vertices;
    std::array<Index, Dim + 1> neighbours;  ///< across the facet opposite of each vertex
  };

  /// Equal boxes, about one per point, each with a simplex near its middle: where walks begin.
  struct Bins {
    Point<Dim> low, high, per_length;  ///< bins per unit of length
    std::array<Index, Dim> count;
    double width2;  ///< squared, of the narrowest side
    std::vector<Index> start;
  };

  DiscreteMetric(std::vector<Point<Dim>> points, std::vector<Simplex<Dim>> simplices, std::vector<SymTensor<Dim>> logs);
  void put_points_in_order();
  void find_neighbours();
  void fill_bins();
  [[nodiscard]] Index bin_of(const Point<Dim>& p) const;
  [[nodiscard]] Weights<Dim> weights_in(const Room& room, const Point<Dim>& p) const;
  [[nodiscard]] SimplexPlace<Dim> locate(const Point<Dim>& p, Index hint) const;
  [[nodiscard]] SimplexPlace<Dim> at_facet(const Point<Dim>& p, Index simplex, int opposite) const;

  std::vector<Point<Dim>> points_;
  std::vector<SymTensor<Dim>> logs_;
  std::vector<Simplex<Dim>> simplices_;  // declared before tree_, which puts them in order
  SimplexTree<Dim> tree_;
  std::vector<Room> rooms_;
  Bins bins_;
};

/// out = exp(out), lane by lane: tensors from their logarithms.
template <int Dim>
void exp_lanes(int count, TensorLanes<Dim>& out);

}  // namespace pillowmesh
