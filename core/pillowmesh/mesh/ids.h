// Index types and the point type that every other header builds on.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace pillowmesh {

/// 32-bit entity number; negative values never name an entity.
using Index = std::int32_t;
using VertexId = Index;
using CellId = Index;
/// A facet seen from one of its cells: cell * Cell<Dim>::facets + facet.
using HalfFacetId = Index;
/// Number of a boundary patch: a curve of the boundary in 2D, a surface patch in 3D.
using PatchId = Index;

inline constexpr Index kNone = -1;

/// A position. Unaligned on purpose: its layout must not depend on a user's vectorisation flags.
template <int Dim>
using Point = Eigen::Matrix<double, Dim, 1, Eigen::DontAlign>;

}  // namespace pillowmesh
