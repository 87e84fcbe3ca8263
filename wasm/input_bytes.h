// A mesh as a reader hands it over, in bytes: the form in which it crosses between the module that knows file formats
// and the modules that adapt.
#pragma once

#include <span>
#include <string>

#include "pillowmesh/io/io.h"

namespace pillowmesh {

/// Everything that the input holds, arrays in memory order. The form is no file format: it may change with any version.
template <int Dim>
std::string to_bytes(const MeshInput<Dim>& input);

/// The dimension of what to_bytes wrote; 0 for other bytes.
int dimension_of(std::span<const char> bytes);

/// \pre `bytes` are whole, from to_bytes, of dimension Dim. \return bad_input when they end too early
template <int Dim>
Expected<MeshInput<Dim>> from_bytes(std::span<const char> bytes);

}  // namespace pillowmesh
