#include "pillowmesh/io/solution_file.h"

#include "pillowmesh/io/file_mesh.h"

namespace pillowmesh {
namespace {

template <int Dim>
Solution<Dim> solution_of(FileMesh& file, const Elements<Cell<Dim>::corners>& cells) {
  Solution<Dim> out;
  for (const Point<3>& p : file.points) {
    Point<Dim> q;
    for (int d = 0; d < Dim; ++d) q[d] = p[d];
    out.points.push_back(q);
  }
  for (const auto& v : cells.vertices) out.cells.push_back(file_order(v));
  for (FieldArray& f : file.fields) {
    const auto n = static_cast<std::size_t>(f.components);
    if (!f.of_cells) {
      if (f.values.size() == n * out.points.size()) out.fields.push_back(std::move(f));
      continue;
    }
    FieldArray of_cells{f.name, true, f.whole, f.components, {}};
    for (const Index place : cells.place)
      for (std::size_t k = 0; k < n && (static_cast<std::size_t>(place) + 1) * n <= f.values.size(); ++k)
        of_cells.values.push_back(f.values[static_cast<std::size_t>(place) * n + k]);
    if (of_cells.values.size() == n * out.cells.size()) out.fields.push_back(std::move(of_cells));
  }
  return out;
}

}  // namespace

Expected<AnySolution> read_solution(std::string_view name, std::span<const char> bytes) {
  auto file = read_file_mesh(name, bytes, true);
  if (!file) return file.status();
  if (!file->hexes.vertices.empty()) return AnySolution(solution_of<3>(*file, file->hexes));
  return AnySolution(solution_of<2>(*file, file->quads));
}

}  // namespace pillowmesh
