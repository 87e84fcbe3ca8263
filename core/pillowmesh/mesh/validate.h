// What every mesh that enters or leaves an operator must satisfy.
#pragma once

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
    non_manifold_facet,    ///< more than two cells at a facet
    inconsistent_orientation,  ///< two neighbours see their facet with the same orientation
    shared_facets,         ///< two cells share two facets (3D) or two edges (2D doublet)
    non_manifold_edge,     ///< more than two boundary facets at an edge (3D)
    non_manifold_vertex,   ///< the cells at a vertex are not connected through facets
    hanging_node,          ///< a boundary vertex lies inside another boundary facet
    broken_adjacency,      ///< twins or vertex_cell do not match the cells (a defect of pillowmesh)
    broken_support,        ///< a boundary vertex is not classified as such, or not on its patch
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
/// Vertex supports of a classified mesh against its boundary facets.
template <int Dim>
std::vector<Defect> find_support_defects(const Mesh<Dim>& mesh, int most);

/// ok, or bad_input with the first defect's sentence and how many more there are.
template <int Dim>
Status validate(const Mesh<Dim>& mesh);

}  // namespace pillowmesh
