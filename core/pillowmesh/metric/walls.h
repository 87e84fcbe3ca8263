// Metrics from the boundary of the domain: layers along walls, cells that resolve curvature.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pillowmesh/metric/nodal.h"

namespace pillowmesh {

/// A boundary layer: the cells at the wall are `first` high, each next one `growth` times as high, so that the height
/// at the distance d is first + (growth - 1) d. Along the wall the size is `along`, which the height does not pass
/// either.
struct WallLayer {
  std::string group;  ///< name or number of the boundary groups; "all" for every one
  double first = 0.0;
  double growth = 1.2;
  double along = 0.0;
};

/// Reads "wall:0.001:1.3". `along` is left 0. \return usage when malformed
Expected<WallLayer> parse_wall_layer(std::string_view text);

/// The metric of layers, on a background sampled over the box around the mesh: across the wall, in the direction of the
/// nearest point of the boundary, its height; along it `along`. Layers of several walls intersect.
/// \return usage that lists the groups when there is none of that name
template <int Dim>
Expected<NodalMetric<Dim>> wall_metric(const Mesh<Dim>& mesh, const std::vector<WallLayer>& layers);

/// At each boundary curve of radius R the size 2 pi R / per_turn, so that a full circle gets `per_turn` cells; away
/// from it sizes grow by (growth - 1) times the distance, up to `largest`. The radius at a vertex is that of the circle
/// through it and its neighbours on the curve; corners have none. \return bad_input when no boundary curve is curved
Expected<NodalMetric<2>> curvature_metric(const Mesh<2>& mesh, double per_turn, double growth, double largest);

/// The metric that a mesh has, in which its own cells are about unit: at each vertex the log-Euclidean mean over its
/// cells of (J J')^-1, J holding a cell's mean edge vectors, weighted by volume.
template <int Dim>
NodalMetric<Dim> implied_metric(const Mesh<Dim>& mesh);

}  // namespace pillowmesh
