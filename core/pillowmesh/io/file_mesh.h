// What mesh files have in common: a mesh as a file lists it, and its way to and from Mesh<Dim>.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pillowmesh/io/io.h"
#include "pillowmesh/mesh/boundary.h"

namespace pillowmesh {

/// Elements with N vertices each, as indices from 0 in the order that VTK, Gmsh and Medit share:
///
///      3---------2            7---------6
///      |         |           /|        /|
///      |         |          4---------5 |
///      |         |          | |       | |
///      |         |          | 3-------|-2
///      0---------1          |/        |/
///                           0---------1
template <int N>
struct Elements {
  std::vector<std::array<Index, N>> vertices;
  std::vector<Index> tag;   ///< physical group or reference; 0: none
  std::vector<Index> line;  ///< line of the file; empty for binary files
  std::vector<Index> place;  ///< among the file's cells of all kinds; VTK only
};

/// Elements that pillowmesh cannot adapt: counted, so that the message can tell.
struct Foreign {
  std::string what;  ///< plural: "triangles"
  std::int64_t count = 0;
  std::int64_t line = 0;  ///< of the first; 0 unknown
};

/// A mesh as its file says it, before it is known to be of dimension 2 or 3.
struct FileMesh {
  std::vector<Point<3>> points;
  /// What the file counts vertices from, for messages.
  int first_vertex = 1;
  Elements<2> lines;
  Elements<4> quads;
  Elements<8> hexes;
  /// Kept for backgrounds of metrics (io/background_file.h) and counted in `foreign` too.
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<Index, 4>> tetrahedra;
  std::vector<Index> corners;      ///< vertices pinned by the file
  std::vector<Index> corner_tags;  ///< their physical groups; empty: none
  std::vector<Index> ridges;       ///< indices into `lines`
  /// What the file wants kept: vertices, and indices into `lines`, `quads`.
  std::vector<Index> required_vertices, required_lines, required_quads;
  struct Name {
    int dim;
    Index tag;
    std::string name;
  };
  std::vector<Name> names;
  std::vector<Foreign> foreign;
  std::vector<FieldArray> fields;  ///< VTK, when asked for; those of cells for the file's cells of all kinds
};

/// All that a file says, before any check; the ending of `name` chooses the format. With `fields` the arrays of VTK files
/// too.
Expected<FileMesh> read_file_mesh(std::string_view name, std::span<const char> bytes, bool fields = false);

void add_foreign(FileMesh& mesh, std::string_view what, std::int64_t line);

/// Corner bits of the k-th vertex in the files' order; its own inverse.
inline constexpr std::array<int, 8> kFileOrder{0, 1, 3, 2, 4, 5, 7, 6};

/// Checks what the file says: only quads or only hexahedra; existing, distinct and finite vertices; a planar 2D mesh.
/// Hexahedra make it 3D, with the quads as boundary facets; else quads make it 2D, with the lines
/// as boundary facets. `name` is the file's, for messages.
Expected<AnyInput> finish(FileMesh file, std::string_view name);

/// Distinct positive numbers for the groups of one dimension, for files that know groups by number: the group's own
/// tag where it is free; 0 for the group that has neither tag nor name.
std::vector<Index> distinct_tags(const std::vector<Group>& groups);

/// Puts the groups in the order of their tags and names, so that a file does not depend on how patches were found.
template <int Dim>
void sort_groups(MeshInput<Dim>& mesh);

/// The vertices of a cell or facet in the files' order.
template <std::size_t N>
std::array<Index, N> file_order(const std::array<Index, N>& corner_bits) {
  std::array<Index, N> out;
  for (std::size_t k = 0; k < N; ++k) out[k] = N == 2 ? corner_bits[k] : corner_bits[kFileOrder[k]];
  return out;
}

}  // namespace pillowmesh
