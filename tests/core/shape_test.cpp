#include "pillowmesh/quality/shape.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/quality/statistics.h"

namespace shape_test {

using namespace pillowmesh;

namespace {

const double root2 = std::sqrt(2.0);

template <int Dim>
struct Shapes {
  std::vector<double> flat, integral;
};

template <int Dim>
Shapes<Dim> shapes(const Mesh<Dim>& mesh, std::string_view formula) {
  std::vector<CellId> cells;
  for (CellId c = 0; c < mesh.cell_count(); ++c) cells.push_back(c);
  Shapes<Dim> s{std::vector<double>(cells.size()), std::vector<double>(cells.size())};
  cell_shapes<Dim>(mesh, *MetricField<Dim>::from_formula(formula), cells, s.flat, s.integral,
                   {.panel = default_panel<Dim>(mesh.points)});
  return s;
}

void check_row(const std::vector<double>& values, double min, double mean, double max, double cv, double margin) {
  const Statistics s = statistics(values);
  CHECK(s.min == Approx(min).margin(margin));
  CHECK(s.mean == Approx(mean).margin(margin));
  CHECK(s.max == Approx(max).margin(margin));
  CHECK(s.cv == Approx(cv).margin(margin));
}

}  // namespace

TEST_CASE("eta of a right-angled unit corner is one, at any scale") {
  CHECK(simplex_shape<2>({1, 1, root2}) == Approx(1.0));
  CHECK(simplex_shape<2>({7, 7, 7 * root2}) == Approx(1.0));
  CHECK(simplex_shape<3>({1, 1, 1, root2, root2, root2}) == Approx(1.0));
  CHECK(simplex_shape<3>({0.1, 0.1, 0.1, 0.1 * root2, 0.1 * root2, 0.1 * root2}) == Approx(1.0));
}

TEST_CASE("eta can exceed one a little") {
  CHECK(simplex_shape<2>({1, 1, 1}) == Approx(2.0 / std::sqrt(3.0)));
  CHECK(simplex_shape<3>({1, 1, 1, 1, 1, 1}) > 1.0);
}

TEST_CASE("eta falls with stretching and with shear") {
  // l0 = 1, l1 = a, right angle: 8 (a / 2) / (2 + 2 a^2).
  CHECK(simplex_shape<2>({1, 3, std::sqrt(10.0)}) == Approx(0.6));
  CHECK(simplex_shape<2>({1, 1, 1.9}) < 0.6);
  CHECK(simplex_shape<3>({1, 1, 4, root2, std::sqrt(17.0), std::sqrt(17.0)}) < 0.6);
}

TEST_CASE("eta is zero where no flat simplex has the lengths") {
  CHECK(simplex_shape<2>({1, 1, 2.1}) == 0.0);
  CHECK(simplex_shape<2>({1, 5, 1}) == 0.0);
  CHECK(simplex_shape<3>({1, 1, 1, 1.9, 1.9, 1.9}) == 0.0);
  CHECK(simplex_shape<3>({1, 1, 1, 2.1, 1, 1}) == 0.0);
  // Each face alone is possible in all of these but the last.
  CHECK(simplex_shape<3>({1, 1, 1, 0.1, 1.9, 0.1}) == 0.0);
  CHECK(simplex_shape<2>({0, 0, 0}) == 0.0);
}

TEST_CASE("with a volume given, eta is what the formula says, and zero without volume") {
  CHECK(simplex_shape<2>({1, 1, root2}, 0.25) == Approx(0.5));
  CHECK(simplex_shape<3>({1, 1, 1, root2, root2, root2}, 1.0 / 48) == Approx(0.25));
  CHECK(simplex_shape<2>({1, 1, root2}, -1.0) == 0.0);
}

TEST_CASE("a cell takes the eta of its worst corner") {
  Mesh<2> mesh = make_grid<2>({1, 1}, Point<2>(0, 0), Point<2>(1, 1));
  CHECK(shapes(mesh, "h = 1").flat[0] == Approx(1.0));
  mesh.points[3] = Point<2>(3, 1);
  const std::vector<double> at_corners{
      simplex_shape<2>({1, 1, root2}), simplex_shape<2>({1, std::sqrt(5.0), std::sqrt(10.0)}),
      simplex_shape<2>({1, 3, std::sqrt(10.0)}), simplex_shape<2>({3, std::sqrt(5.0), root2})};
  CHECK(shapes(mesh, "h = 1").flat[0] == Approx(*std::min_element(at_corners.begin(), at_corners.end())));
}

TEST_CASE("a corner that is not convex has no integral shape") {
  Mesh<2> mesh = make_grid<2>({1, 1}, Point<2>(0, 0), Point<2>(1, 1));
  mesh.points[3] = Point<2>(0.3, 0.3);
  CHECK(shapes(mesh, "h = 1").integral[0] == 0.0);
}

TEST_CASE("both shapes agree where the metric is uniform") {
  const Mesh<3> mesh = make_grid<3>({2, 1, 3}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  const auto s = shapes(mesh, "theta = 0.4; phi = 0.7; h1 = 0.3; h2 = 0.5; h3 = 1");
  for (std::size_t c = 0; c < s.flat.size(); ++c) CHECK(s.integral[c] == Approx(s.flat[c]));
}

TEST_CASE("edges that have been integrated change nothing but the work") {
  const auto mesh = make_grid<3>({3, 2, 2}, Point<3>(0, 0, 0), Point<3>(1, 1, 1));
  const auto field = *MetricField<3>::from_formula("h = 0.1 + abs(x - 0.4)");
  std::vector<CellId> cells(mesh.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = static_cast<CellId>(c);
  EdgeIntegrals<3> known = edge_integrals<3>(mesh, field, cells, {});
  std::vector<double> without(cells.size()), with(cells.size());
  cell_shapes<3>(mesh, field, cells, without, {});
  cell_shapes<3>(mesh, field, cells, with, {}, {}, &known);
  CHECK(with == without);
  for (LineIntegral& i : known.along) i.length *= 1.5;  // they are used
  cell_shapes<3>(mesh, field, cells, with, {}, {}, &known);
  CHECK(with != without);
}

TEST_CASE("the paper's initial shapes are reproduced") {
  // paper-notes.md: [Paper] Tables 2 and 4, printed .229 .730 1.00 .280 and .815 .895 .94 .056.
  const Case& aniso = *find_case("aniso2d");
  check_row(shapes(std::get<Mesh<2>>(*parse_primitive(aniso.mesh)), aniso.formula).flat, .2292, .7318, .9986, .2801, 6e-5);
  const Case& linear = *find_case("linear3d");
  const auto s = shapes(std::get<Mesh<3>>(*parse_primitive(linear.mesh)), linear.formula);
  check_row(s.flat, .8145, .8948, .9441, .0556, 6e-5);
  // By 12-point Gauss rules: .93916 .96711 .98386 .01780.
  check_row(s.integral, .93916, .96711, .98386, .01780, 1e-4);
  const Case& iso = *find_case("iso2d");
  check_row(shapes(std::get<Mesh<2>>(*parse_primitive(iso.mesh)), iso.formula).integral, .535, .868, 1.02, .147, 2e-3);
}

}  // namespace shape_test
