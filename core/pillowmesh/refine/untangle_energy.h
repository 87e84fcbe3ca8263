// The energy that `untangle` descends on: a barrier against inversion that sees across it.
#pragma once

#include "pillowmesh/refine/untangle.h"

namespace pillowmesh {

template <int Dim>
using SquareMatrix = Eigen::Matrix<double, Dim, Dim, Eigen::DontAlign>;

/// The points of a cell where its Jacobian is looked at: its corners first, in 3D then the other points of the
/// 3 x 3 x 3 lattice. At each, the Jacobian's column `axis` is a weighted mean of the edges along that axis.
template <int Dim>
struct SamplePoints {
  static constexpr int count = Dim == 2 ? 4 : 27;
  std::array<std::array<std::array<double, Cell<Dim>::edges_per_axis>, Dim>, count> weight;
};
template <int Dim>
const SamplePoints<Dim>& sample_points();

/// Energy of a patch for given `eps`, and the lowest relative Jacobian determinant met.
struct PatchEnergy {
  double value = 0.0;
  double lowest = 0.0;
};

template <int Dim>
class UntangleEnergy {
 public:
  UntangleEnergy(const Mesh<Dim>& mesh, const TangledPatch<Dim>& patch);

  /// Sees the corners of the cells only (at first), or their inner points too.
  void look_inside() { samples_ = SamplePoints<Dim>::count; }
  [[nodiscard]] bool looks_inside() const { return samples_ > Cell<Dim>::corners; }

  /// `gradient`: one vector per free vertex, or null.
  PatchEnergy evaluate(double eps, std::vector<Point<Dim>>* gradient) const;

  /// Mean edge length of the forms wanted at a free vertex.
  [[nodiscard]] double size(std::size_t free) const { return size_[free]; }

 private:
  const Mesh<Dim>& mesh_;
  const TangledPatch<Dim>& patch_;
  int samples_ = Cell<Dim>::corners;
  std::vector<std::array<Index, Cell<Dim>::corners>> slots_;  ///< per cell: index of each corner in `free`, or kNone
  std::vector<SquareMatrix<Dim>> to_wanted_;  ///< per cell and sample: inverse of the wanted Jacobian, 0: not looked at
  std::vector<double> size_;
};

}  // namespace pillowmesh
