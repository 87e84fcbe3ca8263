// Tensors at the vertices of a background mesh: what all makers of metrics but formulas make, and what operations on
// metrics work on.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/field.h"
#include "pillowmesh/metric/simplex_tree.h"

namespace pillowmesh {

/// A metric given at vertices; in between it is interpolated, see discrete.h.
template <int Dim>
struct NodalMetric {
  std::vector<Point<Dim>> points;
  std::vector<Simplex<Dim>> simplices;
  std::vector<SymTensor<Dim>> tensors;  ///< one per point
};

/// Quads divided along the diagonal whose triangles are larger, hexahedra into six tetrahedra around their smallest
/// vertex number: facets are divided alike from both sides. [J. Dompierre, P. Labbe, M.-G. Vallet, R. Camarero, How to
/// subdivide pyramids, prisms and hexahedra into tetrahedra, 8th International Meshing Roundtable, 1999]
template <int Dim>
std::vector<Simplex<Dim>> divide(std::span<const Point<Dim>> points, std::span<const Corners<Dim>> cells);

/// A box of n[0] x n[1] (x n[2]) equal cells, divided; its tensors are zero. Axis 0 of the points runs fastest.
template <int Dim>
NodalMetric<Dim> nodal_grid(std::array<int, Dim> n, const Point<Dim>& low, const Point<Dim>& high);

/// The field at the vertices of a mesh, on the mesh as background.
template <int Dim>
NodalMetric<Dim> sample_at_vertices(const MetricField<Dim>& field, const Mesh<Dim>& mesh);

/// Checks that there is a tensor per point, each finite, positive definite and of sizes between 1e-100 and 1e100.
/// \return bad_input that names the first vertex, counted from 1, where it is not so.
template <int Dim>
Status check_tensors(std::span<const SymTensor<Dim>> tensors, std::size_t points);

/// The field of a nodal metric. \return bad_input as check_tensors, or when the background has no volume.
template <int Dim>
Expected<MetricField<Dim>> look_up(NodalMetric<Dim> metric);

}  // namespace pillowmesh
