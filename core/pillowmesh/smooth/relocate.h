// The anisotropic smoother: vertices move, one at a time, to lower the barrier energy (energy.h). [Paper] sections 4, 6.
#pragma once

#include <type_traits>
#include <vector>

#include "pillowmesh/smooth/hex_star.h"
#include "pillowmesh/smooth/quad_star.h"

namespace pillowmesh {

struct RelocateOptions {
  /// A vertex rests when it and its neighbours last moved less than this, in units of the metric.
  double rest = 1e-3;
  /// Metric length that the smoother aims at; 0: chosen for the connectivity that there is. In 2D 0.955, since refinement
  /// that stops at threshold 2 leaves a mean below 1. In 3D the root of the mean length, halfway to what is there.
  double target_length = 0.0;
  /// Newton steps are lengthened by this factor: the mesh settles in far fewer sweeps.
  double relaxation = 1.5;
  /// A move that lowers the smallest scaled Jacobian around the vertex is refused where that is below this: the energy can
  /// fall while cells degenerate in space. 0: no guard. Used in 3D; in 2D anisotropic cells may well be sheared.
  double quality_guard = 0.1;
  /// The smoother stops when a sweep lowers the energy by less than this share, no vertex counting with more than 32
  /// times the median. 0: 3e-6 in 2D, 3e-5 in 3D, where more changes no mean by a thousandth.
  double converged = 0.0;
};

struct SweepResult {
  std::int64_t moved = 0;    ///< vertices
  double decrease = 0.0;     ///< of the energy
  double energy = 0.0;       ///< sum over the vertices visited, before they moved
  bool converged = false;    ///< nothing is left to do
};

/// Relocates the vertices of a mesh. Vertices inside move freely, those on curves and patches slide, corners stay. A
/// vertex moves only to where the energy of the cells around it falls, so no cell is ever turned inside out.
template <int Dim>
class Relocator {
 public:
  /// The mesh must outlive the relocator, and its topology must not change meanwhile.
  Relocator(Mesh<Dim>& mesh, const MetricField<Dim>& field, RelocateOptions options = {});

  /// Visits every vertex that may gain, in order of their numbers. Cost: linear in the vertices visited.
  SweepResult sweep();

  /// Tries to lower the energy at one vertex. \return the metric length of its move, 0 when it stays.
  double relocate(VertexId v);

 private:
  using Star = std::conditional_t<Dim == 2, QuadStar, HexStar>;

  bool little_gained();
  bool newton_step(VertexId v, const Derivatives<Dim>& d, Point<Dim>& step) const;

  Mesh<Dim>& mesh_;
  RelocateOptions options_;
  Star star_;
  std::vector<std::uint8_t> active_;  ///< per vertex: may gain
  std::vector<std::uint8_t> stuck_;   ///< per vertex: did not gain when last visited
  std::vector<std::array<double, 2>> visited_;  ///< in this sweep: energy, and what was gained
  double last_decrease_ = 0.0, last_energy_ = 0.0;
};

}  // namespace pillowmesh
