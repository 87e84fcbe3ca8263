// Plane sections of simple domains, and the prisms over them.
#pragma once

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

// Each side of a section is a facet group of its own. Points on arcs lie on their circle but for rounding, and on the
// axes exactly. Cost: linear. \pre counts of at least 1, lengths above 0 in the order stated; as in parse_primitive.

/// Disk of `radius` about the origin: a core of n x n quads with bulging sides, and m rings of 4 n quads around it.
/// Irregular are the four corners of the core, with three quads each. Group: side.
///
///          _.---._
///        .'\     /'.
///       /   +---+   \        n = 1, m = 1
///       \   +---+   /
///        './_____\.'
///
MeshInput<2> disk_section(int n, int m, double radius);

/// Ring between two radii about the origin: n quads around, m across. Groups: inner, outer. \pre inner < outer, n >= 3
MeshInput<2> ring_section(int n, int m, double inner, double outer);

/// The square [0, side]^2 without the disk of `radius` about the origin: n quads along each far side, 2 n along the
/// arc, m from the arc outward. The lines of the mesh that leave the arc are radial. Groups: hole, ymin, xmax, ymax,
/// xmin. \pre radius < side
///
///       +-------+
///       |\   _.'|
///       |_\.'_.-|            n = 1, m = 1 (two quads)
///         '.   _|
///           \___|
///
MeshInput<2> quarter_section(int n, int m, double radius, double side);

/// The square [0, side]^2 without [arm, side]^2: an L. n quads along each long side, m of them across an arm.
/// Groups: xmin, xmid, xmax, ymin, ymid, ymax. \pre m < n, arm < side
MeshInput<2> ell_section(int n, int m, double side, double arm);

/// The prism over a section: `layers` equal layers from z = low to z = high. Groups: those of the section, zmin, zmax.
/// \pre low < high
MeshInput<3> extrude(const MeshInput<2>& section, int layers, double low, double high);

}  // namespace pillowmesh
