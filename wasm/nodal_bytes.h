// A metric on a background on its way from the module that makes it to one that adapts.
#pragma once

#include <span>
#include <string>

#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/nodal.h"

namespace pillowmesh {

/// Dimension, numbers of points and simplices, 0 (32 bits each); then points and the logarithms of the tensors as
/// doubles, and simplices as 32-bit numbers. The form is no file format: it may change with any version. \pre
/// check_tensors
template <int Dim>
std::string nodal_to_bytes(const NodalMetric<Dim>& metric);

/// \return usage when these are not the bytes of such a metric, or it is of another dimension
template <int Dim>
Expected<MetricField<Dim>> field_from_bytes(std::span<const char> bytes);

}  // namespace pillowmesh
