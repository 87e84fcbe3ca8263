#include "pillowmesh/metric/nodal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../catch.h"
#include "meshes.h"
#include "pillowmesh/mesh/primitives.h"
#include "simplices.h"

namespace nodal_test {

using namespace pillowmesh;

namespace {

template <int Dim>
double volume(const NodalMetric<Dim>& m) {
  double sum = 0.0;
  for (const Simplex<Dim>& s : m.simplices) {
    const double v = simplex_determinant<Dim>(m.points, s);
    CHECK(v > 0.0);
    sum += v;
  }
  return sum / (Dim == 2 ? 2 : 6);
}

}  // namespace

TEST_CASE("a grid is divided into conforming simplices that fill it") {
  const auto flat = nodal_grid<2>({3, 5}, {0.0, 0.0}, {1.0, 1.0});
  CHECK(flat.simplices.size() == 2 * 15);
  CHECK(volume(flat) == Approx(1.0));
  CHECK(checks::conforming(flat));
  const auto solid = nodal_grid<3>({3, 2, 4}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  CHECK(solid.simplices.size() == 6 * 24);
  CHECK(volume(solid) == Approx(1.0));
  CHECK(checks::conforming(solid));
}

TEST_CASE("hexahedra are divided alike from both sides whatever their local axes") {
  // Reverse the numbers of the points: the smallest vertex of a cell is at another corner in each.
  NodalMetric<3> m = nodal_grid<3>({2, 2, 2}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  Mesh<3> mesh = make_grid<3>({2, 2, 2}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  const auto n = static_cast<VertexId>(m.points.size());
  m.points.assign(mesh.points.size(), {});
  for (VertexId v = 0; v < n; ++v) m.points[v * 5 % n] = mesh.points[v];
  for (auto& c : mesh.cells)
    for (VertexId& v : c) v = v * 5 % n;
  m.simplices = divide<3>(m.points, mesh.cells);
  CHECK(volume(m) == Approx(1.0));
  CHECK(checks::conforming(m));
}

TEST_CASE("a quad that is not convex is divided along the diagonal inside of it") {
  // 3 is the reflex corner: only the diagonal 0-3 lies inside.
  const std::vector<Point<2>> points{{0.0, 0.0}, {2.0, 0.0}, {0.0, 2.0}, {0.4, 0.4}};
  const std::vector<Corners<2>> cells{{0, 1, 2, 3}};
  NodalMetric<2> m{points, divide<2>(points, cells), {}};
  CHECK(volume(m) == Approx(0.8));
}

TEST_CASE("a metric sampled at the vertices of a mesh is met there again") {
  const auto field = *MetricField<2>::from_formula("h1 = 0.1 + x; h2 = 0.2; theta = y");
  const Mesh<2> mesh = make_grid<2>({6, 5}, {0.0, 0.0}, {1.0, 1.0});
  const auto again = *look_up(sample_at_vertices(field, mesh));
  for (const Point<2>& p : mesh.points)
    for (int k = 0; k < 3; ++k) CHECK(again.evaluate(p).m[k] == Approx(field.evaluate(p).m[k]));
}

TEST_CASE("tensors that are no metric are named by their vertex") {
  std::vector<SymTensor<2>> tensors(4, SymTensor<2>::isotropic(1.0));
  CHECK(check_tensors<2>(tensors, 4).ok());
  CHECK(check_tensors<2>(tensors, 5).message.find("4 tensors for the 5 vertices") != std::string::npos);
  tensors[2] = {{1.0, 2.0, 1.0}};
  CHECK(check_tensors<2>(tensors, 4).message.find("vertex 3: the tensor (1, 2, 1)") != std::string::npos);
  tensors[2] = {{1.0, std::numeric_limits<double>::quiet_NaN(), 1.0}};
  CHECK(check_tensors<2>(tensors, 4).message.find("not finite") != std::string::npos);
  tensors[2] = SymTensor<2>::isotropic(1e-120);
  CHECK(check_tensors<2>(tensors, 4).message.find("1e-100") != std::string::npos);
  tensors[2] = {{1e-240, 0.0, 1.0}};
  CHECK(check_tensors<2>(tensors, 4).message.find("1e100") != std::string::npos);
}

}  // namespace nodal_test
