// Corner Jacobians: the sign that decides whether a cell is inside out.
#pragma once

#include <cmath>

#include <array>

#include "pillowmesh/mesh/mesh.h"

namespace pillowmesh {

/// a x b in 2D, a . (b x c) in 3D, of the edge vectors out of a corner in axis order.
inline double cross(const Point<2>& a, const Point<2>& b) { return a[0] * b[1] - a[1] * b[0]; }
inline Point<3> vector_product(const Point<3>& a, const Point<3>& b) {
  return Point<3>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
inline double triple(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Jacobian determinant of the multilinear map at corner k of a cell whose corner i is at position(i). Unit: length^Dim.
template <int Dim, class Position>
double corner_jacobian(int k, Position&& position) {
  const Point<Dim> o = position(k);
  std::array<Point<Dim>, Dim> e;
  for (int d = 0; d < Dim; ++d) e[d] = position(k ^ (1 << d)) - o;
  if constexpr (Dim == 2)
    return Cell<2>::corner_sign(k) * cross(e[0], e[1]);
  else
    return Cell<3>::corner_sign(k) * triple(e[0], e[1], e[2]);
}

/// The smallest of the corner Jacobians of a cell. Positive in every valid mesh.
template <int Dim, class Position>
double min_corner_jacobian(Position&& position) {
  double lowest = corner_jacobian<Dim>(0, position);
  for (int k = 1; k < Cell<Dim>::corners; ++k) {
    const double j = corner_jacobian<Dim>(k, position);
    if (!(j >= lowest)) lowest = j;
  }
  return lowest;
}

template <int Dim>
double min_corner_jacobian(const Mesh<Dim>& mesh, CellId c) {
  return min_corner_jacobian<Dim>([&](int i) -> const Point<Dim>& { return mesh.points[mesh.cells[c][i]]; });
}

/// The smallest of the corner Jacobians of a cell, each divided by the lengths of its edges: 1 for a box, 0 degenerate.
template <int Dim, class Position>
double min_scaled_jacobian(Position&& position) {
  double lowest = 1.0;
  for (int k = 0; k < Cell<Dim>::corners; ++k) {
    double lengths2 = 1.0;
    for (int d = 0; d < Dim; ++d) lengths2 *= (position(k ^ (1 << d)) - position(k)).squaredNorm();
    const double j = corner_jacobian<Dim>(k, position) / std::sqrt(lengths2);
    if (!(j >= lowest)) lowest = j;
  }
  return lowest;
}

template <int Dim>
double min_scaled_jacobian(const Mesh<Dim>& mesh, CellId c) {
  return min_scaled_jacobian<Dim>([&](int i) -> const Point<Dim>& { return mesh.points[mesh.cells[c][i]]; });
}

/// Jacobian determinant of the trilinear map of a hexahedron at local coordinates `at`, each 0 to 1.
template <class Position>
double jacobian_at(const std::array<double, 3>& at, Position&& position) {
  using C = Cell<3>;
  std::array<Point<3>, 3> along;
  for (int axis = 0; axis < 3; ++axis) {
    along[axis] = Point<3>::Zero();
    for (int k = 0; k < C::edges_per_axis; ++k) {
      const int from = C::insert_bit(k, axis);
      double weight = 1.0;
      for (int d = 0; d < 3; ++d)
        if (d != axis) weight *= (from >> d) & 1 ? at[d] : 1 - at[d];
      along[axis] += weight * (position(from | 1 << axis) - position(from));
    }
  }
  return triple(along[0], along[1], along[2]);
}

/// What the Jacobians of a hexahedron's trilinear map say of it, at the lattice of 3 x 3 x 3 points whose local
/// coordinates are 0, 1/2 or 1.
struct LatticeJacobians {
  double lowest;  ///< of all: not above the lowest of the corners, and nearly the lowest of all points
  double corner;  ///< min_corner_jacobian
  double scaled;  ///< min_scaled_jacobian
};

/// All at once: they share the edges, and the corners are points of the lattice.
template <class Position>
LatticeJacobians lattice_jacobians(Position&& position) {
  using C = Cell<3>;
  // Per axis, the derivative along it at the 3 x 3 places in the plane of the other two: it is constant along the axis.
  std::array<std::array<Point<3>, 9>, 3> along;
  for (int axis = 0; axis < 3; ++axis) {
    auto& at = along[axis];
    for (int k = 0; k < C::edges_per_axis; ++k) {
      const int from = C::insert_bit(k, axis);
      at[2 * (k & 1) + 6 * (k >> 1)] = position(from | 1 << axis) - position(from);
    }
    at[1] = 0.5 * (at[0] + at[2]);
    at[7] = 0.5 * (at[6] + at[8]);
    for (int i = 0; i < 3; ++i) at[3 + i] = 0.5 * (at[i] + at[6 + i]);
  }
  const auto lower = [](double& lowest, double d) {
    if (!(d >= lowest)) lowest = d;
  };
  LatticeJacobians found;
  found.lowest = found.corner = triple(along[0][0], along[1][0], along[2][0]);
  found.scaled = 1.0;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        const Point<3>&a = along[0][y + 3 * z], &b = along[1][x + 3 * z], &c = along[2][x + 3 * y];
        const double d = triple(a, b, c);
        lower(found.lowest, d);
        if (x == 1 || y == 1 || z == 1) continue;
        lower(found.corner, d);
        lower(found.scaled, d / std::sqrt(a.squaredNorm() * b.squaredNorm() * c.squaredNorm()));
      }
  return found;
}

template <class Position>
double min_lattice_jacobian(Position&& position) {
  return lattice_jacobians(position).lowest;
}

}  // namespace pillowmesh
