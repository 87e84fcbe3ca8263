// Drives a run step by step, as a viewer does: prints what happens, and could stop at any time with a valid mesh.
#include <pillowmesh/adapt/adapter.h>
#include <pillowmesh/mesh/primitives.h>
#include <pillowmesh/metric/gallery.h>
#include <pillowmesh/quality/report.h>

#include <cstdio>

using namespace pillowmesh;

int main() {
  const Case& example = *find_case("circle2d");
  const auto field = MetricField<2>::from_formula(example.formula);
  const auto mesh = parse_primitive(example.mesh);

  AdaptOptions options;
  options.record = true;
  Adapter<2> adapter(std::get<Mesh<2>>(*mesh), *field, options);
  for (bool more = true; more;) {
    more = adapter.step();
    for (const Event<2>& event : adapter.take_events()) {
      if (event.kind == EventKind::tags) std::printf("%zu edges are too long\n", event.edges.size());
      if (event.kind == EventKind::iteration) std::printf("  now %d quads\n", adapter.mesh().cell_count());
    }
  }
  const Report report = measure(adapter.mesh(), *field);
  const Statistics& length = report.edge_length;
  std::printf("edge length %.3f on average (cv %.3f), worst shape %.3f\n", length.mean, length.cv, report.shape.min);
  return adapter.outcome().ok() && report.valid ? 0 : 1;
}
