// Properties that tests ask of meshes, whatever made them.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/length.h"

namespace checks {

using namespace pillowmesh;

/// Euler characteristic: 1 for a disc or ball, 0 for an annulus.
template <int Dim>
Index euler(const Mesh<Dim>& mesh) {
  Index boundary = 0, cells = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    ++cells;
    for (int f = 0; f < Cell<Dim>::facets; ++f) boundary += mesh.on_boundary(c, f);
  }
  const Index facets = (cells * Cell<Dim>::facets + boundary) / 2;
  const Index edges = static_cast<Index>(unique_edges(mesh).size());
  return Dim == 2 ? mesh.vertex_count() - edges + cells : mesh.vertex_count() - edges + facets - cells;
}

/// Relative error of the quick decision whether an edge is long, at kinks of the metric.
inline constexpr double kTagging = 1e-4;

/// Metric length of the longest edge, integrated.
template <int Dim>
double longest_edge(const Mesh<Dim>& mesh, const MetricField<Dim>& field) {
  const auto edges = unique_edges(mesh);
  std::vector<double> lengths(edges.size());
  LengthOptions options;
  options.panel = default_panel<Dim>(mesh.points);
  edge_lengths<Dim>(field, mesh.points, edges, lengths, options);
  return *std::max_element(lengths.begin(), lengths.end());
}

/// Length (2D) or area (3D, planar facets) of the boundary by group number.
template <int Dim>
std::map<Index, double> boundary_by_group(const Mesh<Dim>& mesh) {
  std::map<Index, double> sum;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; f < Cell<Dim>::facets; ++f) {
      if (!mesh.alive(c) || !mesh.on_boundary(c, f)) continue;
      const auto v = mesh.facet_vertices(c, f);
      double size = 0.0;
      if constexpr (Dim == 2) {
        size = (mesh.points[v[1]] - mesh.points[v[0]]).norm();
      } else {
        const Point<3> a = mesh.points[v[3]] - mesh.points[v[0]], b = mesh.points[v[2]] - mesh.points[v[1]];
        const Point<3> n(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
        size = 0.5 * n.norm();
      }
      sum[mesh.patch_groups[mesh.patch_of(c, f)].tag] += size;
    }
  return sum;
}

/// Area of the quads: with positive Jacobians, that of the domain if and only if they do not overlap.
inline double area(const Mesh<2>& mesh) {
  double sum = 0.0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    const auto& k = mesh.cells[c];
    sum += 0.5 * cross(mesh.points[k[3]] - mesh.points[k[0]], mesh.points[k[2]] - mesh.points[k[1]]);
  }
  return sum;
}

/// How far the boundary vertices are from the domain's boundary, at the most.
template <int Dim>
double distance_from_geometry(const Mesh<Dim>& mesh) {
  double most = 0.0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.support[v].dim == 0 || mesh.support[v].dim == Dim) continue;
    Index anchor = mesh.anchor[v];
    most = std::max(most, (slide(*mesh.geometry, mesh.support[v], anchor, mesh.points[v]) - mesh.points[v]).norm());
  }
  return most;
}

}  // namespace checks
