// The domain's boundary: patches, corners, and the curve or surface that boundary vertices slide on.
#pragma once

#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// The boundary of the initial mesh, kept as the shape of the domain.
template <int Dim>
struct Geometry {
  std::vector<Point<Dim>> points;
  /// Boundary facets, oriented as their cell sees them, and the patch of each.
  std::vector<FacetCorners<Dim>> facets;
  std::vector<PatchId> patch;
  /// Neighbour facet across each side (2D: each end point; 3D: each edge, numbered as Cell<2> facets); kNone at the
  /// ends of a patch.
  std::vector<std::array<Index, 2 * (Dim - 1)>> neighbours;
};

struct BoundaryOptions {
  /// A vertex (2D) or an edge (3D) of the boundary is a corner or feature where the boundary turns by more than this
  /// angle, in degrees, or where groups meet.
  double corner_angle = 40.0;
};

/// Builds a mesh from what a reader found: drops unused vertices, finds neighbours, checks (see validate.h), splits
/// the boundary into patches and classifies its vertices.
/// \return bad_input naming the cell or facet when the input is not a valid conforming mesh. Cost: linear (one sort of
/// the facets).
template <int Dim>
Expected<Mesh<Dim>> make_mesh(MeshInput<Dim> input, const BoundaryOptions& options = {});

/// The inverse, for writers: dead cells and unused vertices dropped, every boundary facet with its group.
template <int Dim>
MeshInput<Dim> to_input(const Mesh<Dim>& mesh);

}  // namespace pillowmesh
