#include "c_api.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "events.h"
#include "input_bytes.h"
#include "nodal_bytes.h"
#include "pillowmesh/adapt/adapter.h"
#include "pillowmesh/mesh/any_mesh.h"
#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/edge_table.h"
#include "pillowmesh/mesh/primitives.h"
#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/field.h"
#include "pillowmesh/metric/gallery.h"
#include "pillowmesh/metric/length.h"
#include "pillowmesh/quality/report.h"
#include "pillowmesh/quality/shape.h"

#ifndef PILLOWMESH_VERSION
#define PILLOWMESH_VERSION "0.1.0"
#endif

using namespace pillowmesh;

namespace {

/// All of a session that depends on the dimension.
template <int Dim>
struct Problem {
  static constexpr int dimension = Dim;
  Mesh<Dim> mesh;
  std::optional<MetricField<Dim>> field;
  std::optional<Adapter<Dim>> adapter;

  [[nodiscard]] const Mesh<Dim>& current() const { return adapter ? adapter->mesh() : mesh; }
};

using AnyProblem = AnyOf<Problem, std::monostate>;

template <int Dim>
std::span<const Point<Dim>> as_points(const double* coordinates, std::uint32_t count) {
  static_assert(sizeof(Point<Dim>) == Dim * sizeof(double));
  return {reinterpret_cast<const Point<Dim>*>(coordinates), count};
}

template <int Dim>
std::span<const Corners<Dim>> as_cells(const std::int32_t* corners, std::uint32_t count) {
  static_assert(sizeof(Corners<Dim>) == Cell<Dim>::corners * sizeof(std::int32_t));
  return {reinterpret_cast<const Corners<Dim>*>(corners), count};
}

/// Points and cells are all that shapes and lengths need.
template <int Dim>
Mesh<Dim> bare_mesh(std::span<const Point<Dim>> points, std::span<const Corners<Dim>> cells) {
  Mesh<Dim> mesh;
  mesh.points.assign(points.begin(), points.end());
  mesh.cells.assign(cells.begin(), cells.end());
  return mesh;
}

template <int Dim>
Status check_cells(std::span<const Corners<Dim>> cells, std::uint32_t point_count) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c][0] == kNone) continue;
    for (const VertexId v : cells[c])
      if (v < 0 || static_cast<std::uint32_t>(v) >= point_count)
        return Status::usage("cell " + std::to_string(c) + " names point " + std::to_string(v) + " of " +
                             std::to_string(point_count) + ".");
  }
  return {};
}

template <int Dim>
Expected<AnyMesh> mesh_from_bytes(std::string_view name, std::span<const char> bytes, const BoundaryOptions& options) {
  auto input = from_bytes<Dim>(bytes);
  if (!input) return input.status();
  return make_any_mesh(std::move(*input), name, options);
}

template <int Dim>
Status use_metric(Problem<Dim>& p, const Expected<MetricField<Dim>>& field, double scale) {
  if (!(scale > 0.0)) return Status::usage("The size factor must be positive.");
  if (!field) return field.status();
  if (Status usable = field->check(p.mesh.points); !usable.ok()) return usable;
  p.field = scale == 1.0 ? *field : field->scaled(scale);
  p.adapter.reset();
  return {};
}

void append_quoted(std::string_view text, std::string& json) {
  json += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') json += '\\';
    if (c == '\n') {
      json += "\\n";
    } else {
      json += c;
    }
  }
  json += '"';
}

std::string cases_as_json() {
  std::string json = "[";
  const auto append = [&](const Case& c) {
    if (json.size() > 1) json += ",";
    json += "\n{\"name\": ";
    append_quoted(c.name, json);
    json += ", \"dim\": " + std::to_string(c.dim);
    const std::pair<const char*, std::string_view> texts[] = {
        {"title", c.title}, {"mesh", c.mesh}, {"formula", c.formula}, {"source", c.source}};
    for (const auto& [key, text] : texts) {
      json += std::string(", \"") + key + "\": ";
      append_quoted(text, json);
    }
    json += "}";
  };
  for (const Case& c : gallery()) append(c);
  append(portrait_case());
  return json + "\n]\n";
}

}  // namespace

struct pm_session {
  AnyProblem problem;
  AdaptOptions options;
  Status last;
  std::vector<std::int32_t> ints;
  std::vector<double> doubles;
  std::string bytes;

  pm_status finish(Status status) {
    last = std::move(status);
    return static_cast<pm_status>(last.code);
  }

  /// Calls body(problem) -> Status with the problem of the loaded mesh's dimension.
  template <class Body>
  pm_status with_mesh(Body&& body) {
    return finish(std::visit(
        [&](auto& p) -> Status {
          if constexpr (std::is_same_v<std::decay_t<decltype(p)>, std::monostate>) {
            return Status::usage("No mesh is loaded.");
          } else {
            return body(p);
          }
        },
        problem));
  }

  /// As with_mesh, when there is a metric as well.
  template <class Body>
  pm_status with_metric(Body&& body) {
    return with_mesh([&](auto& p) -> Status {
      if (!p.field) return Status::usage("No metric is set.");
      return body(p);
    });
  }

  pm_status load(Expected<AnyMesh> mesh) {
    if (!mesh) return finish(mesh.status());
    std::visit([this](auto& m) { replace_mesh(m); }, *mesh);
    return finish({});
  }

 private:
  template <int Dim>
  void replace_mesh(Mesh<Dim>& mesh) {
    Problem<Dim> next;
    if (auto* now = std::get_if<Problem<Dim>>(&problem)) next.field = now->field;
    next.mesh = std::move(mesh);
    problem = std::move(next);
  }
};

extern "C" {

const char* pm_version(void) { return PILLOWMESH_VERSION; }

const char* pm_cases(void) {
  static const std::string json = cases_as_json();
  return json.c_str();
}

pm_session* pm_create(void) { return new pm_session; }
void pm_destroy(pm_session* session) { delete session; }
const char* pm_message(const pm_session* session) { return session->last.message.c_str(); }

const int32_t* pm_ints(const pm_session* session) { return session->ints.data(); }
uint32_t pm_int_count(const pm_session* session) { return static_cast<uint32_t>(session->ints.size()); }
const double* pm_doubles(const pm_session* session) { return session->doubles.data(); }
uint32_t pm_double_count(const pm_session* session) { return static_cast<uint32_t>(session->doubles.size()); }
const char* pm_bytes(const pm_session* session) { return session->bytes.data(); }
uint32_t pm_byte_count(const pm_session* session) { return static_cast<uint32_t>(session->bytes.size()); }

pm_status pm_load_input(pm_session* session, const char* name, uint32_t name_size, const char* bytes, uint32_t size) {
  const std::string_view file(name, name_size);
  switch (dimension_of({bytes, size})) {
    case 2:
      return session->load(mesh_from_bytes<2>(file, {bytes, size}, session->options.boundary));
    case 3:
      return session->load(mesh_from_bytes<3>(file, {bytes, size}, session->options.boundary));
    default:
      return session->finish(Status::usage("These are not the bytes of a mesh."));
  }
}

pm_status pm_load_grid(pm_session* session, const char* spec, uint32_t size) {
  return session->load(parse_primitive({spec, size}, session->options.boundary.freeze));
}

pm_status pm_load_case(pm_session* session, const char* name, uint32_t size) {
  const std::string_view wanted(name, size);
  const Case* found = wanted == portrait_case().name ? &portrait_case() : find_case(wanted);
  if (found == nullptr)
    return session->finish(Status::usage("There is no case named \"" + std::string(name, size) + "\"."));
  const pm_status status = session->load(parse_primitive(found->mesh, session->options.boundary.freeze));
  if (status != PM_OK || found->formula.empty()) return status;
  return pm_set_metric(session, found->formula.data(), static_cast<uint32_t>(found->formula.size()), 1.0);
}

pm_status pm_set_metric(pm_session* session, const char* formula, uint32_t size, double scale) {
  return session->with_mesh([&](auto& p) -> Status {
    return use_metric(p, MetricField<std::decay_t<decltype(p)>::dimension>::from_formula({formula, size}), scale);
  });
}

pm_status pm_set_nodal(pm_session* session, const char* bytes, uint32_t size, double scale) {
  return session->with_mesh([&](auto& p) -> Status {
    return use_metric(p, field_from_bytes<std::decay_t<decltype(p)>::dimension>({bytes, size}), scale);
  });
}

pm_status pm_set_option(pm_session* session, const char* name, uint32_t name_size, const char* value, uint32_t size) {
  return session->finish(set_option(session->options, {name, name_size}, {value, size}));
}

pm_status pm_begin(pm_session* session) {
  return session->with_metric([&](auto& p) -> Status {
    constexpr int dim = std::decay_t<decltype(p)>::dimension;
    AdaptOptions options = session->options;
    if (dim == 2 && !kHasFullAdaptation && full_adaptation(options))
      return {StatusCode::other_build, "Full adaptation is left out of this build of pillowmesh."};
    options.record = true;
    p.adapter.emplace(p.mesh, *p.field, options);
    return {};
  });
}

pm_status pm_step(pm_session* session, uint32_t steps) {
  bool more = true;
  const pm_status status = session->with_metric([&](auto& p) -> Status {
    if (!p.adapter) return Status::usage("No run has begun.");
    for (uint32_t i = 0; i < steps && more; ++i) more = p.adapter->step();
    return more ? Status{} : p.adapter->outcome();
  });
  return status == PM_OK && more ? PM_MORE : status;
}

pm_status pm_take_events(pm_session* session) {
  session->ints.clear();
  session->doubles.clear();
  return session->with_mesh([&](auto& p) -> Status {
    if (!p.adapter) return {};
    for (const auto& event : p.adapter->take_events()) append_event(event, session->ints, session->doubles);
    return {};
  });
}

int32_t pm_dimension(const pm_session* session) {
  return std::visit(
      [](const auto& p) -> int32_t {
        if constexpr (std::is_same_v<std::decay_t<decltype(p)>, std::monostate>) {
          return 0;
        } else {
          return std::decay_t<decltype(p)>::dimension;
        }
      },
      session->problem);
}

pm_status pm_mesh(pm_session* session) {
  return session->with_mesh([&](auto& p) -> Status {
    const auto& mesh = p.current();
    session->ints.clear();
    session->doubles.clear();
    for (const auto& corners : mesh.cells) session->ints.insert(session->ints.end(), corners.begin(), corners.end());
    for (const auto& point : mesh.points)
      session->doubles.insert(session->doubles.end(), point.data(), point.data() + point.size());
    return {};
  });
}

pm_status pm_report(pm_session* session) {
  return session->with_metric([&](auto& p) -> Status {
    Report report = measure(p.current(), *p.field);
    if (p.adapter) {
      report.seconds = p.adapter->seconds();
      report.operations = p.adapter->operations();
    }
    session->bytes = to_json(report);
    return {};
  });
}

pm_status pm_input(pm_session* session) {
  return session->with_mesh([&](auto& p) -> Status {
    session->bytes = to_bytes(to_input(p.current()));
    return {};
  });
}

pm_status pm_tensors(pm_session* session, const double* points, uint32_t point_count) {
  return session->with_metric([&](auto& p) -> Status {
    constexpr int dim = std::decay_t<decltype(p)>::dimension;
    std::vector<SymTensor<dim>> tensors(point_count);
    p.field->evaluate(as_points<dim>(points, point_count), tensors);
    session->doubles.clear();
    for (const auto& t : tensors) session->doubles.insert(session->doubles.end(), t.m.begin(), t.m.end());
    return {};
  });
}

pm_status pm_cell_shapes(pm_session* session, const double* points, uint32_t point_count, const int32_t* cells,
                         uint32_t cell_count) {
  return session->with_metric([&](auto& p) -> Status {
    constexpr int dim = std::decay_t<decltype(p)>::dimension;
    const auto corners = as_cells<dim>(cells, cell_count);
    if (Status fits = check_cells<dim>(corners, point_count); !fits.ok()) return fits;
    const Mesh<dim> mesh = bare_mesh<dim>(as_points<dim>(points, point_count), corners);
    const std::vector<CellId> live = live_cells(mesh);
    std::vector<double> shapes(live.size());
    cell_shapes<dim>(mesh, *p.field, live, shapes, {});
    session->doubles.assign(cell_count, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < live.size(); ++i) session->doubles[live[i]] = shapes[i];
    return {};
  });
}

pm_status pm_edge_lengths(pm_session* session, const double* points, uint32_t point_count, const int32_t* cells,
                          uint32_t cell_count) {
  return session->with_metric([&](auto& p) -> Status {
    constexpr int dim = std::decay_t<decltype(p)>::dimension;
    const auto corners = as_cells<dim>(cells, cell_count);
    if (Status fits = check_cells<dim>(corners, point_count); !fits.ok()) return fits;
    const Mesh<dim> mesh = bare_mesh<dim>(as_points<dim>(points, point_count), corners);
    const EdgeTable table(mesh, live_cells(mesh));
    std::vector<std::array<VertexId, 2>> edges;
    for (Index e = 0; e < table.size(); ++e) edges.push_back(table[e]);
    session->doubles.resize(edges.size());
    edge_lengths<dim>(*p.field, mesh.points, edges, session->doubles);
    session->ints.clear();
    for (const auto& e : edges) session->ints.insert(session->ints.end(), e.begin(), e.end());
    return {};
  });
}

}  // extern "C"
