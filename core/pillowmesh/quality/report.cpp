#include "pillowmesh/quality/report.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/mesh/validate.h"
#include "pillowmesh/metric/length.h"
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

// Nothing that walks the mesh is safe on such defects.
template <int Dim>
bool walkable(const std::vector<Defect>& defects) {
  for (const Defect& d : defects) {
    if (d.kind == Defect::Kind::index_out_of_range || d.kind == Defect::Kind::broken_adjacency) return false;
  }
  return true;
}

/// All edges in the order of KnownLengths.
template <int Dim>
std::vector<std::array<VertexId, 2>> sorted_edges(const Mesh<Dim>& mesh) {
  std::vector<std::array<VertexId, 2>> edges = unique_edges(mesh);
  for (auto& e : edges)
    if (e[1] < e[0]) std::swap(e[0], e[1]);
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Of the anisotropic edges: for an edge of direction e, sin^2(2 phi) = 4 c (1 - c) with c the share of one eigenvector
/// in e, and with r = det |e|^2 / (e' M e) that is 4 (r (t - r) - det) / (t^2 - 4 det), t = tr M.
double mean_misalignment(const Mesh<2>& mesh, const MetricField<2>& field, std::span<const std::array<VertexId, 2>> edges) {
  double sum = 0.0;
  std::int64_t count = 0;
  std::vector<Point<2>> middles(edges.size());
  std::vector<SymTensor<2>> tensors(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) middles[i] = 0.5 * (mesh.points[edges[i][0]] + mesh.points[edges[i][1]]);
  field.evaluate(middles, tensors);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Point<2> e = mesh.points[edges[i][1]] - mesh.points[edges[i][0]];
    const SymTensor<2>& M = tensors[i];
    const double t = M.m[0] + M.m[2], det = determinant(M);
    // The eigenvalues' ratio is above 2^2 where t^2 / det is above (4 + 1)^2 / 4.
    if (!(t * t > 6.25 * det)) continue;
    const double r = det * e.squaredNorm() / dot(M, e, e);
    sum += 4.0 * (r * (t - r) - det) / (t * t - 4.0 * det);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

template <int Dim>
void measure_cells(const Mesh<Dim>& mesh, const MetricField<Dim>& field, const LengthOptions& options,
                   const KnownLengths& known, Report& report) {
  std::vector<CellId> cells;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.alive(c)) cells.push_back(c);
  }
  report.cells = static_cast<Index>(cells.size());
  std::vector<double> values(cells.size());
  {
    std::vector<double> integral(cells.size());
    cell_shapes<Dim>(mesh, field, cells, values, integral, options, known, &report.complexity);
    report.shape = statistics(values);
    report.shape_integral = statistics(integral);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) values[i] = scaled_jacobian(mesh, cells[i]);
  const Statistics jacobian = statistics(values);
  report.scaled_jacobian_min = jacobian.min;
  report.scaled_jacobian_mean = jacobian.mean;
}

}  // namespace

template <int Dim>
Report measure(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  Report report;
  report.dim = Dim;
  for (const CellId c : mesh.vertex_cell) report.vertices += c != kNone ? 1 : 0;
  const std::vector<Defect> defects = find_defects(mesh);
  report.valid = defects.empty();
  if (!report.valid) report.defect = defects[0].message;
  if (!walkable<Dim>(defects)) return report;

  const LengthOptions options{.tolerance = 1e-5, .panel = default_panel<Dim>(mesh.points)};
  const std::vector<std::array<VertexId, 2>> edges = sorted_edges(mesh);
  std::vector<double> lengths(edges.size());
  edge_lengths<Dim>(field, mesh.points, edges, lengths, options);
  report.edges = static_cast<Index>(edges.size());
  report.edge_length = statistics(lengths);
  measure_cells(mesh, field, options, {edges, lengths}, report);
  if constexpr (Dim == 2) report.misalignment = mean_misalignment(mesh, field, edges);
  for (const unsigned char mark : irregular_vertices(mesh)) report.irregular_vertices += mark;
  if constexpr (Dim == 3) {
    // Errors of many cells cancel each other: the sum is as exact as that over a few dozen.
    const double many = std::clamp(std::sqrt(report.cells) / 8.0, 1.0, 10.0);
    report.complexity = complexity(mesh, field, VolumeOptions::for_panel(3, options.panel, 3e-4 * many));
  }
  return report;
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

}  // namespace pillowmesh
