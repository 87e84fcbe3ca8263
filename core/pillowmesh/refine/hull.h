// The hull: facets between the shrink set and the rest. [Paper] section 2.
#pragma once

#include <span>
#include <vector>

#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {

/// A hull facet as both sides see it. A facet of the domain's boundary can be hull too (nothing lies outside then):
/// that is how a row is split when the shrink set is the whole mesh.
template <int Dim>
struct HullFacet {
  CellId inside;        ///< cell of the shrink set
  std::int8_t facet;    ///< its facet
  CellId outside;       ///< kNone on the domain's boundary
  std::int8_t outside_facet;
  PatchId patch;        ///< of a boundary facet, else kNone
  FacetCorners<Dim> vertices;  ///< before duplication, in the order of the inside cell
  /// Corner of the outside cell at vertices[k].
  std::array<std::int8_t, Cell<Dim>::facet_corners> outside_corner;
};

/// The shrink set and its hull, with marks for constant-time questions. Buffers are reused; marks are zero between uses.
template <int Dim>
struct Hull {
  std::vector<std::uint8_t> in_set;       ///< per cell
  std::vector<std::uint8_t> hull_sides;   ///< per cell of the set: bit f = facet f is hull
  std::vector<Index> slot;                ///< per vertex: position in `vertices`, or kNone
  std::vector<HullFacet<Dim>> facets;
  std::vector<VertexId> vertices;

  [[nodiscard]] bool is_hull(CellId c, int f) const { return in_set[c] && ((hull_sides[c] >> f) & 1); }
};

/// Finds the hull of a shrink set (each cell once) and sets the marks. `boundary_hull`: boundary half-facets of the set
/// that count as hull. Cost: linear in the set; marks grow with the mesh.
template <int Dim>
void find_hull(const Mesh<Dim>& mesh, std::span<const CellId> shrink_set, std::span<const HalfFacetId> boundary_hull,
               Hull<Dim>& hull);
/// Zeroes the marks that find_hull set.
template <int Dim>
void clear_hull(std::span<const CellId> shrink_set, Hull<Dim>& hull);

}  // namespace pillowmesh
