#include "q1.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <array>
#include <cmath>

namespace solver {
namespace {

using pillowmesh::Cell;
using pillowmesh::CellId;
using pillowmesh::VertexId;

struct Gauss {
  std::vector<double> at, weight;  ///< on [0, 1]
};
const Gauss& gauss(int points) {
  static const double a = 0.5 * std::sqrt(0.6), s = 2 * std::sqrt(10.0 / 7.0);
  static const double b = std::sqrt(5 - s) / 6, c = std::sqrt(5 + s) / 6;
  static const double u = (322 + 13 * std::sqrt(70.0)) / 1800, v = (322 - 13 * std::sqrt(70.0)) / 1800;
  static const Gauss three{{0.5 - a, 0.5, 0.5 + a}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};
  static const Gauss five{{0.5 - c, 0.5 - b, 0.5, 0.5 + b, 0.5 + c}, {v, u, 64.0 / 225, u, v}};
  return points == 3 ? three : five;
}

/// The shape functions of a cell at one point of integration.
template <int Dim>
struct Shapes {
  std::array<double, Cell<Dim>::corners> value;
  std::array<Point<Dim>, Cell<Dim>::corners> gradient;
  Point<Dim> x;
  double weight;  ///< of the integration, times the Jacobian
};

/// Calls visit(shapes) at the points of integration of cell c.
template <int Dim, class Visit>
void integrate(const Mesh<Dim>& mesh, CellId c, int points, Visit&& visit) {
  constexpr int corners = Cell<Dim>::corners;
  const Gauss& rule = gauss(points);
  int all = 1;
  for (int d = 0; d < Dim; ++d) all *= points;
  for (int q = 0; q < all; ++q) {
    Shapes<Dim> s;
    s.weight = 1.0;
    std::array<double, Dim> xi;
    for (int d = 0, rest = q; d < Dim; ++d, rest /= points) {
      xi[d] = rule.at[rest % points];
      s.weight *= rule.weight[rest % points];
    }
    Eigen::Matrix<double, Dim, Dim> jacobian = Eigen::Matrix<double, Dim, Dim>::Zero();
    std::array<Point<Dim>, corners> local;
    s.x.setZero();
    for (int k = 0; k < corners; ++k) {
      s.value[k] = 1.0;
      for (int d = 0; d < Dim; ++d) s.value[k] *= (k >> d) & 1 ? xi[d] : 1 - xi[d];
      for (int d = 0; d < Dim; ++d) {
        local[k][d] = (k >> d) & 1 ? 1.0 : -1.0;
        for (int o = 0; o < Dim; ++o)
          if (o != d) local[k][d] *= (k >> o) & 1 ? xi[o] : 1 - xi[o];
      }
      const Point<Dim>& p = mesh.points[mesh.cells[c][k]];
      s.x += s.value[k] * p;
      for (int d = 0; d < Dim; ++d) jacobian.col(d) += local[k][d] * p;
    }
    s.weight *= jacobian.determinant();
    const Eigen::Matrix<double, Dim, Dim> inverse = jacobian.inverse().transpose();
    for (int k = 0; k < corners; ++k) s.gradient[k] = inverse * local[k];
    visit(s);
  }
}

/// tau of streamline upwinding.
double upwinding(double speed, double length, double diffusion) {
  const double peclet = 0.5 * speed * length / diffusion;
  if (!(peclet > 1e-6)) return 0.0;
  const double share = peclet < 1e-2 ? peclet / 3 : (1 / std::tanh(peclet) - 1 / peclet);
  return 0.5 * length / speed * share;
}

}  // namespace

template <int Dim>
std::vector<double> solve(const Mesh<Dim>& mesh, const Problem<Dim>& problem) {
  constexpr int corners = Cell<Dim>::corners;
  const int n = mesh.vertex_count();
  // Unknowns are the vertices inside; the others have their value.
  std::vector<int> unknown(n, -1);
  std::vector<double> values(n, 0.0);
  std::vector<bool> on_boundary(n, false);
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; mesh.alive(c) && f < Cell<Dim>::facets; ++f)
      if (mesh.on_boundary(c, f))
        for (const VertexId v : mesh.facet_vertices(c, f)) on_boundary[v] = true;
  int count = 0;
  for (VertexId v = 0; v < n; ++v) {
    if (mesh.vertex_cell[v] == pillowmesh::kNone) continue;
    if (on_boundary[v])
      values[v] = problem.boundary ? problem.boundary(mesh.points[v]) : 0.0;
    else
      unknown[v] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    const auto& cell = mesh.cells[c];
    Eigen::Matrix<double, corners, corners> matrix = Eigen::Matrix<double, corners, corners>::Zero();
    Eigen::Matrix<double, corners, 1> vector = Eigen::Matrix<double, corners, 1>::Zero();
    integrate<Dim>(mesh, c, 3, [&](const Shapes<Dim>& s) {
      const Point<Dim> b = problem.velocity ? problem.velocity(s.x) : Point<Dim>(Point<Dim>::Zero());
      const double f = problem.source ? problem.source(s.x) : 0.0;
      const double speed = b.norm();
      double tau = 0.0;
      if (speed > 0) {
        double across = 0.0;  // sum |b . grad w| = 2 |b| / h for a box
        for (const auto& g : s.gradient) across += std::abs(b.dot(g));
        tau = upwinding(speed, 2 * speed / across, problem.diffusion);
      }
      for (int i = 0; i < corners; ++i) {
        const double test = s.value[i] + tau * b.dot(s.gradient[i]);
        vector[i] += s.weight * f * test;
        for (int j = 0; j < corners; ++j)
          matrix(i, j) +=
              s.weight * (problem.diffusion * s.gradient[i].dot(s.gradient[j]) + b.dot(s.gradient[j]) * test);
      }
    });
    for (int i = 0; i < corners; ++i) {
      const int row = unknown[cell[i]];
      if (row < 0) continue;
      right[row] += vector[i];
      for (int j = 0; j < corners; ++j) {
        if (unknown[cell[j]] >= 0)
          entries.emplace_back(row, unknown[cell[j]], matrix(i, j));
        else
          right[row] -= matrix(i, j) * values[cell[j]];
      }
    }
  }
  Eigen::SparseMatrix<double> system(count, count);
  system.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd found;
  bool solved = true;
  const auto solve_by = [&](auto&& method) {
    method.compute(system);
    solved = method.info() == Eigen::Success;
    if (solved) found = method.solve(right);
  };
  if (count > 0) {
    if (problem.velocity)
      solve_by(Eigen::SparseLU<Eigen::SparseMatrix<double>>());
    else
      solve_by(Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>());
  }
  if (!solved) return {};
  for (VertexId v = 0; v < n; ++v)
    if (unknown[v] >= 0) values[v] = found[unknown[v]];
  return values;
}

template <int Dim>
double l2_error(const Mesh<Dim>& mesh, const std::vector<double>& values,
                const std::function<double(const Point<Dim>&)>& exact) {
  double sum = 0.0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    integrate<Dim>(mesh, c, 5, [&](const Shapes<Dim>& s) {
      double u = 0.0;
      for (int k = 0; k < Cell<Dim>::corners; ++k) u += s.value[k] * values[mesh.cells[c][k]];
      sum += s.weight * (u - exact(s.x)) * (u - exact(s.x));
    });
  }
  return std::sqrt(sum);
}

template std::vector<double> solve(const Mesh<2>&, const Problem<2>&);
template std::vector<double> solve(const Mesh<3>&, const Problem<3>&);
template double l2_error(const Mesh<2>&, const std::vector<double>&, const std::function<double(const Point<2>&)>&);
template double l2_error(const Mesh<3>&, const std::vector<double>&, const std::function<double(const Point<3>&)>&);

}  // namespace solver
