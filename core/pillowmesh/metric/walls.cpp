#include "pillowmesh/metric/walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pillowmesh/mesh/number.h"
#include "pillowmesh/metric/intersection.h"
#include "pillowmesh/metric/sample.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

template <int Dim>
void box_of(const Mesh<Dim>& mesh, Point<Dim>& low, Point<Dim>& high) {
  low = high = mesh.points[0];
  for (const Point<Dim>& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
}

template <int Dim>
bool names(const std::string& wanted, const Group& group) {
  return wanted == "all" || (!group.name.empty() && wanted == group.name) || wanted == std::to_string(group.tag);
}

/// Facets of walls as simplices, with boxes of runs of them, so that far ones are passed over.
template <int Dim>
class Wall {
 public:
  Wall(const Mesh<Dim>& mesh, const std::string& group) {
    for (CellId c = 0; c < mesh.cell_count(); ++c) {
      if (!mesh.alive(c)) continue;
      for (int f = 0; f < Cell<Dim>::facets; ++f) {
        if (!mesh.on_boundary(c, f) || !names<Dim>(group, mesh.patch_groups[mesh.patch_of(c, f)])) continue;
        const auto v = mesh.facet_vertices(c, f);
        if constexpr (Dim == 2) {
          add({mesh.points[v[0]], mesh.points[v[1]]});
        } else {
          add({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[3]]});
          add({mesh.points[v[0]], mesh.points[v[3]], mesh.points[v[2]]});
        }
      }
    }
  }
  [[nodiscard]] bool empty() const { return facets_.empty(); }

  struct Place {
    Point<Dim> point;
    Point<Dim> normal;  ///< of the facet, of length 1
  };
  [[nodiscard]] Place nearest(const Point<Dim>& p) const {
    Point<Dim> best = facets_[0][0];
    std::size_t facet = 0;
    double square = (p - best).squaredNorm();
    for (std::size_t run = 0; run < low_.size(); ++run) {
      double gap = 0.0;
      for (int d = 0; d < Dim; ++d) {
        const double g = std::max({low_[run][d] - p[d], p[d] - high_[run][d], 0.0});
        gap += g * g;
      }
      if (gap >= square) continue;
      for (std::size_t i = run * kRun; i < std::min(facets_.size(), (run + 1) * kRun); ++i) {
        const Point<Dim> q = nearest_on(facets_[i], p);
        const double s = (q - p).squaredNorm();
        if (s < square) square = s, best = q, facet = i;
      }
    }
    return {best, normal_of(facets_[facet])};
  }

 private:
  static constexpr std::size_t kRun = 16;
  using Facet = std::array<Point<Dim>, Dim>;

  void add(const Facet& facet) {
    if (facets_.size() % kRun == 0) {
      low_.push_back(facet[0]);
      high_.push_back(facet[0]);
    }
    facets_.push_back(facet);
    for (const Point<Dim>& p : facet) {
      low_.back() = low_.back().cwiseMin(p);
      high_.back() = high_.back().cwiseMax(p);
    }
  }

  static Point<Dim> normal_of(const Facet& f) {
    const Point<Dim> a = f[1] - f[0];
    Point<Dim> n;
    if constexpr (Dim == 2) {
      n = {a[1], -a[0]};
    } else {
      const Point<Dim> b = f[2] - f[0];
      n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    return n / n.norm();
  }
  static Point<Dim> on_segment(const Point<Dim>& a, const Point<Dim>& b, const Point<Dim>& p) {
    const Point<Dim> e = b - a;
    return a + std::clamp((p - a).dot(e) / e.squaredNorm(), 0.0, 1.0) * e;
  }
  static Point<Dim> nearest_on(const Facet& f, const Point<Dim>& p) {
    if constexpr (Dim == 2) {
      return on_segment(f[0], f[1], p);
    } else {
      const Point<Dim> a = f[1] - f[0], b = f[2] - f[0], q = p - f[0];
      const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), aq = a.dot(q), bq = b.dot(q), det = aa * bb - ab * ab;
      const double s = bb * aq - ab * bq, t = aa * bq - ab * aq;
      if (det > 0.0 && s >= 0.0 && t >= 0.0 && s + t <= det) return f[0] + (s / det) * a + (t / det) * b;
      Point<Dim> best = on_segment(f[0], f[1], p);
      for (int k = 1; k < 3; ++k) {
        const Point<Dim> side = on_segment(f[k], f[(k + 1) % 3], p);
        if ((side - p).squaredNorm() < (best - p).squaredNorm()) best = side;
      }
      return best;
    }
  }

  std::vector<Facet> facets_;
  std::vector<Point<Dim>> low_, high_;
};

template <int Dim>
std::string list_groups(const Mesh<Dim>& mesh) {
  std::vector<std::string> known;
  for (const Group& g : mesh.patch_groups) {
    std::string name = g.name.empty() ? std::to_string(g.tag) : g.name;
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(std::move(name));
  }
  std::string all = "all";
  for (const std::string& name : known) all += ", " + name;
  return all;
}

/// The height `height` across direction n, `along` otherwise.
template <int Dim>
SymTensor<Dim> layered(const Point<Dim>& n, double height, double along) {
  const double across = 1.0 / (height * height), rest = 1.0 / (along * along);
  SymTensor<Dim> M;
  for (int j = 0; j < Dim; ++j)
    for (int i = 0; i <= j; ++i) M(i, j) = (across - rest) * n[i] * n[j] + (i == j ? rest : 0.0);
  return M;
}

}  // namespace

Expected<WallLayer> parse_wall_layer(std::string_view text) {
  const std::size_t second = text.rfind(':'),
                    first = second == 0 ? std::string_view::npos : text.rfind(':', second - 1);
  WallLayer layer;
  const bool usable = second != std::string_view::npos && first != std::string_view::npos && first > 0 &&
                      parse_double(text.substr(first + 1, second - first - 1), layer.first) &&
                      parse_double(text.substr(second + 1), layer.growth) && layer.first > 0.0 && layer.first < 1e100 &&
                      layer.growth >= 1.0 && layer.growth < 100.0;
  if (!usable)
    return Status::usage(
        "a boundary layer is GROUP:FIRST:GROWTH, e.g. wall:0.001:1.3, with a height above 0 and a growth from 1; not "
        "'" +
        std::string(text) + "'");
  layer.group = std::string(text.substr(0, first));
  return layer;
}

template <int Dim>
Expected<NodalMetric<Dim>> wall_metric(const Mesh<Dim>& mesh, const std::vector<WallLayer>& layers) {
  std::vector<Wall<Dim>> walls;
  for (const WallLayer& layer : layers) {
    walls.emplace_back(mesh, layer.group);
    if (walls.back().empty())
      return Status::usage("there is no boundary group '" + layer.group + "'; there are " + list_groups(mesh));
  }
  Point<Dim> low, high;
  box_of(mesh, low, high);
  const double tiny = 1e-12 * (high - low).norm();
  const Evaluate<Dim> metric = [&](std::span<const Point<Dim>> points, std::span<SymTensor<Dim>> out) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < walls.size(); ++k) {
        const auto place = walls[k].nearest(points[i]);
        const Point<Dim> away = points[i] - place.point;
        const double distance = away.norm();
        const double height = std::min(layers[k].along, layers[k].first + (layers[k].growth - 1.0) * distance);
        // On the wall itself there is no direction away from it but the facet's.
        const Point<Dim> n = distance > tiny ? Point<Dim>(away / distance) : place.normal;
        const SymTensor<Dim> M = layered<Dim>(n, height, layers[k].along);
        out[i] = k == 0 ? M : intersect(out[i], M);
      }
    }
  };
  SampleOptions options;
  options.max_points = Dim == 2 ? 80'000 : 60'000;
  return sample<Dim>(metric, low, high, options);
}

Expected<NodalMetric<2>> curvature_metric(const Mesh<2>& mesh, double per_turn, double growth, double largest) {
  // The neighbours of each vertex of a boundary curve on it.
  std::vector<std::array<VertexId, 2>> beside(mesh.points.size(), {kNone, kNone});
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    for (int f = 0; f < Cell<2>::facets; ++f) {
      if (!mesh.on_boundary(c, f)) continue;
      const auto v = mesh.facet_vertices(c, f);
      for (int k = 0; k < 2; ++k) (beside[v[k]][0] == kNone ? beside[v[k]][0] : beside[v[k]][1]) = v[1 - k];
    }
  }
  struct Source {
    Point<2> at;
    double size;
  };
  std::vector<Source> sources;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (beside[v][1] == kNone || mesh.support[v].dim != 1) continue;
    const Point<2> a = mesh.points[beside[v][0]] - mesh.points[v], b = mesh.points[beside[v][1]] - mesh.points[v];
    const double twice_area = std::fabs(a[0] * b[1] - a[1] * b[0]), product = a.norm() * b.norm() * (a - b).norm();
    if (!(twice_area > 1e-9 * a.norm() * b.norm())) continue;  // straight
    const double radius = 0.5 * product / twice_area;
    sources.push_back({mesh.points[v], std::min(largest, 2.0 * std::numbers::pi * radius / per_turn)});
  }
  if (sources.empty())
    return Status::bad_input("no boundary curve of the mesh is curved: --curvature has nothing to resolve");
  Point<2> low, high;
  box_of(mesh, low, high);
  const Evaluate<2> metric = [&](std::span<const Point<2>> points, std::span<SymTensor<2>> out) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      double size = largest;
      for (const Source& s : sources) size = std::min(size, s.size + (growth - 1.0) * (points[i] - s.at).norm());
      out[i] = SymTensor<2>::isotropic(size);
    }
  };
  SampleOptions options;
  options.max_points = 40'000;
  return sample<2>(metric, low, high, options);
}

template <int Dim>
NodalMetric<Dim> implied_metric(const Mesh<Dim>& mesh) {
  NodalMetric<Dim> out{mesh.points, divide<Dim>(mesh.points, mesh.cells), {}};
  out.tensors.resize(mesh.points.size());
  std::vector<double> weights(mesh.points.size(), 0.0);
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    if (!mesh.alive(c)) continue;
    SymTensor<Dim> G;  // J J', whose inverse has length 1 along each mean edge
    for (int axis = 0; axis < Dim; ++axis) {
      Point<Dim> mean = Point<Dim>::Zero();
      for (int k = 0; k < Cell<Dim>::edges_per_axis; ++k) {
        const int e = Cell<Dim>::edge(axis, k);
        mean +=
            (mesh.points[mesh.cells[c][Cell<Dim>::edge_to(e)]] - mesh.points[mesh.cells[c][Cell<Dim>::edge_from(e)]]) /
            Cell<Dim>::edges_per_axis;
      }
      for (int j = 0; j < Dim; ++j)
        for (int i = 0; i <= j; ++i) G(i, j) += mean[i] * mean[j];
    }
    const double volume = std::sqrt(std::max(0.0, determinant(G)));
    if (!(volume > 0.0)) continue;
    const SymTensor<Dim> log = log_tensor(G);
    for (const VertexId v : mesh.cells[c]) {
      out.tensors[v] = out.tensors[v] + (-volume) * log;
      weights[v] += volume;
    }
  }
  for (std::size_t v = 0; v < weights.size(); ++v) out.tensors[v] = exp_tensor((1.0 / weights[v]) * out.tensors[v]);
  return out;
}

#define PILLOWMESH_INSTANTIATE(D)                                                                  \
  template Expected<NodalMetric<D>> wall_metric<D>(const Mesh<D>&, const std::vector<WallLayer>&); \
  template NodalMetric<D> implied_metric<D>(const Mesh<D>&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
