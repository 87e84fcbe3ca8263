// The loop that adaptation is for: solve, estimate, adapt, carry the solution over, repeat.
#pragma once

#include <pillowmesh/adapt/options.h>
#include <pillowmesh/metric/field.h>

#include "problems.h"

namespace solver {

enum class Kind { uniform, isotropic, anisotropic };

/// A mesh and the solution on it.
struct State {
  Mesh<2> mesh;
  std::vector<double> values;  ///< at its vertices
};

/// What one turn gave.
struct Turn {
  int cells = 0;
  double error = 0.0;    ///< of the solution, in L2
  double carried = 0.0;  ///< of the solution before, carried to the mesh
};

/// Hessians recovered at the vertices, turned into the metric that makes the L2 error of interpolation smallest with
/// about `cells` cells; with `isotropic` the larger curvature counts in both directions. \return why there is none
pillowmesh::Expected<pillowmesh::MetricField<2>> estimate(const State& state, double cells, bool isotropic);

/// Solves on the primitive of n cells on the longest side.
Turn begin(const Known& known, int n, State& state);

/// Estimates, adapts to about `cells` cells, carries the solution over and solves again.
pillowmesh::Expected<Turn> turn(const Known& known, double cells, bool isotropic, pillowmesh::Effort effort,
                                State& state);

}  // namespace solver
