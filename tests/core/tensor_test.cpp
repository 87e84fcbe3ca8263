#include "pillowmesh/metric/tensor.h"

#include <Eigen/LU>

#include "../catch.h"

namespace tensor_test {

using namespace pillowmesh;

TEST_CASE("packing puts the upper triangle by columns") {
  // 0 1 3
  //   2 4
  //     5
  CHECK(SymTensor<3>::at(0, 0) == 0);
  CHECK(SymTensor<3>::at(0, 1) == 1);
  CHECK(SymTensor<3>::at(1, 1) == 2);
  CHECK(SymTensor<3>::at(0, 2) == 3);
  CHECK(SymTensor<3>::at(1, 2) == 4);
  CHECK(SymTensor<3>::at(2, 2) == 5);
  CHECK(SymTensor<3>::at(2, 1) == SymTensor<3>::at(1, 2));
  CHECK(SymTensor<2>::size == 3);
  CHECK(SymTensor<3>::size == 6);
}

TEST_CASE("an isotropic tensor makes an edge of its size unit long") {
  CHECK(dot(SymTensor<2>::isotropic(0.25), Point<2>(0.15, 0.2), Point<2>(0.15, 0.2)) == Approx(1.0));
  CHECK(dot(SymTensor<3>::isotropic(3.0), Point<3>(2, 1, 2), Point<3>(2, 1, 2)) == Approx(1.0));
}

TEST_CASE("dot is symmetric and sees the off-diagonal entries") {
  const SymTensor<3> M{{4, 1, 5, 2, 3, 6}};
  const Point<3> u(1, -2, 0.5);
  const Point<3> v(0.3, 1, 2);
  CHECK(dot(M, u, v) == Approx(dot(M, v, u)));
  CHECK(dot(M, Point<3>(1, 0, 0), Point<3>(0, 0, 1)) == 2.0);
  CHECK(dot(M, Point<3>(0, 1, 0), Point<3>(0, 0, 1)) == 3.0);
}

TEST_CASE("the determinant is that of the full matrix") {
  CHECK(determinant(SymTensor<2>{{4, 1, 5}}) == 19.0);
  Eigen::Matrix3d m;
  m << 4, 1, 2, 1, 5, 3, 2, 3, 6;
  CHECK(determinant(SymTensor<3>{{4, 1, 5, 2, 3, 6}}) == Approx(m.determinant()));
}

TEST_CASE("tensors add and scale entry by entry") {
  const SymTensor<2> a{{1, 2, 3}};
  const SymTensor<2> b{{10, 20, 30}};
  CHECK(a + 2.0 * b == SymTensor<2>{{21, 42, 63}});
}

}  // namespace tensor_test
