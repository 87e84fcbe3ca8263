// Reading and writing mesh files: Medit .mesh, Gmsh .msh 2.2 and 4.1, legacy .vtk, .vtu.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// Reads a mesh from memory; the ending of `name` chooses the format, `name` appears in messages.
/// \return bad_input: one sentence with file, line or cell, and reason.
Expected<AnyMesh> read_mesh(std::string_view name, std::span<const char> bytes);
/// Reads a mesh from a file.
Expected<AnyMesh> read_mesh_file(const std::string& path);

struct WriteOptions {
  bool binary = false;
  /// Gmsh: 22 or 41.
  int gmsh_version = 41;
};

/// The bytes of a mesh file; the ending of `name` chooses the format.
Expected<std::string> write_mesh(const AnyMesh& mesh, std::string_view name, const WriteOptions& options = {});
/// Writes to a temporary name beside `path` and renames: a failed write leaves no half file.
Status write_mesh_file(const AnyMesh& mesh, const std::string& path, const WriteOptions& options = {});

}  // namespace pillowmesh
