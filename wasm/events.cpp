#include "events.h"

namespace pillowmesh {
namespace {

template <class Tuple>
void append_flat(const std::vector<Tuple>& tuples, std::vector<std::int32_t>& ints) {
  for (const Tuple& tuple : tuples) ints.insert(ints.end(), tuple.begin(), tuple.end());
}

template <int Dim>
void append_points(const std::vector<Point<Dim>>& points, std::vector<double>& doubles) {
  for (const Point<Dim>& p : points) doubles.insert(doubles.end(), p.data(), p.data() + Dim);
}

}  // namespace

template <int Dim>
void append_event(const Event<Dim>& event, std::vector<std::int32_t>& ints, std::vector<double>& doubles) {
  const MeshDelta<Dim>& delta = event.delta;
  const auto size = [](const auto& list) { return static_cast<std::int32_t>(list.size()); };
  const std::int32_t header[] = {static_cast<std::int32_t>(event.kind),
                                 event.iteration,
                                 size(event.edges),
                                 size(event.cells),
                                 size(event.hull),
                                 delta.vertices_before,
                                 delta.vertices_after,
                                 delta.cells_before,
                                 delta.cells_after,
                                 size(delta.vertices),
                                 size(delta.cells)};
  ints.insert(ints.end(), std::begin(header), std::end(header));
  append_flat(event.edges, ints);
  ints.insert(ints.end(), event.cells.begin(), event.cells.end());
  append_flat(event.hull, ints);
  ints.insert(ints.end(), delta.vertices.begin(), delta.vertices.end());
  ints.insert(ints.end(), delta.cells.begin(), delta.cells.end());
  append_flat(delta.old_corners, ints);
  append_flat(delta.new_corners, ints);

  doubles.push_back(event.value);
  append_points<Dim>(delta.old_points, doubles);
  append_points<Dim>(delta.new_points, doubles);
}

template void append_event<2>(const Event<2>&, std::vector<std::int32_t>&, std::vector<double>&);
template void append_event<3>(const Event<3>&, std::vector<std::int32_t>&, std::vector<double>&);

}  // namespace pillowmesh
