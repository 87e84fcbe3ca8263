// From the command line to a mesh and a metric.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/commands.h"
#include "pillowmesh/metric/field.h"
#include "pillowmesh/metric/gallery.h"

namespace pillowmesh::cli {

/// usage that lists the cases when there is none of that name.
Expected<const Case*> named_case(const std::string& name);

/// A mesh file or a primitive, `grid:...`; the options are for files.
Expected<AnyMesh> load_mesh(const std::string& input, const BoundaryOptions& options = {});

/// The mesh that the flags name.
Expected<AnyMesh> problem_mesh(const ProblemFlags& flags, const BoundaryOptions& options = {});

/// The metric that the flags name for `mesh`, the one that problem_mesh gave; its sizes scaled. Checks that it fits the
/// mesh's dimension and is positive definite at the mesh's vertices.
template <int Dim>
Expected<MetricField<Dim>> problem_metric(const ProblemFlags& flags, const Mesh<Dim>& mesh);

/// usage when `output` is the file `input`, or its ending is unknown: what can be said before any work is done.
Status check_output(const std::string& output, const std::string& input, const WriteOptions& options);
Status check_not_input(const std::string& output, const std::string& input);

/// The candidate nearest to a misspelled `word`, or empty when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace pillowmesh::cli
