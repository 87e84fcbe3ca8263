#include "pillowmesh/mesh/primitives.h"

#include <cstdlib>
#include <string>
#include <vector>

#include "pillowmesh/mesh/boundary.h"

namespace pillowmesh {
namespace {

constexpr const char* kSideNames[] = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
constexpr double kMostCells = 1e8;

/// Splits at commas; each part must be a number as a whole.
Expected<std::vector<double>> parse_numbers(const std::string& text) {
  std::vector<double> numbers;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, end - at);
    char* stop = nullptr;
    const double value = std::strtod(part.c_str(), &stop);
    if (part.empty() || *stop != '\0' || !(value - value == 0.0))
      return Status::usage("'" + part + "' is not a number in the grid specification");
    numbers.push_back(value);
    at = end + 1;
  }
  return numbers;
}

template <int Dim>
Expected<AnyMesh> grid_from(const std::vector<double>& counts, const std::vector<double>& bounds) {
  std::array<int, Dim> n{};
  Point<Dim> low, high;
  double cells = 1.0;
  for (int d = 0; d < Dim; ++d) {
    if (counts[d] < 1 || counts[d] > kMostCells || counts[d] != static_cast<double>(static_cast<long>(counts[d])))
      return Status::usage("grid counts must be whole numbers of at least 1");
    n[d] = static_cast<int>(counts[d]);
    cells *= counts[d];
    low[d] = bounds[2 * d];
    high[d] = bounds[2 * d + 1];
    if (!(low[d] < high[d])) return Status::usage("grid bounds must come in pairs low,high with low < high");
  }
  if (cells > kMostCells) return Status::usage("a grid may have at most 100 million cells");
  return AnyMesh(make_grid<Dim>(n, low, high));
}

}  // namespace

template <int Dim>
Mesh<Dim> make_grid(std::array<int, Dim> n, const Point<Dim>& low, const Point<Dim>& high) {
  using C = Cell<Dim>;
  MeshInput<Dim> input;
  std::array<Index, Dim> vertex_stride{}, cell_stride{};
  Index vertices = 1, cells = 1;
  for (int d = 0; d < Dim; ++d) {
    vertex_stride[d] = vertices;
    cell_stride[d] = cells;
    vertices *= n[d] + 1;
    cells *= n[d];
  }
  input.points.resize(vertices);
  for (Index v = 0; v < vertices; ++v)
    for (int d = 0; d < Dim; ++d) {
      const Index i = v / vertex_stride[d] % (n[d] + 1);
      input.points[v][d] = i == n[d] ? high[d] : low[d] + (high[d] - low[d]) * i / n[d];
    }
  input.cells.resize(cells);
  for (int s = 0; s < C::facets; ++s) input.facet_groups.push_back({s + 1, kSideNames[s]});
  for (CellId c = 0; c < cells; ++c) {
    Index base = 0;
    for (int d = 0; d < Dim; ++d) base += c / cell_stride[d] % n[d] * vertex_stride[d];
    for (int k = 0; k < C::corners; ++k) {
      input.cells[c][k] = base;
      for (int d = 0; d < Dim; ++d)
        if ((k >> d) & 1) input.cells[c][k] += vertex_stride[d];
    }
    for (int f = 0; f < C::facets; ++f) {
      const int axis = C::facet_axis(f);
      if (c / cell_stride[axis] % n[axis] != (C::facet_side(f) ? n[axis] - 1 : 0)) continue;
      FacetCorners<Dim> v;
      for (int k = 0; k < C::facet_corners; ++k) v[k] = input.cells[c][C::facet_corner(f, k)];
      input.facets.push_back({v, f});
    }
  }
  return *make_mesh(std::move(input));  // a box is always valid
}

Expected<AnyMesh> parse_grid(std::string_view spec) {
  const std::string text(spec);
  const std::string form = "grid:NX,NY[,NZ]:X0,X1,Y0,Y1[,Z0,Z1]";
  if (text.rfind("grid:", 0) != 0) return Status::usage("a grid is written " + form + ", not '" + text + "'");
  const std::size_t colon = text.find(':', 5);
  if (colon == std::string::npos) return Status::usage("'" + text + "' lacks its bounds: a grid is written " + form);
  const auto counts = parse_numbers(text.substr(5, colon - 5));
  if (!counts) return counts.status();
  const auto bounds = parse_numbers(text.substr(colon + 1));
  if (!bounds) return bounds.status();
  const std::size_t dim = counts->size();
  if ((dim != 2 && dim != 3) || bounds->size() != 2 * dim)
    return Status::usage("'" + text + "' has " + std::to_string(dim) + " counts and " + std::to_string(bounds->size()) +
                         " bounds: a grid is written " + form);
  return dim == 2 ? grid_from<2>(*counts, *bounds) : grid_from<3>(*counts, *bounds);
}

template Mesh<2> make_grid<2>(std::array<int, 2>, const Point<2>&, const Point<2>&);
template Mesh<3> make_grid<3>(std::array<int, 3>, const Point<3>&, const Point<3>&);

}  // namespace pillowmesh
