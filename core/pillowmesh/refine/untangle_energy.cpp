#include "pillowmesh/refine/untangle_energy.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/jacobian.h"

namespace pillowmesh {
namespace {

/// Weight of the size term against the shape term: enough that no cell shrinks to nothing beside others.
constexpr double size_weight = 0.2;

template <int Dim>
using EdgeVectors = std::array<Point<Dim>, Cell<Dim>::edges>;

template <int Dim, class Position>
EdgeVectors<Dim> edge_vectors(Position&& position) {
  EdgeVectors<Dim> e;
  for (int i = 0; i < Cell<Dim>::edges; ++i)
    e[i] = position(Cell<Dim>::edge_to(i)) - position(Cell<Dim>::edge_from(i));
  return e;
}

template <int Dim>
SquareMatrix<Dim> jacobian(const EdgeVectors<Dim>& e, int sample) {
  using C = Cell<Dim>;
  SquareMatrix<Dim> A;
  if (sample < C::corners) {
    for (int axis = 0; axis < Dim; ++axis) A.col(axis) = e[C::edge_at(sample, axis)];
    return A;
  }
  const auto& weight = sample_points<Dim>().weight[sample];
  for (int axis = 0; axis < Dim; ++axis) {
    Point<Dim> sum = weight[axis][0] * e[C::edge(axis, 0)];
    for (int k = 1; k < C::edges_per_axis; ++k) sum += weight[axis][k] * e[C::edge(axis, k)];
    A.col(axis) = sum;
  }
  return A;
}

inline SquareMatrix<2> cofactor(const SquareMatrix<2>& J) {
  SquareMatrix<2> c;
  c << J(1, 1), -J(1, 0), -J(0, 1), J(0, 0);
  return c;
}
inline SquareMatrix<3> cofactor(const SquareMatrix<3>& J) {
  SquareMatrix<3> c;
  for (int i = 0; i < 3; ++i)
    c.col(i) = vector_product(Point<3>(J.col((i + 1) % 3)), Point<3>(J.col((i + 2) % 3)));
  return c;
}

/// Plain loops, so that sums are taken in one order on every machine.
template <int Dim>
SquareMatrix<Dim> product(const SquareMatrix<Dim>& A, const SquareMatrix<Dim>& B) {
  SquareMatrix<Dim> out;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) {
      double sum = A(i, 0) * B(0, j);
      for (int k = 1; k < Dim; ++k) sum += A(i, k) * B(k, j);
      out(i, j) = sum;
    }
  return out;
}

template <int Dim>
double determinant_of(const SquareMatrix<Dim>& J, const SquareMatrix<Dim>& c) {
  double sum = J(0, 0) * c(0, 0);
  for (int k = 1; k < Dim; ++k) sum += J(k, 0) * c(k, 0);
  return sum;
}

template <int Dim>
SamplePoints<Dim> make_sample_points() {
  using C = Cell<Dim>;
  SamplePoints<Dim> out{};
  int at = C::corners;
  for (int i = 0; i < (Dim == 2 ? 9 : 27); ++i) {
    const std::array<int, 3> t{i % 3, i / 3 % 3, i / 9};
    int corner = 0;
    bool inner = false;
    for (int d = 0; d < Dim; ++d) {
      inner = inner || t[d] == 1;
      corner |= (t[d] / 2) << d;
    }
    if (inner && Dim == 2) continue;  // the Jacobian of a quad is lowest at a corner
    auto& weight = out.weight[inner ? at++ : corner];
    for (int axis = 0; axis < Dim; ++axis)
      for (int k = 0; k < C::edges_per_axis; ++k) {
        const int from = C::insert_bit(k, axis);
        weight[axis][k] = 1.0;
        for (int d = 0; d < Dim; ++d)
          if (d != axis) weight[axis][k] *= (from >> d) & 1 ? 0.5 * t[d] : 1.0 - 0.5 * t[d];
      }
  }
  return out;
}

}  // namespace

template <int Dim>
const SamplePoints<Dim>& sample_points() {
  static const SamplePoints<Dim> points = make_sample_points<Dim>();
  return points;
}

template <int Dim>
UntangleEnergy<Dim>::UntangleEnergy(const Mesh<Dim>& mesh, const TangledPatch<Dim>& patch)
    : mesh_(mesh), patch_(patch), slots_(patch.cells.size()),
      to_wanted_(patch.cells.size() * SamplePoints<Dim>::count), size_(patch.free.size(), 0.0) {
  using C = Cell<Dim>;
  std::vector<int> edges(patch.free.size(), 0);
  for (std::size_t i = 0; i < patch.cells.size(); ++i) {
    const auto e = edge_vectors<Dim>([&](int k) -> const Point<Dim>& { return patch.shapes[i][k]; });
    for (int k = 0; k < C::corners; ++k) {
      const VertexId v = mesh.cells[patch.cells[i]][k];
      const auto at = std::lower_bound(patch.free.begin(), patch.free.end(), v);
      slots_[i][k] = at != patch.free.end() && *at == v ? static_cast<Index>(at - patch.free.begin()) : kNone;
      if (slots_[i][k] == kNone) continue;
      for (int axis = 0; axis < Dim; ++axis) {
        size_[slots_[i][k]] += std::sqrt(e[C::edge_at(k, axis)].squaredNorm());
        ++edges[slots_[i][k]];
      }
    }
    for (int s = 0; s < SamplePoints<Dim>::count; ++s) {
      const auto W = jacobian<Dim>(e, s);
      const auto c = cofactor(W);
      const double d = determinant_of<Dim>(W, c);
      auto& inverse = to_wanted_[i * SamplePoints<Dim>::count + s];
      inverse = SquareMatrix<Dim>::Zero();
      if (d > 0) inverse = c.transpose() / d;
    }
  }
  for (std::size_t i = 0; i < size_.size(); ++i) size_[i] /= edges[i];
}

template <int Dim>
PatchEnergy UntangleEnergy<Dim>::evaluate(double eps, std::vector<Point<Dim>>* gradient) const {
  using C = Cell<Dim>;
  PatchEnergy out{0.0, INFINITY};
  if (gradient != nullptr) gradient->assign(patch_.free.size(), Point<Dim>::Zero());
  for (std::size_t i = 0; i < patch_.cells.size(); ++i) {
    const auto& corners = mesh_.cells[patch_.cells[i]];
    const auto e = edge_vectors<Dim>([&](int k) -> const Point<Dim>& { return mesh_.points[corners[k]]; });
    EdgeVectors<Dim> slope;
    if (gradient != nullptr) slope.fill(Point<Dim>::Zero());
    for (int s = 0; s < samples_; ++s) {
      const auto& B = to_wanted_[i * SamplePoints<Dim>::count + s];
      const SquareMatrix<Dim> J = product<Dim>(jacobian<Dim>(e, s), B);
      const SquareMatrix<Dim> c = cofactor(J);
      double T = 0.0;
      for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) T += J(a, b) * J(a, b);
      if (!(T > 0)) continue;  // not looked at, or all of the cell in one point, where there is no slope
      const double d = determinant_of<Dim>(J, c);
      const double root = std::sqrt(d * d + eps * eps);
      const double chi = d > 0 ? 0.5 * (d + root) : 0.5 * eps * eps / (root - d);
      const double mean = T / Dim, edge = std::sqrt(mean);
      const double above = (Dim == 2 ? mean : mean * edge) + 0.5 * size_weight * (1 + d * d);
      out.value += above / chi;
      out.lowest = std::min(out.lowest, d);
      if (gradient == nullptr) continue;
      // d mean^(Dim/2) / dJ = mean^(Dim/2-1) J; d chi / dd = chi / root
      const double by_J = (Dim == 2 ? 1.0 : edge) / chi, by_d = (size_weight * d - above / root) / chi;
      SquareMatrix<Dim> P;
      for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) P(a, b) = by_J * J(a, b) + by_d * c(a, b);
      const SquareMatrix<Dim> Bt = B.transpose(), Q = product<Dim>(P, Bt);
      for (int axis = 0; axis < Dim; ++axis) {
        if (s < C::corners) {
          slope[C::edge_at(s, axis)] += Q.col(axis);
          continue;
        }
        const auto& weight = sample_points<Dim>().weight[s][axis];
        for (int k = 0; k < C::edges_per_axis; ++k) slope[C::edge(axis, k)] += weight[k] * Q.col(axis);
      }
    }
    if (gradient == nullptr) continue;
    for (int k = 0; k < C::edges; ++k) {
      const Index from = slots_[i][C::edge_from(k)], to = slots_[i][C::edge_to(k)];
      if (from != kNone) (*gradient)[from] -= slope[k];
      if (to != kNone) (*gradient)[to] += slope[k];
    }
  }
  return out;
}

#define PILLOWMESH_INSTANTIATE(Dim)                      \
  template const SamplePoints<Dim>& sample_points<Dim>(); \
  template class UntangleEnergy<Dim>;
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
