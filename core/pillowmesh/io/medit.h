// Medit's .mesh (ASCII) and .meshb (binary), as INRIA's libmeshb defines them.
#pragma once

#include <string_view>

#include "pillowmesh/io/file_mesh.h"
#include "pillowmesh/io/sink.h"
#include "pillowmesh/io/source.h"

namespace pillowmesh {

/// Vertices, Edges, Quadrilaterals, Hexahedra with their references (0: none); Corners pin vertices,
/// RequiredVertices, RequiredEdges and RequiredQuadrilaterals freeze, Ridges name feature edges. Other keywords are skipped. A failure is left in `source`.
FileMesh read_medit_ascii(Source& source);
/// Versions 1 to 4, either byte order.
FileMesh read_medit_binary(Source& source);

/// Boundary facets carry their group's number as reference; names are lost, for the format has none.
template <int Dim>
void write_medit(const MeshInput<Dim>& mesh, Sink& sink, bool binary);

}  // namespace pillowmesh
