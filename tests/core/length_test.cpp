#include "pillowmesh/metric/length.h"

#include <cmath>
#include <vector>

#include "../catch.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/gallery.h"

namespace length_test {

using namespace pillowmesh;

namespace {

template <int Dim = 2>
MetricField<Dim> field(std::string_view text) {
  return *MetricField<Dim>::from_formula(text);
}

}  // namespace

TEST_CASE("a straight edge in a uniform metric has its Euclidean length over the size") {
  CHECK(edge_length(field("h = 0.25"), Point<2>(1, 1), Point<2>(4, 5)) == Approx(20.0).epsilon(1e-14));
  CHECK(edge_length(field<3>("h1 = 1; h2 = 2; h3 = 4"), Point<3>(0, 0, 0), Point<3>(3, 0, 16)) ==
        Approx(5.0).epsilon(1e-14));
  CHECK(edge_length(field("h = 1"), Point<2>(1, 1), Point<2>(1, 1)) == 0.0);
}

TEST_CASE("a linear size gives the logarithm of the ratio of the sizes") {
  // Integral of 1 / (0.05 + 0.15 z) over [0, 1] = log(4) / 0.15.
  CHECK(edge_length(field<3>("h = 0.05 + 0.15*z"), Point<3>(0, 0, 0), Point<3>(0, 0, 1)) ==
        Approx(std::log(4.0) / 0.15).epsilon(1e-10));
}

TEST_CASE("kinks are integrated exactly wherever they lie on the edge") {
  // Integral of 1 / (a + |x - c|) over [0, 1] = log((a + c)(a + 1 - c) / a^2).
  for (const double c : {0.001, 0.01, 0.02, 0.1, 0.3333, 0.5, 0.77, 0.985, 0.999}) {
    for (const double a : {1e-4, 0.01, 1.0}) {
      CAPTURE(c, a);
      const auto f = field("h = " + std::to_string(a) + " + abs(x - " + std::to_string(c) + ")");
      const double wanted = std::log((a + c) * (a + 1 - c) / (a * a));
      CHECK(edge_length(f, Point<2>(0, 0), Point<2>(1, 0)) == Approx(wanted).epsilon(1e-7));
    }
  }
}

TEST_CASE("jumps of the metric are closed in on") {
  for (const double c : {0.0, 0.2, 0.5, 0.913}) {
    const auto f = field("h = if(x < " + std::to_string(c) + ", 0.1, 1)");
    CHECK(edge_length(f, Point<2>(0, 0), Point<2>(1, 0)) == Approx(10 * c + 1 - c).epsilon(1e-6));
  }
}

TEST_CASE("a panel finds a ring that falls between the sample points") {
  // Size 1 but for a ring 0.004 wide, where it is 0.001: 4 more on an edge that crosses it.
  const auto f = field("h = if(abs(r - 0.537) < 0.002, 0.001, 1)");
  const Point<2> a(0.45, 0);
  const Point<2> b(0.65, 0);
  CHECK(edge_length(f, a, b) < 0.3);
  CHECK(edge_length(f, a, b, {.panel = 0.01}) == Approx(0.196 + 4.0).epsilon(1e-6));

  const std::vector<Point<2>> points{a, b};
  const std::vector<std::array<VertexId, 2>> edges{{0, 1}};
  unsigned char tag = 2;
  tag_long_edges<2>(f, points, edges, 2.0, 0.01, {&tag, 1});
  CHECK(tag == 1);
}

TEST_CASE("the length does not depend on the direction or on the other edges") {
  const Case* c = find_case("circle2d");
  const auto f = field(c->formula);
  const auto mesh = std::get<Mesh<2>>(*parse_primitive(c->mesh));
  const auto edges = unique_edges(mesh);
  std::vector<double> lengths(edges.size());
  edge_lengths<2>(f, mesh.points, edges, lengths, {.panel = 0.05});
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Point<2>& a = mesh.points[edges[i][0]];
    const Point<2>& b = mesh.points[edges[i][1]];
    CHECK(edge_length(f, a, b, {.panel = 0.05}) == lengths[i]);
    CHECK(edge_length(f, b, a, {.panel = 0.05}) == lengths[i]);
  }
}

TEST_CASE("lengths are within the tolerance of those ten thousand times as exact") {
  for (const char* name : {"iso2d", "aniso2d", "circle2d", "masabl-1"}) {
    const Case* c = find_case(name);
    const auto f = field(c->formula);
    const auto mesh = std::get<Mesh<2>>(*parse_primitive(c->mesh));
    for (const auto& [a, b] : unique_edges(mesh)) {
      const double exact = edge_length(f, mesh.points[a], mesh.points[b], {.tolerance = 1e-12, .panel = 0.01});
      CHECK(edge_length(f, mesh.points[a], mesh.points[b]) == Approx(exact).epsilon(1e-6));
    }
  }
}

TEST_CASE("tags are what the lengths say") {
  const auto check = []<int Dim>(const Case& c, const Mesh<Dim>& mesh) {
    const auto f = field<Dim>(c.formula);
    const auto edges = unique_edges(mesh);
    const double panel = default_panel<Dim>(mesh.points);
    std::vector<double> lengths(edges.size());
    edge_lengths<Dim>(f, mesh.points, edges, lengths, {.panel = panel});
    for (const double threshold : {0.5, 1.0, 2.0, 4.0}) {
      std::vector<unsigned char> tags(edges.size(), 7);
      tag_long_edges<Dim>(f, mesh.points, edges, threshold, panel, tags);
      int tagged = 0;
      for (std::size_t i = 0; i < edges.size(); ++i) {
        if (std::fabs(lengths[i] - threshold) > 1e-6 * threshold) CHECK((tags[i] == 1) == (lengths[i] > threshold));
        CHECK(tags[i] <= 1);
        tagged += tags[i];
      }
      if (threshold == 2.0) CHECK(tagged > 0);
    }
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

TEST_CASE("where the metric is not a number, neither is the length") {
  const auto f = field("h = x");
  CHECK(std::isnan(edge_length(f, Point<2>(-1, 0), Point<2>(1, 0))));
  CHECK(edge_length(f, Point<2>(1, 0), Point<2>(2, 0)) == Approx(std::log(2.0)));
}

TEST_CASE("the default panel follows the size of the domain") {
  const std::vector<Point<2>> points{{0, 0}, {3, 1}, {1, 4}};
  CHECK(default_panel<2>(points) == Approx(5.0 / 256));
  CHECK(default_panel<2>({}) == 0.0);
}

}  // namespace length_test
