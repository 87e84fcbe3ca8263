// Metric volume of cells and simplices: the integral of sqrt(det M). In 2D "volume" is area.
#pragma once

#include <array>
#include <span>

#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/metric/field.h"

namespace pillowmesh {

/// The image of the unit square or cube under the multilinear map that these corners (corner-bit order) define.
/// Corners may coincide: that is how a simplex is one.
template <int Dim>
using CornerPoints = std::array<Point<Dim>, Cell<Dim>::corners>;

template <int Dim>
using SimplexPoints = std::array<Point<Dim>, Dim + 1>;

/// The simplex p0, p1, ... as a collapsed cell (Duffy's transformation).
template <int Dim>
CornerPoints<Dim> collapsed_simplex(const SimplexPoints<Dim>& p);

struct VolumeOptions {
  /// Relative error aimed at.
  double tolerance = 1e-4;
  /// Pieces longer than this are divided before anything is compared, to the 16th (2D) or half (3D) of an edge at most:
  /// narrow features of the metric must not fall between the sample points. 0: one piece per cell.
  double panel = 0.0;

  /// As finely as `length_panel` looks at edges, but for the cost: 4 (2D) or 16 times (3D) as coarse.
  static VolumeOptions for_panel(int dim, double length_panel, double tolerance) {
    return {.tolerance = tolerance, .panel = (dim == 2 ? 4.0 : 16.0) * length_panel};
  }
};

/// Metric volume of each cell; negative where the map is inside out. Gauss rules of 2^Dim and 3^Dim points, divided
/// where they disagree. Memory does not grow with the number of cells. \pre volumes.size() == cells.size()
template <int Dim>
void metric_volumes(const MetricField<Dim>& field, std::span<const CornerPoints<Dim>> cells, std::span<double> volumes,
                    const VolumeOptions& options = {});

/// The same of tetrahedra, to rounding what metric_volumes makes of them collapsed, in a fraction of the time. In 2D see
/// quad_area.h.
void simplex_volumes(const MetricField<3>& field, std::span<const SimplexPoints<3>> simplices, std::span<double> volumes,
                     const VolumeOptions& options = {});

/// Metric volume of the mesh: the number of cells of an ideal one.
template <int Dim>
double complexity(const Mesh<Dim>& mesh, const MetricField<Dim>& field, const VolumeOptions& options = {});

}  // namespace pillowmesh
