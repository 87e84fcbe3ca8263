// VTK's legacy .vtk and XML .vtu files (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html).
#pragma once

#include <string_view>
#include <vector>

#include "pillowmesh/io/file_mesh.h"
#include "pillowmesh/io/sink.h"
#include "pillowmesh/io/source.h"

namespace pillowmesh {

/// Legacy unstructured grids, versions 1 to 5, ASCII and binary. Groups come from an integer cell array (see
/// group_array_rank); with `fields` the other arrays are kept too. A failure is left in `source`.
FileMesh read_vtk(Source& source, bool fields = false);
/// XML unstructured grids of one piece: ASCII, base64 and raw appended data, plain or compressed by zlib.
FileMesh read_vtu(Source& source, bool fields = false);

/// Cells first, then the boundary facets; the cell array `group` holds the number of the region or patch.
template <int Dim>
void write_vtk(const MeshInput<Dim>& mesh, Sink& sink, bool binary);
/// ASCII, or inline base64.
template <int Dim>
void write_vtu(const MeshInput<Dim>& mesh, Sink& sink, bool binary);

/// VTK's numbers of the cell types that are written.
template <int Dim>
inline constexpr int kVtkCell = Dim == 2 ? 9 : 12;
template <int Dim>
inline constexpr int kVtkFacet = Dim == 2 ? 3 : 9;

/// An unstructured grid as VTK stores it.
struct VtkGrid {
  std::vector<Point<3>> points;
  std::vector<Index> connectivity;
  std::vector<Index> ends;  ///< per cell, one past its last place in `connectivity`
  std::vector<Index> types;
  std::vector<Index> groups;  ///< per cell, or empty
  std::vector<Index> lines;   ///< of the file, per cell, or empty
  std::vector<FieldArray> fields;
};

/// Pixels and voxels become quads and hexahedra, poly-lines become edges, vertices are dropped.
FileMesh to_file_mesh(VtkGrid grid, Source& source);

/// Cell arrays that are read as groups: ours, Gmsh's, and those of meshio and other converters. 0 for a name that is
/// none of them; of two, the higher rank is taken.
int group_array_rank(std::string_view name);

/// A group number from an array of any type: 0 where it is not an integer of 32 bits.
Index group_number(double value);

/// Continues the fields of cells on the facets, which have the values of their cell: of the first that has the facet.
/// Without fields of cells it does nothing. Cost: one sort of the facets.
template <int Dim>
void continue_fields(MeshInput<Dim>& mesh);

/// One number per cell and facet, in the order in which write_vtk and write_vtu list them.
template <int Dim>
std::vector<Index> group_array(const MeshInput<Dim>& mesh);

}  // namespace pillowmesh
