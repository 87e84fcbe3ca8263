// The numbers that say how good a mesh is in a metric: one struct, one JSON schema, for command, library and page.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/metric/field.h"
#include "pillowmesh/quality/statistics.h"

namespace pillowmesh {

/// How a field came from the old mesh to the new one.
struct CarriedField {
  std::string name;
  bool of_cells = false;
  std::string how;  ///< the method and its error, in a sentence
};

/// The fields of the report, in its order. Lengths are metric lengths; seconds are wall time.
struct Report {
  int dim = 0;
  Index vertices = 0;
  Index edges = 0;
  Index cells = 0;
  Statistics edge_length;     ///< share_in_range counts lengths in [1/sqrt 2, sqrt 2]
  Statistics shape;           ///< the paper's eta, flat corner simplices
  Statistics shape_integral;  ///< eta with V_K = integral of sqrt(det M)
  double scaled_jacobian_min = 0.0;
  double scaled_jacobian_mean = 0.0;
  Index irregular_vertices = 0;  ///< inside: valence other than 4 (2D) or an irregular edge at it (3D)
  /// 2D: mean of sin^2(2 phi) over the edges where sizes differ by more than a factor of 2, phi the angle in space to
  /// the nearest eigenvector of the metric in the edge's middle: 0 aligned, 0.5 at random. 0 where there is none.
  double misalignment = 0.0;
  double complexity = 0.0;       ///< integral of sqrt(det M): the ideal number of cells
  bool valid = false;
  std::string defect;                              ///< the first defect's sentence when not valid
  std::vector<CarriedField> fields;                ///< solution fields that were carried
  std::map<std::string, double> seconds;           ///< total, refine, smooth, ...
  std::int64_t peak_memory_bytes = 0;              ///< 0 where the system does not tell
  std::map<std::string, std::int64_t> operations;  ///< layers, iterations, relocations, ...
};

/// Measures `mesh` in `field`: everything but seconds, peak_memory_bytes and operations. Edges are looked at so closely that
/// features a five hundredth (3D: a thousandth) of the domain wide are seen, cells less closely: in 2D those that are less
/// than a 32nd of it wide may lie between the points. Where the mesh is broken (index_out_of_range, broken_adjacency)
/// nothing is measured. Where the metric is not a number, so are the indicators. Cost: linear.
template <int Dim>
Report measure(const Mesh<Dim>& mesh, const MetricField<Dim>& field);

/// The same without shape_integral and complexity, which are half of the cost.
template <int Dim>
Report measure_lengths_and_shapes(const Mesh<Dim>& mesh, const MetricField<Dim>& field);

/// The report as JSON text (two-space indent, keys as in docs/report.md), without a line break at the end. Numbers read
/// back exactly; what is not finite is written as null.
std::string to_json(const Report& report);

/// The most memory that this process has held so far; 0 where the system does not tell (WebAssembly).
std::int64_t peak_memory_bytes();

}  // namespace pillowmesh
