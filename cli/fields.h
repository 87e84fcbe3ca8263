// Fields that travel: from the input, or a .sol beside it, to the adapted mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "pillowmesh/io/solution_file.h"
#include "pillowmesh/quality/report.h"

namespace pillowmesh::cli {

/// What is to be carried: the arrays of a VTK input, unless --no-fields, when the output is VTK too; the fields of
/// --solution. Nothing when there are none. \return what is wrong with the .sol
Expected<std::optional<AnySolution>> load_fields(const AdaptFlags& flags);

/// Writes the mesh to flags.output with the fields carried to it: into a VTK file; else those of --solution to a .sol of
/// the same name. `carried` says what was done, for the report.
template <int Dim>
Status write_with_fields(const Mesh<Dim>& mesh, const std::optional<AnySolution>& from, const AdaptFlags& flags,
                         std::vector<CarriedField>& carried);

/// "carried 2 fields of points (multilinear interpolation)", for the terminal; empty if there are none.
std::string sentence(const std::vector<CarriedField>& carried);

}  // namespace pillowmesh::cli
