// A background in place of the formula that it samples: the same mesh statistics within 3 %.
#include <cmath>

#include "../catch.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/metric/nodal.h"
#include "pillowmesh/quality/report.h"

namespace sampled_metric_test {

using namespace pillowmesh;

namespace {

template <int Dim>
MetricField<Dim> formula_of(const char* name) {
  return *MetricField<Dim>::from_formula(find_case(name)->formula);
}
template <int Dim>
Mesh<Dim> mesh_of(const char* name) {
  return std::get<Mesh<Dim>>(*parse_primitive(find_case(name)->mesh));
}

/// The case's metric at the vertices of a grid of n cells along each side of the domain.
template <int Dim>
MetricField<Dim> sampled(const char* name, int n) {
  Point<Dim> low = Point<Dim>::Constant(1e300), high = -low;
  for (const Point<Dim>& p : mesh_of<Dim>(name).points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::array<int, Dim> count;
  count.fill(n);
  return *look_up(sample_at_vertices(formula_of<Dim>(name), make_grid<Dim>(count, low, high)));
}

template <int Dim>
Mesh<Dim> adapted(const char* name, const MetricField<Dim>& field, Method method) {
  AdaptOptions options;
  options.method = method;
  options.effort = Effort::normal;
  Adapter<Dim> adapter(mesh_of<Dim>(name), field, options);
  (void)adapter.run();
  return adapter.mesh();
}

void check_near(const Report& a, const Report& b, double share) {
  CHECK(a.cells == Approx(b.cells).epsilon(share));
  CHECK(a.complexity == Approx(b.complexity).epsilon(share));
  CHECK(a.edge_length.mean == Approx(b.edge_length.mean).epsilon(share));
  CHECK(a.edge_length.cv == Approx(b.edge_length.cv).epsilon(share));
  CHECK(a.shape.mean == Approx(b.shape.mean).epsilon(share));
  CHECK(a.shape_integral.mean == Approx(b.shape_integral.mean).epsilon(share));
}

/// Each run measured in the metric that it was given.
template <int Dim>
void check_runs(const char* name, int n) {
  INFO(name);
  const auto formula = formula_of<Dim>(name), background = sampled<Dim>(name, n);
  check_near(measure(adapted<Dim>(name, background, Method::paper), background),
             measure(adapted<Dim>(name, formula, Method::paper), formula), 0.03);
}

}  // namespace

TEST_CASE("layers from a background have the statistics of those from the formula that it samples, within 3 %") {
  check_runs<2>("iso2d", 316);
  check_runs<2>("circle2d", 316);
  check_runs<3>("linear3d", 24);
}

TEST_CASE("one fully adapted mesh has the same statistics in a metric and in a background of it, within 3 %") {
  const auto formula = formula_of<2>("iso2d"), background = sampled<2>("iso2d", 200);
  const Mesh<2> mesh = adapted<2>("iso2d", background, Method::full);
  check_near(measure(mesh, background), measure(mesh, formula), 0.03);
}

}  // namespace sampled_metric_test
