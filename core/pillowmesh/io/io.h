// Reading and writing mesh files: Medit .mesh and .meshb, Gmsh .msh 2.2 and 4.1, legacy .vtk, .vtu.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "pillowmesh/mesh/any_mesh.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

class Sink;  // io/sink.h

/// Reads a mesh from memory; the ending of `name` chooses the format, `name` appears in messages. 2D meshes given in 3D
/// must lie in a plane z = constant. Groups: physical groups (Gmsh), references (Medit), an integer cell array named
/// group, gmsh:physical, medit:ref, CellEntityIds, region or patch (VTK).
/// \return bad_input: one sentence with file, line or cell, and reason. Memory: a multiple of the size of the file,
/// whatever its header promises.
Expected<AnyMesh> read_mesh(std::string_view name, std::span<const char> bytes, const BoundaryOptions& options = {});

/// Both, whatever the dimensions of this build: files are read and written without knowing what becomes of the mesh.
using AnyInput = std::variant<MeshInput<2>, MeshInput<3>>;
/// The first half of read_mesh: all that the file says. make_mesh is the second.
Expected<AnyInput> read_input(std::string_view name, std::span<const char> bytes);

/// The bytes of a file. \return bad_input with the system's reason when it cannot be read.
Expected<std::vector<char>> read_file(const std::string& path);

/// Reads a mesh from a file.
Expected<AnyMesh> read_mesh_file(const std::string& path, const BoundaryOptions& options = {});

struct WriteOptions {
  /// .meshb is always binary, .mesh never; the others are either.
  bool binary = false;
  /// Gmsh: 22 or 41.
  int gmsh_version = 41;
};

/// usage when no mesh can be written by that name with these options: unknown ending, .mesh as binary, ...
Status check_writable(std::string_view name, const WriteOptions& options = {});

/// The second half of write_mesh; to_input is the first.
template <int Dim>
Expected<std::string> write_input(MeshInput<Dim> input, std::string_view name, const WriteOptions& options = {});

/// Writes piece by piece, so that memory does not grow by the size of the file. `fields` go into VTK files; their values
/// are of live vertices and cells in order, as `carry` gives them.
template <int Dim>
Status write_mesh_to(Sink& sink, const Mesh<Dim>& mesh, std::string_view name, const WriteOptions& options = {},
                     std::vector<FieldArray> fields = {});

/// The bytes of a mesh file; the ending of `name` chooses the format. The same mesh gives the same bytes everywhere.
/// Cells, then boundary facets with their groups; names of groups survive in .msh and .vtu files.
Expected<std::string> write_mesh(const AnyMesh& mesh, std::string_view name, const WriteOptions& options = {});
template <int Dim>
Expected<std::string> write_mesh(const Mesh<Dim>& mesh, std::string_view name, const WriteOptions& options = {});

/// Writes to a temporary name beside `path` and renames: a failed write leaves no half file, and replaces nothing.
/// \return bad_input with the system's reason when the file cannot be written.
Status write_mesh_file(const AnyMesh& mesh, const std::string& path, const WriteOptions& options = {});
template <int Dim>
Status write_mesh_file(const Mesh<Dim>& mesh, const std::string& path, const WriteOptions& options = {},
                       std::vector<FieldArray> fields = {});

/// Writes `text` in the same safe way.
Status write_text_file(std::string_view text, const std::string& path);

}  // namespace pillowmesh
