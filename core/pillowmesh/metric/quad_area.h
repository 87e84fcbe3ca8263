// Metric areas of the corner triangles of quadrilaterals, all four at the cost of less than one and a half.
#pragma once

#include <array>
#include <span>

#include "pillowmesh/metric/line_integral.h"
#include "pillowmesh/metric/volume.h"

namespace pillowmesh {

/// Metric area of the triangle at each corner (corner-bit order), of a corner and its two neighbours; negative where it is
/// inside out. Two at opposite corners make the quadrilateral.
using CornerAreas = std::array<double, 4>;

/// The diagonals divide a convex quadrilateral in four, of which each corner triangle is two: each of those is integrated
/// once, with Radon's rule of 7 points (exact to degree 5), halved where a rule of degree 2 differs from it by more than
/// three tolerances. The error of an area is about the tolerance; at kinks, which the points may miss, some times that.
/// Memory does not grow with the number of quadrilaterals. \pre areas.size() == quads.size()
void quad_areas(const MetricField<2>& field, std::span<const CornerPoints<2>> quads, std::span<CornerAreas> areas,
                const VolumeOptions& options = {});

/// The sides of a quadrilateral between the corners 01, 02, 13, 23, and its diagonals 03, 12.
struct QuadLines {
  LineIntegral s01, s02, s13, s23, d03, d12;
};

/// The same areas to about the tolerance, where sides and diagonals have been integrated: four evaluations for each
/// quadrilateral, by a rule of degree 3 that takes the means over the sides of a triangle and its centroid. Where a rule of
/// degree 2 differs from it by more than three tolerances, as above, in panels only where a triangle is higher than one.
/// \pre lines.size() == quads.size()
void quad_areas(const MetricField<2>& field, std::span<const CornerPoints<2>> quads, std::span<const QuadLines> lines,
                std::span<CornerAreas> areas, const VolumeOptions& options = {});

}  // namespace pillowmesh
