// The domain's boundary: patches, corners, and the curve or surface that boundary vertices slide on.
#pragma once

#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// What turns the chord from a to b into a curve, a cubic with the slopes (b - a) + bend at its ends:
///   p(s) = a + s (b - a) + s (1 - s) ((1 - s) from - s to),  s from 0 to 1.
template <int Dim>
struct Bend {
  Point<Dim> from = Point<Dim>::Zero(), to = Point<Dim>::Zero();
};

struct Circle {
  Point<2> centre;
  double radius;
};

/// The boundary of the initial mesh, kept as the shape of the domain. `points` are its boundary vertices.
template <int Dim>
struct Geometry {
  static constexpr int facet_sides = 2 * (Dim - 1);
  /// Curves of a facet: itself in 2D, its four sides in 3D.
  static constexpr int facet_curves = Dim == 2 ? 1 : 4;

  std::vector<Point<Dim>> points;
  /// Boundary facets in the order of Cell<Dim>::facet_corner of their cell, the sign that turns them outward, the patch.
  std::vector<FacetCorners<Dim>> facets;
  std::vector<std::int8_t> sign;
  std::vector<PatchId> patch;
  /// Neighbour facet of the same patch across each side (2D: end point 0 or 1; 3D: facet of Cell<2>); kNone at the
  /// ends of the patch.
  std::vector<std::array<Index, facet_sides>> neighbours;

  /// Feature edges, 3D only: where two patches meet. Chains of them between corners are curves.
  std::vector<std::array<Index, 2>> segments;
  std::vector<Index> curve;
  std::vector<std::array<Index, 2>> segment_neighbours;
  std::vector<std::array<PatchId, 2>> curve_patches;  ///< per curve: the lower patch number first

  /// Smooth geometry (mesh/smooth_geometry.h); empty where pieces are straight. Per facet the curves from the lower to the
  /// higher of its corners, in 3D of its sides in the order of Cell<2>'s facets; per feature edge.
  std::vector<std::array<Bend<Dim>, facet_curves>> bends;
  std::vector<Bend<Dim>> segment_bends;
  /// 2D: the circle that a facet is an arc of, kNone for others.
  std::vector<Circle> circles;
  std::vector<Index> circle;
};

struct BoundaryOptions {
  /// A vertex (2D) or an edge (3D) of the boundary is a corner or feature where groups meet, or where the boundary
  /// turns by an angle whose cosine is below this. The default is 40 degrees.
  double corner_cosine = 0.7660444431189780;
  /// Groups, by name or number, whose vertices, edges, facets and cells must be in the output as they are in the input.
  std::vector<std::string> freeze{};
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
