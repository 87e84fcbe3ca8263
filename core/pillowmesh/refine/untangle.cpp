#include "pillowmesh/refine/untangle.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {
namespace {

/// Value and gradient at one vertex, and the lowest corner Jacobian met.
template <int Dim>
struct Sample {
  double value = 0.0;
  double lowest = INFINITY;
  Point<Dim> gradient = Point<Dim>::Zero();
};

template <int Dim>
Point<Dim> cofactor(const std::array<Point<Dim>, Dim>& e, int j);
template <>
Point<2> cofactor<2>(const std::array<Point<2>, 2>& e, int j) {
  return j == 0 ? Point<2>(e[1][1], -e[1][0]) : Point<2>(-e[0][1], e[0][0]);
}
template <>
Point<3> cofactor<3>(const std::array<Point<3>, 3>& e, int j) {
  return vector_product(e[(j + 1) % 3], e[(j + 2) % 3]);
}

template <int Dim>
Sample<Dim> sample(const Mesh<Dim>& mesh, const std::vector<CellCorner>& star, double delta) {
  using C = Cell<Dim>;
  Sample<Dim> s;
  std::array<Point<Dim>, Dim> e;
  for (const auto& [c, at] : star)
    for (int j = -1; j < Dim; ++j) {  // the corner at v, and those at the far ends of its edges
      const int k = j < 0 ? at : at ^ (1 << j);
      double T = 0.0;
      for (int d = 0; d < Dim; ++d) {
        e[d] = mesh.points[mesh.cells[c][k ^ (1 << d)]] - mesh.points[mesh.cells[c][k]];
        T += e[d].squaredNorm();
      }
      const int sign = C::corner_sign(k);
      const double d = sign * cofactor<Dim>(e, 0).dot(e[0]);
      const double root = std::sqrt(d * d + 4 * delta * delta);
      const double chi = 0.5 * (d + root);
      const double power = Dim == 2 ? T : T * std::sqrt(T), slope = Dim == 2 ? 1.0 : 1.5 * std::sqrt(T);
      s.value += power / chi;
      s.lowest = std::min(s.lowest, d);
      Point<Dim> dT = Point<Dim>::Zero(), dd = Point<Dim>::Zero();
      for (int i = 0; i < Dim; ++i) {
        const double moves = j < 0 ? -1.0 : (i == j ? 1.0 : 0.0);
        dT += 2.0 * moves * e[i];
        dd += (moves * sign) * cofactor<Dim>(e, i);
      }
      s.gradient += slope / chi * dT - power / (chi * root) * dd;  // d chi / d d = chi / root
    }
  return s;
}

}  // namespace

template <int Dim>
bool untangle(Mesh<Dim>& mesh, std::span<const VertexId> vertices, int sweeps) {
  std::vector<CellCorner> star;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool tangled = false;
    for (const VertexId v : vertices) {
      if (mesh.support[v].dim == 0) continue;
      vertex_star(mesh, v, star);
      double reach2 = 0.0;
      for (const auto& [c, k] : star)
        for (int d = 0; d < Dim; ++d)
          reach2 = std::max(reach2, (mesh.points[mesh.cells[c][k ^ (1 << d)]] - mesh.points[v]).squaredNorm());
      const double reach = std::sqrt(reach2), unit = Dim == 2 ? reach2 : reach2 * reach;
      const double lowest = sample(mesh, star, unit).lowest;
      tangled = tangled || !(lowest > 0);
      const double delta = std::max(1e-6 * unit, lowest < 0 ? -0.2 * lowest : 0.0);
      const Sample<Dim> now = sample(mesh, star, delta);
      const double steepness = std::sqrt(now.gradient.squaredNorm());
      if (!(steepness > 0)) continue;
      const Point<Dim> from = mesh.points[v];
      const Index anchor = mesh.anchor[v];
      double step = 0.3 * reach;
      for (int attempt = 0; attempt < 8; ++attempt, step *= 0.5) {
        mesh.anchor[v] = anchor;
        mesh.points[v] = slide(*mesh.geometry, mesh.support[v], mesh.anchor[v],
                               Point<Dim>(from - (step / steepness) * now.gradient));
        if (sample(mesh, star, delta).value < now.value) break;
        mesh.points[v] = from;
        mesh.anchor[v] = anchor;
      }
    }
    if (!tangled && sweep > 2) return true;  // a few more sweeps give some room
  }
  return false;
}

template bool untangle(Mesh<2>&, std::span<const VertexId>, int);
template bool untangle(Mesh<3>&, std::span<const VertexId>, int);

}  // namespace pillowmesh
