// Gmsh's .msh, versions 2.2 and 4.1, ASCII and binary (https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format).
#pragma once

#include "pillowmesh/io/file_mesh.h"
#include "pillowmesh/io/sink.h"
#include "pillowmesh/io/source.h"

namespace pillowmesh {

/// Physical groups and their names are kept: of cells as regions, of boundary facets as patches; physical points pin
/// vertices; in 3D, physical curves are feature edges. An element of several groups belongs to the first of them.
/// A failure is left in `source`.
FileMesh read_gmsh(Source& source);

/// \param version 22 or 41
template <int Dim>
void write_gmsh(const MeshInput<Dim>& mesh, Sink& sink, int version, bool binary);

}  // namespace pillowmesh
