#include "metrics_api.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "input_bytes.h"
#include "nodal_bytes.h"
#include "pillowmesh/io/background_file.h"
#include "pillowmesh/io/sol.h"
#include "pillowmesh/mesh/any_mesh.h"
#include "pillowmesh/mesh/number.h"
#include "pillowmesh/metric/combine.h"
#include "pillowmesh/metric/hessian.h"
#include "pillowmesh/metric/image.h"
#include "pillowmesh/metric/portrait.h"
#include "pillowmesh/metric/sketch.h"
#include "pillowmesh/metric/walls.h"

using namespace pillowmesh;

namespace {

template <int Dim>
struct Workbench {
  static constexpr int dimension = Dim;
  Mesh<Dim> mesh;
  Point<Dim> low, high;
  std::vector<MetricSource<Dim>> sources;
  std::vector<WallLayer> layers;  ///< their size along the wall is known when --hmax is

  explicit Workbench(Mesh<Dim> m) : mesh(std::move(m)), low(mesh.points[0]), high(low) {
    for (const Point<Dim>& p : mesh.points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
};

template <int Dim>
Expected<AnyMesh> mesh_from_bytes(std::span<const char> bytes) {
  auto input = from_bytes<Dim>(bytes);
  if (!input) return input.status();
  return make_any_mesh(std::move(*input), "the mesh");
}
Expected<AnyMesh> any_mesh_from_bytes(std::span<const char> bytes) {
  const int dim = dimension_of(bytes);
  if (dim == 0) return Status::usage("These are not the bytes of a mesh.");
  return dim == 2 ? mesh_from_bytes<2>(bytes) : mesh_from_bytes<3>(bytes);
}

Status positive(std::string_view name, std::string_view value, double& out) {
  if (parse_double(value, out) && out > 0.0) return {};
  return Status::usage("--" + std::string(name) + " takes a number above 0, not '" + std::string(value) + "'");
}

}  // namespace

struct pm_metrics {
  std::variant<std::monostate, Workbench<2>, Workbench<3>> bench;
  std::variant<std::monostate, NodalMetric<2>, NodalMetric<3>> background;  ///< of the next .sol
  MetricOperations operations;
  double norm = 0.0, error = 0.0;
  bool picture = false;
  Status last;
  std::string bytes;

  pm_status finish(Status status) {
    last = std::move(status);
    return static_cast<pm_status>(last.code);
  }
  /// Calls body(bench) -> Status.
  template <class Body>
  pm_status with_mesh(Body&& body) {
    return finish(std::visit(
        [&](auto& b) -> Status {
          if constexpr (std::is_same_v<std::decay_t<decltype(b)>, std::monostate>)
            return Status::usage("A metric is made for a mesh, and none has been given.");
          else
            return body(b);
        },
        bench));
  }
  /// Calls make(bench), which gives a source, in two dimensions.
  template <class Make>
  pm_status add_flat(Make&& make) {
    return with_mesh([&](auto& b) -> Status {
      if constexpr (std::decay_t<decltype(b)>::dimension == 2)
        return add(b, make(b));
      else
        return Status::usage("Pictures, sketches and curvature are for two-dimensional meshes.");
    });
  }
  template <int Dim>
  static Status add(Workbench<Dim>& b, Expected<NodalMetric<Dim>> metric) {
    if (!metric) return metric.status();
    b.sources.push_back(std::move(*metric));
    return {};
  }
  [[nodiscard]] HessianOptions hessian(HessianOptions options) const {
    if (norm > 0.0) options.norm = norm;
    options.error = error;
    return options;
  }
  template <int Dim>
  [[nodiscard]] double coarsest(const Workbench<Dim>& b) const {
    const double largest = operations.bounds.largest;
    return largest < 1e100 ? largest : 0.1 * (b.high - b.low).norm();
  }
  pm_status add_image(const GrayImage& image) {
    return add_flat([&](auto& b) {
      ImageOptions options;
      options.hessian = hessian(options.hessian);
      picture = true;
      return image_metric(image, b.low, b.high, options);
    });
  }
  /// Reads a .sol and calls make(background, file) -> Status, which sets the tensors.
  template <class Make>
  pm_status add_sol(std::string_view name, std::span<const char> file, Make&& make) {
    return with_mesh([&](auto& b) -> Status {
      constexpr int dim = std::decay_t<decltype(b)>::dimension;
      NodalMetric<dim> metric{b.mesh.points, {}, {}};
      if (auto* given = std::get_if<NodalMetric<dim>>(&background))
        metric = std::move(*given);
      else
        metric.simplices = divide<dim>(b.mesh.points, b.mesh.cells);
      background = std::monostate();
      const auto sol = read_sol(name, file);
      if (!sol) return sol.status();
      if (Status s = make(metric, *sol); !s.ok()) return s;
      b.sources.push_back(std::move(metric));
      return {};
    });
  }
};

extern "C" {

pm_metrics* pm_metrics_create(void) { return new pm_metrics; }
void pm_metrics_destroy(pm_metrics* metrics) { delete metrics; }
const char* pm_metrics_message(const pm_metrics* metrics) { return metrics->last.message.c_str(); }
const char* pm_metrics_bytes(const pm_metrics* metrics) { return metrics->bytes.data(); }
uint32_t pm_metrics_byte_count(const pm_metrics* metrics) { return static_cast<uint32_t>(metrics->bytes.size()); }

pm_status pm_metrics_mesh(pm_metrics* metrics, const char* bytes, uint32_t size) {
  auto mesh = any_mesh_from_bytes({bytes, size});
  if (!mesh) return metrics->finish(mesh.status());
  std::visit([&](auto& m) { metrics->bench = Workbench(std::move(m)); }, *mesh);
  return metrics->finish({});
}

pm_status pm_metrics_formula(pm_metrics* metrics, const char* formula, uint32_t size) {
  return metrics->with_mesh([&](auto& b) -> Status {
    auto field = MetricField<std::decay_t<decltype(b)>::dimension>::from_formula({formula, size});
    if (!field) return field.status();
    b.sources.push_back(std::move(*field));
    return {};
  });
}

pm_status pm_metrics_background(pm_metrics* metrics, const char* name, uint32_t name_size, const char* bytes,
                                uint32_t size) {
  auto background = read_background({name, name_size}, {bytes, size});
  if (!background) return metrics->finish(background.status());
  return metrics->with_mesh([&](auto& b) -> Status {
    auto* fits = std::get_if<NodalMetric<std::decay_t<decltype(b)>::dimension>>(&*background);
    if (fits == nullptr) return Status::usage("The background is not of the mesh's dimension.");
    metrics->background = std::move(*fits);
    return {};
  });
}

pm_status pm_metrics_sol(pm_metrics* metrics, const char* name, uint32_t name_size, const char* bytes, uint32_t size) {
  return metrics->add_sol({name, name_size}, {bytes, size}, [&](auto& metric, const SolFile& sol) -> Status {
    constexpr int dim = std::decay_t<decltype(metric.points[0])>::RowsAtCompileTime;
    auto tensors = metric_of_sol<dim>(sol, {name, name_size}, metric.points.size());
    if (!tensors) return tensors.status();
    metric.tensors = std::move(*tensors);
    return check_tensors<dim>(metric.tensors, metric.points.size());
  });
}

pm_status pm_metrics_hessian_sol(pm_metrics* metrics, const char* name, uint32_t name_size, const char* bytes,
                                 uint32_t size) {
  return metrics->add_sol({name, name_size}, {bytes, size}, [&](auto& metric, const SolFile& sol) -> Status {
    constexpr int dim = std::decay_t<decltype(metric.points[0])>::RowsAtCompileTime;
    auto values = scalar_of_sol(sol, {name, name_size}, dim, metric.points.size());
    if (!values) return values.status();
    metric.tensors = recover_hessian<dim>(metric.points, metric.simplices, *values);
    return multiscale_metric(metric, metrics->hessian({}));
  });
}

pm_status pm_metrics_hessian_of(pm_metrics* metrics, const char* formula, uint32_t size) {
  return metrics->with_mesh([&](auto& b) -> Status {
    auto hessian = FormulaHessian<std::decay_t<decltype(b)>::dimension>::from_formula({formula, size});
    if (!hessian) return hessian.status();
    return pm_metrics::add(b, hessian_metric(*hessian, b.low, b.high, metrics->hessian({})));
  });
}

pm_status pm_metrics_image(pm_metrics* metrics, const uint8_t* gray, uint32_t size, uint32_t width) {
  GrayImage image{static_cast<int>(width), width == 0 ? 0 : static_cast<int>(size / width), {}};
  image.values.assign(gray, gray + size);
  for (float& v : image.values) v /= 255.0F;
  return metrics->add_image(image);
}

pm_status pm_metrics_portrait(pm_metrics* metrics) { return metrics->add_image(portrait(256, 320)); }

pm_status pm_metrics_sketch(pm_metrics* metrics, const double* dabs, uint32_t bytes, double paper) {
  static_assert(sizeof(Dab) == 6 * sizeof(double));
  const std::span<const Dab> all(reinterpret_cast<const Dab*>(dabs), bytes / sizeof(Dab));
  return metrics->add_flat(
      [&](auto& b) { return sketch_metric(all, paper > 0.0 ? paper : metrics->coarsest(b), b.low, b.high); });
}

pm_status pm_metrics_layer(pm_metrics* metrics, const char* layer, uint32_t size) {
  return metrics->with_mesh([&](auto& b) -> Status {
    auto parsed = parse_wall_layer({layer, size});
    if (parsed) b.layers.push_back(std::move(*parsed));
    return parsed.status();
  });
}

pm_status pm_metrics_curvature(pm_metrics* metrics, double per_turn) {
  return metrics->add_flat([&](auto& b) { return curvature_metric(b.mesh, per_turn, 1.3, metrics->coarsest(b)); });
}

pm_status pm_metrics_implied(pm_metrics* metrics, const char* bytes, uint32_t size) {
  auto mesh = any_mesh_from_bytes({bytes, size});
  if (!mesh) return metrics->finish(mesh.status());
  return metrics->with_mesh([&](auto& b) -> Status {
    const auto* m = std::get_if<Mesh<std::decay_t<decltype(b)>::dimension>>(&*mesh);
    if (m == nullptr) return Status::usage("The mesh to take the metric of is of another dimension.");
    b.sources.push_back(implied_metric(*m));
    return {};
  });
}

pm_status pm_metrics_option(pm_metrics* metrics, const char* name, uint32_t name_size, const char* value,
                            uint32_t size) {
  const std::string_view option(name, name_size), text(value, size);
  if (option == "norm") return metrics->finish(positive(option, text, metrics->norm));
  if (option == "error") return metrics->finish(positive(option, text, metrics->error));
  return metrics->finish(set_operation(metrics->operations, option, text));
}

pm_status pm_metrics_build(pm_metrics* metrics) {
  metrics->bytes.clear();
  return metrics->with_mesh([&](auto& b) -> Status {
    MetricOperations operations = metrics->operations;
    if (metrics->picture) use_picture_defaults(operations, metrics->error);
    auto sources = b.sources;
    if (!b.layers.empty()) {
      for (WallLayer& layer : b.layers) layer.along = metrics->coarsest(b);
      auto walls = wall_metric(b.mesh, b.layers);
      if (!walls) return walls.status();
      sources.push_back(std::move(*walls));
    }
    if (sources.empty()) return Status::usage("No metric has been given.");
    auto made = combine(sources, operations, b.mesh);
    if (!made) return made.status();
    metrics->bytes = nodal_to_bytes(*made);
    return {};
  });
}

}  // extern "C"
