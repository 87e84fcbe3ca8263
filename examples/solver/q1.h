// A small finite element solver: multilinear elements on quads and hexahedra, diffusion and advection with streamline
// upwinding. It shows what a solver needs of pillowmesh, and how little that is.
#pragma once

#include <pillowmesh/mesh/boundary.h>

#include <functional>
#include <vector>

namespace solver {

using pillowmesh::Mesh;
using pillowmesh::Point;

/// -diffusion Lap u + velocity . grad u = source inside, u = boundary on the whole boundary.
template <int Dim>
struct Problem {
  double diffusion = 1.0;
  std::function<Point<Dim>(const Point<Dim>&)> velocity;  ///< none: pure diffusion
  std::function<double(const Point<Dim>&)> source;        ///< none: zero
  std::function<double(const Point<Dim>&)> boundary;
};

/// Values at the vertices of the mesh (zero at those that no cell uses); empty when the linear system cannot be solved.
/// Galerkin with Q1 elements and three Gauss points per axis. With a velocity b each test function w is replaced by
/// w + tau b . grad w, tau = h / (2 |b|) (coth P - 1 / P) with the cell Peclet number P = |b| h / (2 diffusion) and h
/// the cell's length along b (Brooks and Hughes, "Streamline upwind/Petrov-Galerkin formulations", 1982). The Laplacian
/// of Q1 functions inside a cell is taken as zero there.
template <int Dim>
std::vector<double> solve(const Mesh<Dim>& mesh, const Problem<Dim>& problem);

/// The L2 norm of the difference between the Q1 function of `values` and a function, by five Gauss points per axis.
template <int Dim>
double l2_error(const Mesh<Dim>& mesh, const std::vector<double>& values,
                const std::function<double(const Point<Dim>&)>& exact);

}  // namespace solver
