#include "pillowmesh/quality/report.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/metric/line_integral.h"
#include "pillowmesh/metric/volume.h"
#include "pillowmesh/quality/jacobian.h"
#include "pillowmesh/quality/shape.h"
#include "pillowmesh/quality/valence.h"

#if !defined(__wasm__) && __has_include(<sys/resource.h>)
#include <sys/resource.h>
#define PILLOWMESH_HAS_RUSAGE 1
#endif

namespace pillowmesh {
namespace {

/// In units of the panel that misses nothing wider than a thousandth of the domain. The cells of an adapted mesh are as small
/// as the features there ask for, and their edges shorter than a panel; on other meshes to look that closely takes most
/// of the time.
template <int Dim>
constexpr double kPanel = Dim == 2 ? 2.0 : 1.0;

// Nothing that walks the mesh is safe on such defects.
template <int Dim>
bool walkable(const std::vector<Defect>& defects) {
  for (const Defect& d : defects) {
    if (d.kind == Defect::Kind::index_out_of_range || d.kind == Defect::Kind::broken_adjacency) return false;
  }
  return true;
}

Statistics length_statistics(std::span<const LineIntegral> integrals) {
  std::vector<double> lengths;
  lengths.reserve(integrals.size());
  for (const LineIntegral& i : integrals) lengths.push_back(i.length);
  return statistics(lengths);
}

/// Of the anisotropic edges: for an edge of direction e, sin^2(2 phi) = 4 c (1 - c) with c the share of one eigenvector
/// in e, and with r = det |e|^2 / (e' M e) that is 4 (r (t - r) - det) / (t^2 - 4 det), t = tr M.
double mean_misalignment(const Mesh<2>& mesh, const MetricField<2>& field, const EdgeTable& edges) {
  double sum = 0.0;
  std::int64_t count = 0;
  PointLanes<2> middles;
  TensorLanes<2> tensors;
  for (Index start = 0; start < edges.size(); start += kLanes) {
    const int used = std::min(kLanes, edges.size() - start);
    for (int i = 0; i < used; ++i) {
      const auto& [a, b] = edges[start + i];
      for (int d = 0; d < 2; ++d) middles[d][i] = 0.5 * (mesh.points[a][d] + mesh.points[b][d]);
    }
    field.evaluate(middles, used, tensors);
    for (int i = 0; i < used; ++i) {
      const auto& [a, b] = edges[start + i];
      const Point<2> e = mesh.points[b] - mesh.points[a];
      const SymTensor<2> M{{tensors[0][i], tensors[1][i], tensors[2][i]}};
      const double t = M.m[0] + M.m[2], det = determinant(M);
      // The eigenvalues' ratio is above 2^2 where t^2 / det is above (4 + 1)^2 / 4.
      if (!(t * t > 6.25 * det) || e.squaredNorm() == 0.0) continue;
      const double r = det * e.squaredNorm() / dot(M, e, e);
      sum += 4.0 * (r * (t - r) - det) / (t * t - 4.0 * det);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

template <int Dim>
void measure_cells(const Mesh<Dim>& mesh, const MetricField<Dim>& field, std::span<const CellId> cells,
                   const LineOptions& options, const EdgeIntegrals<Dim>& edges, bool volumes, Report& report) {
  report.cells = static_cast<Index>(cells.size());
  std::vector<double> values(cells.size());
  {
    std::vector<double> integral(volumes ? cells.size() : 0);
    cell_shapes<Dim>(mesh, field, cells, values, integral, options, &edges, volumes ? &report.complexity : nullptr);
    report.shape = statistics(values);
    report.shape_integral = statistics(integral);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) values[i] = scaled_jacobian(mesh, cells[i]);
  const Statistics jacobian = statistics(values);
  report.scaled_jacobian_min = jacobian.min;
  report.scaled_jacobian_mean = jacobian.mean;
}

template <int Dim>
Report measure_all(const Mesh<Dim>& mesh, const MetricField<Dim>& field, bool volumes) {
  Report report;
  report.dim = Dim;
  for (const CellId c : mesh.vertex_cell) report.vertices += c != kNone ? 1 : 0;
  const std::vector<Defect> defects = find_defects(mesh);
  report.valid = defects.empty();
  if (!report.valid) report.defect = defects[0].message;
  if (!walkable<Dim>(defects)) return report;

  const LineOptions options{.panel = kPanel<Dim> * default_panel<Dim>(mesh.points)};
  const std::vector<CellId> cells = live_cells(mesh);
  const EdgeIntegrals<Dim> edges = edge_integrals<Dim>(mesh, field, cells, options);
  report.edges = edges.edges.size();
  report.edge_length = length_statistics(edges.along);
  measure_cells<Dim>(mesh, field, cells, options, edges, volumes, report);
  if constexpr (Dim == 2) report.misalignment = mean_misalignment(mesh, field, edges.edges);
  for (const unsigned char mark : irregular_vertices(mesh)) report.irregular_vertices += mark;
  if (Dim == 3 && volumes) {
    // Errors of many cells cancel each other: the sum is as exact as that over a few dozen.
    const double many = std::clamp(std::sqrt(report.cells) / 8.0, 1.0, 10.0);
    report.complexity = complexity(mesh, field, VolumeOptions::for_panel(3, options.panel, 3e-4 * many));
  }
  return report;
}

}  // namespace

template <int Dim>
Report measure(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  return measure_all(mesh, field, true);
}

template <int Dim>
Report measure_lengths_and_shapes(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  return measure_all(mesh, field, false);
}

// VmHWM rather than getrusage where there is /proc: Linux counts in the latter what the process held before it became
// this program.
std::int64_t peak_memory_bytes() {
#ifdef __linux__
  if (std::FILE* file = std::fopen("/proc/self/status", "r")) {
    char line[256];
    long long kilobytes = -1;
    while (kilobytes < 0 && std::fgets(line, sizeof line, file) != nullptr) {
      if (std::strncmp(line, "VmHWM:", 6) == 0) std::sscanf(line + 6, "%lld", &kilobytes);
    }
    std::fclose(file);
    if (kilobytes > 0) return kilobytes * 1024;
  }
#endif
#ifdef PILLOWMESH_HAS_RUSAGE
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0) {
#ifdef __APPLE__
    return usage.ru_maxrss;
#else
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
#endif
  }
#endif
  return 0;
}

template Report measure<2>(const Mesh<2>&, const MetricField<2>&);
template Report measure<3>(const Mesh<3>&, const MetricField<3>&);
template Report measure_lengths_and_shapes<2>(const Mesh<2>&, const MetricField<2>&);
template Report measure_lengths_and_shapes<3>(const Mesh<3>&, const MetricField<3>&);

}  // namespace pillowmesh
