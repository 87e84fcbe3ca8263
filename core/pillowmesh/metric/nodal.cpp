#include "pillowmesh/metric/nodal.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "pillowmesh/mesh/number.h"
#include "pillowmesh/metric/discrete.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

void divide_cell(std::span<const Point<2>> points, const Corners<2>& c, std::vector<Simplex<2>>& out) {
  const Simplex<2> a[2] = {{c[0], c[1], c[3]}, {c[0], c[3], c[2]}}, b[2] = {{c[0], c[1], c[2]}, {c[1], c[3], c[2]}};
  const auto smaller = [&](const Simplex<2>* t) {
    return std::min(simplex_determinant<2>(points, t[0]), simplex_determinant<2>(points, t[1]));
  };
  const double of_a = smaller(a), of_b = smaller(b);
  // In a parallelogram both are equal but for rounding: then by the numbers, so that a grid has no preferred direction.
  const bool tie = std::fabs(of_a - of_b) <= 1e-9 * (std::fabs(of_a) + std::fabs(of_b));
  const Simplex<2>* chosen = (tie ? (c[0] & 1) == 0 : of_a > of_b) ? a : b;
  out.insert(out.end(), chosen, chosen + 2);
}

void divide_cell(std::span<const Point<3>>, const Corners<3>& c, std::vector<Simplex<3>>& out) {
  const int top = static_cast<int>(std::min_element(c.begin(), c.end()) - c.begin());
  for (int axis = 0; axis < 3; ++axis) {  // the three facets that do not touch the smallest vertex
    const int f = Cell<3>::facet(axis, 1 - ((top >> axis) & 1));
    std::array<VertexId, 4> v;
    for (int k = 0; k < 4; ++k) v[k] = c[Cell<3>::facet_corner(f, k)];
    if ((axis == 1) == (Cell<3>::facet_side(f) == 1)) std::swap(v[1], v[2]);  // seen from `top`, counterclockwise
    const int least = static_cast<int>(std::min_element(v.begin(), v.end()) - v.begin());
    const bool main_diagonal = least == 0 || least == 3;
    if (main_diagonal) {
      out.push_back({c[top], v[0], v[1], v[3]});
      out.push_back({c[top], v[0], v[3], v[2]});
    } else {
      out.push_back({c[top], v[0], v[1], v[2]});
      out.push_back({c[top], v[1], v[3], v[2]});
    }
  }
}

}  // namespace

template <int Dim>
std::vector<Simplex<Dim>> divide(std::span<const Point<Dim>> points, std::span<const Corners<Dim>> cells) {
  std::vector<Simplex<Dim>> out;
  out.reserve(cells.size() * (Dim == 2 ? 2 : 6));
  for (const Corners<Dim>& c : cells)
    if (c[0] != kNone) divide_cell(points, c, out);
  return out;
}

template <int Dim>
NodalMetric<Dim> nodal_grid(std::array<int, Dim> n, const Point<Dim>& low, const Point<Dim>& high) {
  NodalMetric<Dim> grid;
  std::array<Index, Dim + 1> stride{1};
  for (int d = 0; d < Dim; ++d) stride[d + 1] = stride[d] * (n[d] + 1);
  for (Index i = 0; i < stride[Dim]; ++i) {
    Point<Dim> p;
    for (int d = 0; d < Dim; ++d) {
      const double t = static_cast<double>(i / stride[d] % (n[d] + 1)) / n[d];
      p[d] = (1.0 - t) * low[d] + t * high[d];
    }
    grid.points.push_back(p);
  }
  std::vector<Corners<Dim>> cells;
  for (Index i = 0; i < stride[Dim]; ++i) {
    bool last = false;
    for (int d = 0; d < Dim; ++d) last = last || i / stride[d] % (n[d] + 1) == n[d];
    if (last) continue;
    Corners<Dim> c;
    for (int k = 0; k < Cell<Dim>::corners; ++k) {
      c[k] = i;
      for (int d = 0; d < Dim; ++d) c[k] += ((k >> d) & 1) * stride[d];
    }
    cells.push_back(c);
  }
  grid.simplices = divide<Dim>(grid.points, cells);
  grid.tensors.resize(grid.points.size());
  return grid;
}

template <int Dim>
NodalMetric<Dim> sample_at_vertices(const MetricField<Dim>& field, const Mesh<Dim>& mesh) {
  NodalMetric<Dim> metric{mesh.points, divide<Dim>(mesh.points, mesh.cells), {}};
  metric.tensors.resize(metric.points.size());
  field.evaluate(metric.points, metric.tensors);
  return metric;
}

template <int Dim>
Status check_tensors(std::span<const SymTensor<Dim>> tensors, std::size_t points) {
  if (tensors.size() != points)
    return Status::bad_input("there are " + std::to_string(tensors.size()) + " tensors for the " +
                             std::to_string(points) + " vertices of the background mesh");
  for (std::size_t i = 0; i < tensors.size(); ++i) {
    const auto at = [&](const char* reason) {
      std::string entries;
      for (const double m : tensors[i].m)
        entries += (entries.empty() ? "" : ", ") + (std::isfinite(m) ? rounded_text(m, 6) : std::string("not finite"));
      return Status::bad_input("vertex " + std::to_string(i + 1) + ": the tensor (" + entries + ") " + reason);
    };
    if (!positive_definite(tensors[i]))
      return at("is not finite and positive definite; sizes must be positive and finite in every direction");
    const Spectrum<Dim> s = spectrum(tensors[i]);
    if (!(s.value[0] >= 1e-200 && s.value[Dim - 1] <= 1e200)) return at("asks for sizes beyond 1e-100 or 1e100");
  }
  return {};
}

template <int Dim>
Expected<MetricField<Dim>> look_up(NodalMetric<Dim> metric) {
  if (Status s = check_tensors<Dim>(metric.tensors, metric.points.size()); !s.ok()) return s;
  for (SymTensor<Dim>& M : metric.tensors) M = log_tensor(M);
  auto discrete = DiscreteMetric<Dim>::make(std::move(metric.points), std::move(metric.simplices),
                                            std::move(metric.tensors));
  if (!discrete) return discrete.status();
  return MetricField<Dim>::discrete(std::move(*discrete));
}

#define PILLOWMESH_INSTANTIATE(D)                                                                           \
  template std::vector<Simplex<D>> divide<D>(std::span<const Point<D>>, std::span<const Corners<D>>);      \
  template NodalMetric<D> nodal_grid<D>(std::array<int, D>, const Point<D>&, const Point<D>&);             \
  template NodalMetric<D> sample_at_vertices<D>(const MetricField<D>&, const Mesh<D>&);                    \
  template Status check_tensors<D>(std::span<const SymTensor<D>>, std::size_t);                            \
  template Expected<MetricField<D>> look_up<D>(NodalMetric<D>);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
