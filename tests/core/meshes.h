// The corpus: small meshes with names that tests run over.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/primitives.h"

namespace corpus {

using namespace pillowmesh;

template <int Dim>
struct Named {
  std::string name;
  Mesh<Dim> mesh;
};

/// n quads around, m across; closed: an annulus; else a half ring.
inline Mesh<2> ring(int n, int m, bool closed) {
  MeshInput<2> in;
  const double turn = closed ? 2 * 3.14159265358979 / n : 3.14159265358979 / n;
  const int around = closed ? n : n + 1;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i < around; ++i)
      in.points.push_back(Point<2>((1 + 1.0 * j / m) * std::cos(turn * i), (1 + 1.0 * j / m) * std::sin(turn * i)));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      in.cells.push_back({b, a, b + around, a + around});
    }
  return *make_mesh(in);
}

/// k quads around a vertex of valence k, each split n x n: irregular inside for k != 4.
inline Mesh<2> star(int k, int n) {
  MeshInput<2> in;
  std::vector<std::array<int, 2>> unused;
  const double turn = 2 * 3.14159265358979 / k;
  const auto corner = [&](double a) { return Point<2>(std::cos(a), std::sin(a)); };
  // Bilinear sectors; vertices merged by position.
  const auto vertex = [&](const Point<2>& p) {
    for (std::size_t i = 0; i < in.points.size(); ++i)
      if ((in.points[i] - p).norm() < 1e-9) return static_cast<Index>(i);
    in.points.push_back(p);
    return static_cast<Index>(in.points.size() - 1);
  };
  for (int s = 0; s < k; ++s) {
    const Point<2> a = corner(turn * s), b = 1.3 * corner(turn * (s + .5)), c = corner(turn * (s + 1));
    const auto at = [&](int i, int j) {
      const double u = 1.0 * i / n, v = 1.0 * j / n;
      return vertex(u * (1 - v) * a + u * v * b + (1 - u) * v * c);
    };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) in.cells.push_back({at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
  }
  return *make_mesh(in);
}

/// A grid whose inner vertices are moved by up to `share` of the spacing.
template <int Dim>
Mesh<Dim> shaken(Mesh<Dim> mesh, double spacing, double share, unsigned seed) {
  std::mt19937 random(seed);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.support[v].dim == Dim)
      for (int d = 0; d < Dim; ++d) mesh.points[v][d] += spacing * share * (random() / 4294967296.0 * 2 - 1);
  return mesh;
}

/// The unit L: three quarters of a square of n x n quads.
inline Mesh<2> ell(int n) {
  MeshInput<2> in;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) in.points.push_back(Point<2>(1.0 * i / n, 1.0 * j / n));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      if (i < n / 2 || j < n / 2) {
        const int a = j * (n + 1) + i;
        in.cells.push_back({a, a + 1, a + n + 1, a + n + 2});
      }
  return *make_mesh(in);
}

/// A strip of n x m quads a turn, wound up so that column 0 continues row j in row j + 1: all m rows are one dual chord,
/// which lies beside itself, and a layer through it has rows inside that touch no hull.
inline Mesh<2> snail(int n, int m) {
  MeshInput<2> in;
  const auto vertex = [&](int i, int j) {
    if (i == n && j < m) return j + 1;  // the same as (0, j + 1)
    return i == 0 ? j : i == n ? m + 1 : m + 2 + (i - 1) * (m + 1) + j;
  };
  in.points.resize(m + 2 + (n - 1) * (m + 1));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      const double turn = 2 * 3.14159265358979 * i / n, radius = 2 + j + 1.0 * i / n;
      in.points[vertex(i, j)] = Point<2>(radius * std::cos(turn), radius * std::sin(turn));
    }
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i)
      in.cells.push_back({vertex(i + 1, j), vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
  return *make_mesh(in);
}

template <int Dim>
std::vector<Named<Dim>> meshes() {
  std::vector<Named<Dim>> out;
  if constexpr (Dim == 2) {
    out.push_back({"grid 5x4", make_grid<2>({5, 4}, Point<2>(0, 0), Point<2>(5, 4))});
    out.push_back({"one row of 6", make_grid<2>({6, 1}, Point<2>(0, 0), Point<2>(6, 1))});
    out.push_back({"shaken grid", shaken(make_grid<2>({8, 8}, Point<2>(0, 0), Point<2>(8, 8)), 1.0, 0.3, 7)});
    out.push_back({"annulus", ring(16, 3, true)});
    out.push_back({"half ring", ring(9, 2, false)});
    out.push_back({"star of 3", star(3, 4)});
    out.push_back({"star of 5", star(5, 3)});
    out.push_back({"star of 7", star(7, 2)});
    out.push_back({"L", ell(6)});
    out.push_back({"snail", snail(12, 3)});
  } else {
    out.push_back({"cube 4", make_grid<3>({4, 4, 4}, Point<3>(0, 0, 0), Point<3>(1, 1, 1))});
    out.push_back({"shaken cube", shaken(make_grid<3>({5, 5, 5}, Point<3>(0, 0, 0), Point<3>(5, 5, 5)), 1.0, 0.2, 3)});
    out.push_back({"plate", make_grid<3>({6, 5, 1}, Point<3>(0, 0, 0), Point<3>(6, 5, 1))});
  }
  return out;
}

/// A random face-connected set of about `size` cells, never all of them.
template <int Dim>
std::vector<CellId> random_set(const Mesh<Dim>& mesh, std::size_t size, std::mt19937& random) {
  size = std::min(size, mesh.cells.size() - 1);
  std::vector<CellId> set;
  std::vector<char> in(mesh.cells.size(), 0);
  CellId seed = static_cast<CellId>(random() % mesh.cells.size());
  while (!mesh.alive(seed)) seed = (seed + 1) % mesh.cell_count();
  set.push_back(seed);
  in[seed] = 1;
  for (std::size_t tries = 0; set.size() < size && tries < 20 * size; ++tries) {
    const CellId c = set[random() % set.size()];
    const CellId n = mesh.neighbour(c, static_cast<int>(random() % Cell<Dim>::facets));
    if (n == kNone || in[n]) continue;
    in[n] = 1;
    set.push_back(n);
  }
  return set;
}

/// True if two meshes are the same to the last bit.
template <int Dim>
bool identical(const Mesh<Dim>& a, const Mesh<Dim>& b) {
  return a.points == b.points && a.cells == b.cells && a.twins == b.twins && a.vertex_cell == b.vertex_cell &&
         a.support == b.support && a.anchor == b.anchor && a.region == b.region;
}

}  // namespace corpus
