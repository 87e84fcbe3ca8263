// Solution fields carried from one mesh to another of the same domain.
#pragma once

#include <string_view>
#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// A mesh and the arrays of values on it. Points that no cell uses are allowed.
template <int Dim>
struct Solution {
  std::vector<Point<Dim>> points;
  std::vector<Corners<Dim>> cells;
  std::vector<FieldArray> fields;
};

/// The fields at the points and cells of `to`, in the order in which writers list them (to_input): live vertices, live
/// cells.
///
/// Values at points are interpolated by the multilinear map of the cell that the point lies in: exact for a field that is
/// multilinear in each old cell, elsewhere off by h^2 / 8 times the second derivatives (h: the old cells' size); at old
/// vertices that stayed exact. Values of cells are constant in each old cell: a new cell has their mean over its volume,
/// by 3^Dim Gauss points, so that integrals are kept but for the error of that; whole numbers (FieldArray::whole) are taken
/// where the cell's middle lies. Points outside of all old cells have the value at the place nearest to them.
/// \return bad_input when an array has not as many values as there are points or cells, or there is no cell of positive
/// volume. Cost: logarithmic per point.
template <int Dim>
Expected<std::vector<FieldArray>> carry(const Solution<Dim>& from, const Mesh<Dim>& to);

/// What `carry` does with a field, and its error, for reports: "multilinear interpolation; ...".
std::string_view carried_how(const FieldArray& field);

/// The points and cells of a mesh as the beginning of a solution, in the order of `carry`.
template <int Dim>
Solution<Dim> solution_on(const Mesh<Dim>& mesh);

}  // namespace pillowmesh
