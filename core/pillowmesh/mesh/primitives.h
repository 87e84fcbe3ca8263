// Initial meshes that need no file.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// A mesh whose dimension is known when the program runs.
using AnyMesh = std::variant<Mesh<2>, Mesh<3>>;

/// Axis-aligned box of n[0] x n[1] (x n[2]) equal cells from `low` to `high`. Each side is a patch of its own, in the
/// order of Cell<Dim>'s facets, named xmin, xmax, ymin, ymax, zmin, zmax.
template <int Dim>
Mesh<Dim> make_grid(std::array<int, Dim> n, const Point<Dim>& low, const Point<Dim>& high);

/// Reads `grid:NX,NY[,NZ]:X0,X1,Y0,Y1[,Z0,Z1]`. \return usage with the offending part when malformed.
Expected<AnyMesh> parse_grid(std::string_view spec);

}  // namespace pillowmesh
