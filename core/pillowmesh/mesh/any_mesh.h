// A mesh whose dimension is known when the program runs, and the one place that says which dimensions there are.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// True for 2 and 3; in a WebAssembly module for the one that it is made for (cmake/Wasm.cmake): all code of the other
/// dimension is reached through AnyOf, and left out by the linker.
template <int Dim>
inline constexpr bool kHasDimension =
#ifdef PILLOWMESH_DIMENSION
    Dim == PILLOWMESH_DIMENSION;
#else
    Dim == 2 || Dim == 3;
#endif

/// std::variant<First..., T<2>, T<3>>, with the dimensions of this build.
template <template <int> class T, class... First>
using AnyOf = std::conditional_t<kHasDimension<2> && kHasDimension<3>, std::variant<First..., T<2>, T<3>>,
                                 std::variant<First..., T<kHasDimension<2> ? 2 : 3>>>;

using AnyMesh = AnyOf<Mesh>;

/// Why a mesh of a dimension that this build leaves out is not made.
template <int Dim>
Status other_dimension() {
  return {StatusCode::other_build,
          Dim == 2 ? "the mesh is two-dimensional, and this build of pillowmesh is for three dimensions"
                   : "the mesh is three-dimensional, and this build of pillowmesh is for two dimensions"};
}

/// make_mesh with `name`, the input's file, in front of what it finds wrong.
template <int Dim>
Expected<AnyMesh> make_any_mesh(MeshInput<Dim> input, std::string_view name, const BoundaryOptions& options = {}) {
  if constexpr (kHasDimension<Dim>) {
    auto mesh = make_mesh<Dim>(std::move(input), options);
    if (mesh) return AnyMesh(std::move(*mesh));
    return Status{mesh.status().code, std::string(name) + ": " + mesh.status().message};
  } else {
    return other_dimension<Dim>();
  }
}

}  // namespace pillowmesh
