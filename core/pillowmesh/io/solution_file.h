// Meshes with the fields that VTK files hold on them.
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "pillowmesh/adapt/transfer.h"

namespace pillowmesh {

using AnySolution = std::variant<Solution<2>, Solution<3>>;

/// The cells of a mesh file and, if it is .vtk or .vtu, the arrays of its points and cells but for groups: those of one or
/// more numbers per entity, whatever their type. Other formats have none. \pre read_input accepts the file
/// \return bad_input: file and reason. An array that has not as many values as it should is left out.
Expected<AnySolution> read_solution(std::string_view name, std::span<const char> bytes);

}  // namespace pillowmesh
