// The edges that are too long at last: what a run's outcome tells of them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/field.h"

namespace pillowmesh {

/// Relative tolerance of the lengths here: a length counts as too long when it is above the threshold by more.
inline constexpr double kLongestEdgeTolerance = 1e-3;

/// The greatest metric length of an edge that is not frozen; 0 when there is none. Cost: linear in the mesh.
template <int Dim>
double longest_edge(const Mesh<Dim>& mesh, const MetricField<Dim>& field);

/// The edges that are longer than `length` and not frozen. Features of the metric narrower than a quarter of an
/// edge may be missed. Cost: linear in the mesh; for most edges five evaluations of the metric, where `longest_edge` takes seven.
/// \param touched per vertex; edges that join two with 0 are left out. Empty: all are looked at.
std::vector<std::array<VertexId, 2>> longer_edges(const Mesh<2>& mesh, const MetricField<2>& field, double length,
                                                  std::span<const unsigned char> touched = {});

/// The mean metric length of the edges. Cost: linear in the mesh.
template <int Dim>
double mean_edge_length(const Mesh<Dim>& mesh, const MetricField<Dim>& field);

/// limit_not_met with their number when frozen edges are longer than the threshold. Cost: linear in what is frozen.
template <int Dim>
Status check_frozen_edges(const Mesh<Dim>& mesh, const MetricField<Dim>& field, double threshold);

}  // namespace pillowmesh
