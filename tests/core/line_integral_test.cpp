#include "pillowmesh/metric/line_integral.h"

#include <cmath>
#include <vector>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/metric/length.h"

namespace line_integral_test {

using namespace pillowmesh;

namespace {

template <int Dim>
LineIntegral along(std::string_view formula, const Point<Dim>& a, const Point<Dim>& b, const LineOptions& options = {}) {
  const std::vector<Line<Dim>> line{{a, b}};
  LineIntegral integral;
  line_integrals<Dim>(*MetricField<Dim>::from_formula(formula), line, {&integral, 1}, options);
  return integral;
}

template <int Dim>
std::vector<Line<Dim>> edges_of(const Mesh<Dim>& mesh) {
  std::vector<Line<Dim>> lines;
  for (const auto& [a, b] : unique_edges(mesh)) lines.push_back({mesh.points[a], mesh.points[b]});
  return lines;
}

}  // namespace

TEST_CASE("a line integral holds length, mean density, and the densities at both ends") {
  // |dP/dt| = 5 / h and sqrt(det M) = 1 / h^2, h from 1 to 4 along it.
  const LineIntegral i = along<2>("h = 1 + x", Point<2>(0, 0), Point<2>(3, 4), {.tolerance = 1e-8, .density_tolerance = 1e-8});
  CHECK(i.length == Approx(5.0 * std::log(4.0) / 3.0).epsilon(1e-8));
  CHECK(i.density == Approx(0.25).epsilon(1e-8));
  CHECK(i.ends == Approx(1.0 + 1.0 / 16));
  CHECK(along<3>("h = 1 + x", Point<3>(0, 0, 0), Point<3>(3, 4, 12)).length == Approx(13.0 * std::log(4.0) / 3.0).epsilon(1e-5));
}

TEST_CASE("line integrals are within a few tolerances of exact lengths, in every case of the gallery") {
  const auto check = []<int Dim>(const Case& c, const Mesh<Dim>& mesh) {
    const auto field = *MetricField<Dim>::from_formula(c.formula);
    const auto lines = edges_of(mesh);
    const double panel = default_panel<Dim>(mesh.points);
    std::vector<LineIntegral> found(lines.size());
    line_integrals<Dim>(field, lines, found, {.panel = panel});
    double squares = 0.0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double exact = edge_length(field, lines[i].from, lines[i].to, {.tolerance = 1e-9, .panel = 0.5 * panel});
      CHECK(found[i].length == Approx(exact).epsilon(2e-3));  // a kink that no rule has seen
      squares += (found[i].length / exact - 1) * (found[i].length / exact - 1);
    }
    CHECK(std::sqrt(squares / static_cast<double>(lines.size())) < 2e-4);
  };
  for (const Case& c : gallery()) {
    CAPTURE(std::string(c.name));
    const AnyMesh mesh = *parse_primitive(c.mesh);
    if (c.dim == 2) {
      check(c, std::get<Mesh<2>>(mesh));
    } else {
      check(c, std::get<Mesh<3>>(mesh));
    }
  }
}

TEST_CASE("line integrals do not depend on the direction or on the other lines") {
  const Case& c = *find_case("circle2d");
  const auto field = *MetricField<2>::from_formula(c.formula);
  const auto lines = edges_of(std::get<Mesh<2>>(*parse_primitive(c.mesh)));
  std::vector<LineIntegral> found(lines.size());
  line_integrals<2>(field, lines, found, {.panel = 0.05});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const Line<2>& line : {lines[i], Line<2>{lines[i].to, lines[i].from}}) {
      const LineIntegral alone = along<2>(c.formula, line.from, line.to, {.panel = 0.05});
      CHECK(alone.length == found[i].length);
      CHECK(alone.density == found[i].density);
      CHECK(alone.ends == found[i].ends);
    }
  }
}

TEST_CASE("lines whose ends are known, together with others, have the same integrals, and do not ask again") {
  const auto check = []<int Dim>(const char* name) {
    const Case& c = *find_case(name);
    const auto field = *MetricField<Dim>::from_formula(c.formula);
    const auto mesh = std::get<Mesh<Dim>>(*parse_primitive(c.mesh));
    std::vector<SymTensor<Dim>> at(mesh.points.size());
    field.evaluate(mesh.points, at);
    auto lines = edges_of(mesh);
    std::vector<LineIntegral> expected(lines.size()), found(lines.size());
    line_integrals<Dim>(field, lines, expected, {.panel = 0.05});
    const auto edges = unique_edges(mesh);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto [a, b] = edges[i];
      if (i % 3 == 0) continue;
      lines[i] = {mesh.points[a], mesh.points[b], &at[a], &at[b]};
      if (i % 3 == 1) lines[i] = {mesh.points[b], mesh.points[a], &at[b], &at[a]};
    }
    line_integrals<Dim>(field, lines, found, {.panel = 0.05});
    for (std::size_t i = 0; i < lines.size(); ++i) {
      CHECK(found[i].length == Approx(expected[i].length).epsilon(1e-12));
      CHECK(found[i].density == Approx(expected[i].density).epsilon(1e-12));
      CHECK(found[i].ends == Approx(expected[i].ends).epsilon(1e-12));
    }
    const SymTensor<Dim> twice = SymTensor<Dim>::isotropic(0.25);
    const Point<Dim> low = Point<Dim>::Zero(), high = Point<Dim>::Unit(0);
    const std::vector<Line<Dim>> line{{low, high, &twice, &twice}};
    LineIntegral one;
    line_integrals<Dim>(*MetricField<Dim>::from_formula("h = 1"), line, {&one, 1}, {.tolerance = 10.0, .density_tolerance = 1e3});
    CHECK(one.length == Approx((14 * 4.0 + 76.0) / 90));  // Boole's rule
  };
  check.operator()<2>("circle2d");
  check.operator()<3>("sphere3d");
}

TEST_CASE("halving closes in on kinks, and stops at jumps") {
  const Point<2> a(0, 0), b(1, 0);
  // 1 / h = 1 + 20 |x - c|, wherever the kink lies between the samples.
  for (double c = 0.03; c < 1; c += 0.0171) {
    const double exact = 1.0 + 10.0 * (c * c + (1 - c) * (1 - c));
    const LineIntegral i = along<2>("h = 1 / (1 + 20 * abs(x - " + std::to_string(c) + "))", a, b);
    CHECK(i.length == Approx(exact).epsilon(1e-3));
  }
  // Here Boole's and Simpson's rules agree by chance, on a length that is a fifth off (in 2D densities tell, too).
  const auto hat = along<3>("h = 1 / (1 + 20 * max(0, 0.15 - abs(x - 0.11)))", Point<3>(0, 0, 0), Point<3>(1, 0, 0));
  CHECK(hat.length == Approx(1.0 + 10 * (0.045 - 0.0016)).epsilon(1e-4));
  CHECK(along<2>("h = if(x < 0.3, 1, 0.1)", a, b).length == Approx(0.3 + 7.0).epsilon(2e-4));
  CHECK(along<2>("h = if(x < 0.3, 1, 0.1)", a, b, {.max_depth = 2}).length != Approx(0.3 + 7.0).epsilon(1e-3));
}

TEST_CASE("a line that asks for one panel has one, however long it is") {
  const char* const spike = "h1 = if(abs(x - 0.3) < 0.04, 0.01, 1); h2 = 1";
  const auto length = [&](bool single_panel) {
    const std::vector<Line<2>> line{{.from = Point<2>(0, 0), .to = Point<2>(1, 0), .single_panel = single_panel}};
    LineIntegral integral;
    line_integrals<2>(*MetricField<2>::from_formula(spike), line, {&integral, 1}, {.panel = 0.1});
    return integral.length;
  };
  CHECK(length(false) == Approx(1.0 + 0.08 * 99).epsilon(2e-2));
  CHECK(length(true) == Approx(1.0));
}

TEST_CASE("line integrals see a spike that a panel is too short to hide") {
  const char* const spike = "h1 = if(abs(x - 0.635) < 0.002, 0.001, 1); h2 = 1";
  const Point<2> a(0.45, 0), b(0.65, 0);
  CHECK(along<2>(spike, a, b).length < 0.3);
  CHECK(along<2>(spike, a, b, {.panel = 0.01}).length == Approx(0.196 + 4.0).epsilon(2e-4));
}

TEST_CASE("where the metric is not a number, neither is a line integral, and a point has no length") {
  CHECK(std::isnan(along<2>("h = x", Point<2>(-1, 0), Point<2>(1, 0)).length));
  const LineIntegral none = along<2>("h = 0.5", Point<2>(1, 1), Point<2>(1, 1));
  CHECK(none.length == 0.0);
  CHECK(none.density == Approx(4.0));
}

}  // namespace line_integral_test
