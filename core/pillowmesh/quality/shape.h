// The paper's shape indicator eta, [Paper] Eq. (4): how far a cell's corners are from unit squares or cubes in the
// metric.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pillowmesh/mesh/edge_table.h"
#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/metric/field.h"
#include "pillowmesh/metric/line_integral.h"

namespace pillowmesh {

/// Metric lengths of a corner simplex's edges: those out of the corner in axis order, then those that join their ends:
/// l0 l1 l01 in 2D, l0 l1 l2 l01 l02 l12 in 3D.
template <int Dim>
using SimplexLengths = std::array<double, Dim*(Dim + 1) / 2>;

/// eta = C V^(2/Dim) / sum of l^2 of the flat simplex with these edge lengths: V after Heron (2D) or Cayley and Menger
/// (3D), C = 8 in 2D and 9 * 6^(2/3) in 3D. 1 for a right-angled unit corner, up to 1.155 (2D) beyond; 0 where no flat
/// simplex has these lengths (our convention, the paper does not tell).
template <int Dim>
double simplex_shape(const SimplexLengths<Dim>& lengths);

/// The same with a given metric volume, 0 if that is not positive: eta_integral when it is the integral of sqrt(det M).
template <int Dim>
double simplex_shape(const SimplexLengths<Dim>& lengths, double volume);

/// The edges of cells and what has been integrated along them.
template <int Dim>
struct EdgeIntegrals {
  EdgeTable edges;
  std::vector<LineIntegral> along;           ///< of each edge, by its number
  std::vector<SymTensor<Dim>> at_vertices;  ///< the metric at those of the cells
};

/// \pre the cells are alive. Cost: linear in them and in the points.
template <int Dim>
EdgeIntegrals<Dim> edge_integrals(const Mesh<Dim>& mesh, const MetricField<Dim>& field, std::span<const CellId> cells,
                             const LineOptions& options);

/// eta of each of `cells`, the least over its 2^Dim corner simplices. Points and cells are all of the mesh that is needed.
/// \param flat out: with flat simplices. \pre flat.size() == cells.size()
/// \param integral out: with the integral of sqrt(det M) over the corner simplices, to 0.3 %; may be empty.
/// \param options how edges are integrated; diagonals with panels twice (3D: four times) as long, in 2D with one where all
/// edges of the cell are shorter than 2 in the metric.
/// \param known what edge_integrals found of these cells with the same options; null: that is done here.
/// \param area 2D, with `integral`: the metric areas of the cells are added to it; may be null.
template <int Dim>
void cell_shapes(const Mesh<Dim>& mesh, const MetricField<Dim>& field, std::span<const CellId> cells,
                 std::span<double> flat, std::span<double> integral, const LineOptions& options = {},
                 const EdgeIntegrals<Dim>* known = nullptr, double* area = nullptr);

}  // namespace pillowmesh
