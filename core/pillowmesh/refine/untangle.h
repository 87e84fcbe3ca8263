// Finds places for new vertices where simple ones fail: around bent or mixed convex and re-entrant hulls.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {

/// Positions of the corners of one cell.
template <int Dim>
using CellShape = std::array<Point<Dim>, Cell<Dim>::corners>;

/// The part of a mesh that is untangled: free vertices, and every cell at one of them. The rest stays.
template <int Dim>
struct TangledPatch {
  std::vector<VertexId> free;  ///< ascending
  std::vector<CellId> cells;
  /// Per cell, the form that it should have: size, stretching and angles count, the place does not. A valid cell.
  std::vector<CellShape<Dim>> shapes;
  std::vector<CellId> known;  ///< `cells`, ascending
};

/// Adds vertices to `free` (those that it has already do not count; corners of the domain stay) and their cells that are
/// not in the patch, with the form that they have now.
template <int Dim>
void extend(TangledPatch<Dim>& patch, const Mesh<Dim>& mesh, std::span<const VertexId> vertices);

/// Moves the free vertices, those on the boundary along it, until every cell of the patch is valid: all corner Jacobians
/// positive, in 3D also those at a lattice of 3 x 3 x 3 points (where they are in the form wanted), and all scaled
/// Jacobians above `floor`.
///
/// Minimises the sum over corners, and where need be over the inner points, of a barrier against inversion,
///   (tr J'J / Dim)^(Dim/2) / chi(d) + size_weight (1 + d^2) / (2 chi(d)),   chi(d) = (d + sqrt(d^2 + eps^2)) / 2,
/// with J the Jacobian relative to the form wanted and d = det J; chi sees across inversion, and eps falls as d rises.
/// By L-BFGS, the free vertices all at once: vertices that block each other cannot be moved one by one.
/// Source: Garanzha et al., "Foldover-free maps in 50 lines of code" (2021); chi: Escobar et al., "Simultaneous
/// untangling and smoothing of tetrahedral meshes" (2003).
/// \param most_work how often the energy of a cell may be evaluated; what was is taken off.
/// \return whether it succeeded; if not, the vertices are left where they ended. Cost: linear in the patch, times some
/// hundred evaluations.
template <int Dim>
bool untangle(Mesh<Dim>& mesh, const TangledPatch<Dim>& patch, double floor, std::int64_t& most_work);

}  // namespace pillowmesh
