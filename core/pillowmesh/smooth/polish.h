// Lifting the worst cells: where sizes change fast, a mesh of least energy has a few cells that are hardly simplices.
#pragma once

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/metric/field.h"

namespace pillowmesh {

struct PolishOptions {
  /// Cells with a shape eta below this are poor, that of flat simplices or that with the integral.
  double shape = 0.2;
  /// No edge becomes longer than this that is not already.
  double threshold = 2.0;
  /// No scaled Jacobian falls below this, nor where it is below already.
  double quality_guard = 0.1;
  /// Where more than this share of the cells is poor nothing is tried: it is their connectivity that does not fit.
  double most_poor = 0.08;
  int max_sweeps = 30;
};

struct PolishResult {
  Index poor_before = 0;  ///< cells
  Index poor_after = 0;
  Index moved = 0;  ///< moves of vertices
};

/// Moves the vertices of poor cells to where the shortfall of the shapes around them, summed by squares, is less.
/// Places are tried in many directions: the shortfall has too many kinks for derivatives. Where a corner's edges have
/// the lengths of no flat simplex, how far they miss counts. Other cells may lose what they have above `shape`. A cell
/// that is no simplex after that is shaken: its corners are displaced, descent begins anew, and what is worse is taken
/// back. Cost: linear in the mesh to find the poor cells, then about a millisecond for each poor cell and sweep, and
/// some 20 for each shake. Uses nothing but the order of cells and vertices: the same everywhere.
PolishResult polish_shapes(Mesh<3>& mesh, const MetricField<3>& field, const PolishOptions& options);

}  // namespace pillowmesh
