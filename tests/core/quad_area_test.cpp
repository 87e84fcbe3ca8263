#include "pillowmesh/metric/quad_area.h"

#include <cmath>
#include <vector>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/gallery.h"

namespace quad_area_test {

using namespace pillowmesh;

namespace {

CornerPoints<2> quad(Point<2> a, Point<2> b, Point<2> c, Point<2> d) { return {a, b, d, c}; }  // given counterclockwise

CornerAreas areas_of(std::string_view formula, const CornerPoints<2>& q, const VolumeOptions& options = {}) {
  CornerAreas areas;
  quad_areas(*MetricField<2>::from_formula(formula), {&q, 1}, {&areas, 1}, options);
  return areas;
}

}  // namespace

TEST_CASE("in the Euclidean metric the areas are those of the corner triangles, whatever the shape") {
  const auto triangle = [](const Point<2>& a, const Point<2>& b, const Point<2>& c) {
    return 0.5 * ((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]);
  };
  const std::vector<CornerPoints<2>> quads{
      quad({0, 0}, {3, 0}, {2, 2}, {0, 1}),      // convex
      quad({0, 0}, {2, 1}, {0, 4}, {1, 1}),      // a corner inside out
      quad({0, 0}, {0, 1}, {2, 2}, {3, 0}),      // all of them
      quad({0, 0}, {1, 1}, {1, 0}, {0, 1}),      // a bow tie
      quad({0, 0}, {1, 0}, {2, 0}, {1, 1}),      // a flat corner
      quad({0, 0}, {1, 0}, {0, 0}, {1, 0})};     // nothing
  for (const CornerPoints<2>& p : quads) {
    const CornerAreas a = areas_of("h = 0.5", p);
    CHECK(a[0] == Approx(4 * triangle(p[0], p[1], p[2])).margin(1e-12));
    CHECK(a[1] == Approx(4 * triangle(p[1], p[3], p[0])).margin(1e-12));
    CHECK(a[2] == Approx(4 * triangle(p[2], p[0], p[3])).margin(1e-12));
    CHECK(a[3] == Approx(4 * triangle(p[3], p[2], p[1])).margin(1e-12));
    CHECK(a[0] + a[3] == Approx(a[1] + a[2]).margin(1e-12));
  }
}

TEST_CASE("areas of corner triangles are those of collapsed cells, within the tolerance, at kinks too") {
  for (const char* name : {"iso2d", "circle2d", "shock2d", "larsson1"}) {
    const Case& c = *find_case(name);
    const auto field = *MetricField<2>::from_formula(c.formula);
    const AnyMesh any = *parse_primitive(c.mesh);
    const Mesh<2>& mesh = std::get<Mesh<2>>(any);
    std::vector<CornerPoints<2>> quads;
    for (CellId q = 0; q < mesh.cell_count(); ++q) {
      CornerPoints<2> p;
      for (int k = 0; k < 4; ++k) p[k] = mesh.points[mesh.cells[q][k]];
      quads.push_back(p);
    }
    const VolumeOptions options{.tolerance = 1e-3, .panel = 0.05};
    std::vector<CornerAreas> found(quads.size());
    quad_areas(field, quads, found, options);
    double errors = 0.0;
    for (std::size_t i = 0; i < quads.size(); ++i)
      for (int k = 0; k < 4; ++k) {
        const CornerPoints<2> triangle = collapsed_simplex<2>({quads[i][k], quads[i][k ^ (1 << (k == 0 || k == 3 ? 0 : 1))],
                                                              quads[i][k ^ (1 << (k == 0 || k == 3 ? 1 : 0))]});
        double exact = 0.0;
        metric_volumes<2>(field, {&triangle, 1}, {&exact, 1}, {.tolerance = 3e-5, .panel = 0.05});
        INFO(name << " quadrilateral " << i << " corner " << k);
        CHECK(found[i][k] == Approx(exact).epsilon(1e-2));
        errors += std::fabs(found[i][k] / exact - 1);
      }
    CHECK(errors / (4.0 * static_cast<double>(quads.size())) < 1e-3);
    // Alone as among others.
    const CornerAreas alone = areas_of(c.formula, quads[17], options);
    CHECK(alone == found[17]);
  }
}

TEST_CASE("areas by the lines of a quadrilateral are those of its triangles, within the tolerance") {
  // Fine meshes, where most are good enough by lines, and coarse ones, where few are.
  for (const char* name : {"iso2d", "circle2d", "shock2d", "larsson1"}) {
    for (const double share : {1.0, 0.1}) {
      const Case& c = *find_case(name);
      const auto field = *MetricField<2>::from_formula(c.formula);
      const AnyMesh any = *parse_primitive(c.mesh);
      const Mesh<2>& mesh = std::get<Mesh<2>>(any);
      std::vector<CornerPoints<2>> quads;
      std::vector<QuadLines> lines;
      for (CellId q = 0; q < mesh.cell_count(); ++q) {
        CornerPoints<2> p;
        for (int k = 0; k < 4; ++k)
          p[k] = mesh.points[mesh.cells[q][0]] + share * (mesh.points[mesh.cells[q][k]] - mesh.points[mesh.cells[q][0]]);
        p[3] += Point<2>(0.1 * (p[1] - p[0]) + 0.2 * (p[2] - p[0]));
        quads.push_back(p);
        const std::vector<Line<2>> six{{p[0], p[1]}, {p[0], p[2]}, {p[1], p[3]}, {p[2], p[3]}, {p[0], p[3]}, {p[1], p[2]}};
        std::array<LineIntegral, 6> found;
        line_integrals<2>(field, six, found, {.panel = 0.0125});
        lines.push_back({found[0], found[1], found[2], found[3], found[4], found[5]});
      }
      const VolumeOptions options{.tolerance = 1e-3, .panel = 0.05};
      std::vector<CornerAreas> found(quads.size()), expected(quads.size());
      quad_areas(field, quads, lines, found, options);
      quad_areas(field, quads, expected, {.tolerance = 1e-4, .panel = 0.05});
      double errors = 0.0, all = 0.0, exact = 0.0;
      for (std::size_t i = 0; i < quads.size(); ++i)
        for (int k = 0; k < 4; ++k) {
          INFO(name << " quadrilateral " << i << " corner " << k);
          CHECK(found[i][k] == Approx(expected[i][k]).epsilon(2e-2));
          errors += std::fabs(found[i][k] / expected[i][k] - 1);
          all += found[i][k], exact += expected[i][k];
        }
      CHECK(errors / (4.0 * static_cast<double>(quads.size())) < 1e-3);
      CHECK(all == Approx(exact).epsilon(5e-4));
    }
  }
}

TEST_CASE("a panel finds a spike that no line of a quadrilateral meets") {
  const auto field = *MetricField<2>::from_formula("h = if(sqrt((x - 0.5)^2 + (y - 0.17)^2) < 0.04, 0.01, 1)");
  const CornerPoints<2> unit = quad({0, 0}, {1, 0}, {1, 1}, {0, 1});
  const LineIntegral one{1.0, 1.0, 2.0};
  const QuadLines lines{one, one, one, one, one, one};
  const auto whole = [&](double panel) {
    CornerAreas a;
    quad_areas(field, {&unit, 1}, {&lines, 1}, {&a, 1}, {.tolerance = 1e-3, .panel = panel});
    return a[0] + a[3];
  };
  CHECK(whole(0.0) == Approx(1.0));
  CHECK(whole(0.05) > 30.0);  // 51
}

TEST_CASE("a panel finds a spike between the points of a quadrilateral") {
  const char* const spike = "h1 = if(abs(x - 0.3) < 0.02, 0.01, 1); h2 = 1";
  const CornerPoints<2> unit = quad({0, 0}, {1, 0}, {1, 1}, {0, 1});
  const auto whole = [&](double panel) {
    const CornerAreas a = areas_of(spike, unit, {.tolerance = 1e-3, .panel = panel});
    return a[0] + a[3];
  };
  CHECK(whole(0.0) < 3.0);
  CHECK(whole(0.1) == Approx(0.96 + 4.0).epsilon(0.05));
}

TEST_CASE("where the metric is not a number the areas are not") {
  const CornerAreas a = areas_of("h = -1", quad({0, 0}, {1, 0}, {1, 1}, {0, 1}));
  for (const double area : a) CHECK(!(area == area));
}

}  // namespace quad_area_test
