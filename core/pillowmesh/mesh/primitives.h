// Initial meshes that need no file.
#pragma once

#include <array>
#include <string_view>

#include "pillowmesh/mesh/any_mesh.h"
#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// Axis-aligned box of n[0] x n[1] (x n[2]) equal cells from `low` to `high`. Each side is a patch of its own, in the
/// order of Cell<Dim>'s facets, named xmin, xmax, ymin, ymax, zmin, zmax.
template <int Dim>
Mesh<Dim> make_grid(std::array<int, Dim> n, const Point<Dim>& low, const Point<Dim>& high);

/// A section (mesh/sections.h) or the prism over one as a mesh: its patches are the groups, whatever their angles.
/// \return bad_input if it is not a valid mesh.
template <int Dim>
Expected<Mesh<Dim>> make_section(MeshInput<Dim> section);

/// True if `text` begins with the name of a primitive and a colon: it is a specification, not a file.
bool is_primitive(std::string_view text);

/// Reads a specification. With the parts in brackets the mesh is 3D: the prism of NZ layers from Z0 to Z1.
///
///     grid:NX,NY[,NZ]:X0,X1,Y0,Y1[,Z0,Z1]    box of equal cells
///     ogrid:N,M[,NZ]:R[,Z0,Z1]               disk or cylinder: N x N core, M rings of 4 N cells, radius R
///     ring:N,M[,NZ]:R0,R1[,Z0,Z1]            ring or tube: N cells around, M across, radii R0 < R1
///     quarter:N,M[,NZ]:R,S[,Z0,Z1]           square or box of side S without a quarter disk or cylinder of radius R
///                                            about the origin: N cells along each far side, M from the arc outward
///     lprism:N,M[,NZ]:S,A[,Z0,Z1]            L or L-prism: sides of length S with N cells, arms of width A with M
///
/// `freeze`: groups as in BoundaryOptions.
/// \return usage with the offending part when malformed.
Expected<AnyMesh> parse_primitive(std::string_view spec, const std::vector<std::string>& freeze = {});

}  // namespace pillowmesh
