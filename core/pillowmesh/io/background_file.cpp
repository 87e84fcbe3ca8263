#include "pillowmesh/io/background_file.h"

#include <cmath>
#include <string>

#include "pillowmesh/io/file_mesh.h"

namespace pillowmesh {
namespace {

template <int Dim, std::size_t N>
Status add_cells(const std::vector<std::array<Index, N>>& cells, const char* kind, std::string_view name,
                 NodalMetric<Dim>& out) {
  const auto count = static_cast<Index>(out.points.size());
  std::vector<Corners<Dim>> multilinear;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const Index v : cells[i])
      if (v < 0 || v >= count)
        return Status::bad_input(std::string(name) + ": " + kind + " " + std::to_string(i) +
                                 " (counted from 0) names a vertex that is not among the " + std::to_string(count) +
                                 " of the file");
    if constexpr (N == Dim + 1) {
      out.simplices.push_back(cells[i]);
    } else {
      Corners<Dim> c;
      for (std::size_t k = 0; k < N; ++k) c[kFileOrder[k]] = cells[i][k];
      multilinear.push_back(c);
    }
  }
  const auto divided = divide<Dim>(out.points, multilinear);
  out.simplices.insert(out.simplices.end(), divided.begin(), divided.end());
  return {};
}

template <int Dim>
Expected<AnyNodal> background_of(const FileMesh& file, std::string_view name) {
  NodalMetric<Dim> out;
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    Point<Dim> p;
    for (int d = 0; d < Dim; ++d) p[d] = file.points[i][d];
    for (int d = 0; d < Dim; ++d)
      if (!(std::fabs(p[d]) <= 1e100))
        return Status::bad_input(std::string(name) + ": vertex " + std::to_string(i + 1) +
                                 " has a coordinate that is not a number of at most 1e100");
    out.points.push_back(p);
  }
  Status status;
  if constexpr (Dim == 2) {
    status = add_cells<2>(file.triangles, "triangle", name, out);
    if (status.ok()) status = add_cells<2>(file.quads.vertices, "quad", name, out);
  } else {
    status = add_cells<3>(file.tetrahedra, "tetrahedron", name, out);
    if (status.ok()) status = add_cells<3>(file.hexes.vertices, "hexahedron", name, out);
  }
  if (!status.ok()) return status;
  if (out.simplices.empty())
    return Status::bad_input(std::string(name) +
                             ": no triangles (Medit), quads, tetrahedra (Medit) or hexahedra: it is no background");
  return AnyNodal(std::move(out));
}

}  // namespace

Expected<AnyNodal> read_background(std::string_view name, std::span<const char> bytes) {
  auto file = read_file_mesh(name, bytes);
  if (!file) return file.status();
  const bool solid = !file->tetrahedra.empty() || !file->hexes.vertices.empty();
  return solid ? background_of<3>(*file, name) : background_of<2>(*file, name);
}

}  // namespace pillowmesh
