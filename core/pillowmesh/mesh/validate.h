// What every mesh that enters or leaves an operator must satisfy.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// What is wrong with a mesh, and where.
struct Defect {
  enum class Kind {
    index_out_of_range,    ///< a corner names no vertex
    degenerate_cell,       ///< a cell names a vertex twice
    inverted_corner,       ///< a corner Jacobian is not positive
    inverted_inside,       ///< the corner Jacobians are positive, but the Jacobian inside a hexahedron is not
    non_manifold_facet,    ///< more than two cells at a facet
    inconsistent_orientation,  ///< two neighbours see their facet with the same orientation
    shared_facets,         ///< two cells share two facets (3D) or two edges (2D doublet)
    non_manifold_edge,     ///< more than two boundary facets at an edge (3D)
    non_manifold_vertex,   ///< the cells at a vertex are not connected through facets
    hanging_node,          ///< a boundary vertex lies inside another boundary facet
    broken_adjacency,      ///< twins or vertex_cell do not match the cells (a defect of pillowmesh)
    broken_support,        ///< a boundary vertex is not classified as such, or not on its patch
    overlapping_cells,     ///< the cells at a vertex go around it more than once (2D)
  };
  Kind kind;
  CellId cell = kNone;
  VertexId vertex = kNone;
  std::string message;  ///< one sentence
};

/// All defects, at most `most`. Cost: linear.
template <int Dim>
std::vector<Defect> find_defects(const Mesh<Dim>& mesh, int most = 20);

/// The parts of find_defects: cells alone; adjacency of a connected mesh; boundary vertices inside other boundary facets.
template <int Dim>
std::vector<Defect> find_cell_defects(const Mesh<Dim>& mesh, int most);
template <int Dim>
std::vector<Defect> find_adjacency_defects(const Mesh<Dim>& mesh, int most);
template <int Dim>
std::vector<Defect> find_hanging_nodes(const Mesh<Dim>& mesh, int most);
/// 3D: hexahedra whose corner Jacobians are positive but whose Jacobian is not, at a lattice of 3 x 3 x 3 points of the
/// cell; none in 2D, where positive corners suffice. These are no part of find_defects, and no reason to refuse a mesh:
/// positive corners are what every operator needs and keeps. They tell whether a finite element solver that integrates
/// at inner points can use the mesh. Cost: linear, about five times find_cell_defects.
template <int Dim>
std::vector<Defect> find_inside_defects(const Mesh<Dim>& mesh, int most = 20);
/// 2D: vertices whose cells overlap, although all corners are positive; none in 3D. \pre no defects of cells or adjacency
template <int Dim>
std::vector<Defect> find_overlaps(const Mesh<Dim>& mesh, int most);
/// Vertex supports of a classified mesh against its boundary facets.
template <int Dim>
std::vector<Defect> find_support_defects(const Mesh<Dim>& mesh, int most);

/// The first defect's sentence, how many more there are, and the cells of the next few. `cell_lines`, where not empty,
/// is the line of each cell in its file. `most`: as many as were looked for. \pre !defects.empty()
template <int Dim>
std::string describe(const std::vector<Defect>& defects, int most, std::span<const Index> cell_lines = {});

/// ok, or bad_input with `describe` of the defects.
template <int Dim>
Status validate(const Mesh<Dim>& mesh);

}  // namespace pillowmesh
