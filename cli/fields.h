// Fields that travel: from the input, or a .sol beside it, to the adapted mesh.
#pragma once

#include <optional>
#include <string>

#include "cli/commands.h"
#include "pillowmesh/io/solution_file.h"

namespace pillowmesh::cli {

/// What is to be carried: the arrays of a VTK input, unless --no-fields, when the output is VTK too; the fields of
/// --solution. Nothing when there are none. \return what is wrong with the .sol
Expected<std::optional<AnySolution>> load_fields(const AdaptFlags& flags);

/// Writes the mesh to flags.output with the fields carried to it: into a VTK file; else those of --solution to a .sol of
/// the same name. `note` says what was done, for the table; empty if nothing.
template <int Dim>
Status write_with_fields(const Mesh<Dim>& mesh, const std::optional<AnySolution>& from, const AdaptFlags& flags,
                         std::string& note);

}  // namespace pillowmesh::cli
