// All vertices at once: conjugate gradients for what sweeps of single moves take long for, since these carry a change
// from row to row only.
#pragma once

#include <vector>

#include "pillowmesh/smooth/quad_relocate.h"

namespace pillowmesh {

/// Nonlinear conjugate gradients (Polak and Ribiere, with restarts), preconditioned by each vertex's own Hessian.
class QuadDescent {
 public:
  /// Both must outlive it; where others change the mesh meanwhile, `restart`.
  QuadDescent(Mesh<2>& mesh, QuadRelocator& relocator) : mesh_(mesh), relocator_(relocator) {}

  /// One iteration. No cell is ever inverted. \return by how much the energy fell; 0 when it cannot be lowered.
  /// Cost: derivatives at all vertices, and a few evaluations of the whole energy.
  double iterate();
  /// Forgets where it was going, and holds no memory.
  void restart() {
    residual_ = std::vector<Point<2>>();
    direction_ = std::vector<Point<2>>();
    start_ = std::vector<Point<2>>();
    last_step_ = 0.5;
  }

 private:
  bool find_direction();
  double energy_at(double step);
  [[nodiscard]] bool folded() const;

  Mesh<2>& mesh_;
  QuadRelocator& relocator_;
  std::vector<Point<2>> residual_, direction_, start_;
  std::vector<Index> start_anchor_;
  std::vector<std::uint8_t> seen_;
  double slope_ = 0.0;      ///< of the energy along the direction
  double last_product_ = 0.0;
  double last_step_ = 0.5;
};

}  // namespace pillowmesh
