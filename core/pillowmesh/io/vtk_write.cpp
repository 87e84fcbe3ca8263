#include <algorithm>
#include <bit>
#include <string>

#include "pillowmesh/io/vtk.h"

namespace pillowmesh {
namespace {

/// Legacy binary files are big-endian.
template <class T>
void big_endian(Sink& sink, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i)
    sink << bytes[std::endian::native == std::endian::little ? sizeof(T) - 1 - i : i];
}

}  // namespace

template <int Dim>
void write_vtk(const MeshInput<Dim>& mesh, Sink& sink, bool binary) {
  const auto value = [&](auto v, char separator) {
    if (binary) {
      big_endian(sink, v);
    } else {
      sink << v << separator;
    }
  };
  const auto end_values = [&] {
    if (binary) sink << '\n';
  };
  sink << "# vtk DataFile Version 3.0\npillowmesh\n" << (binary ? "BINARY\n" : "ASCII\n");
  sink << "DATASET UNSTRUCTURED_GRID\nPOINTS " << mesh.points.size() << " double\n";
  for (const Point<Dim>& p : mesh.points) {
    value(p[0], ' ');
    value(p[1], ' ');
    value(Dim == 3 ? p[Dim - 1] : 0.0, '\n');
  }
  end_values();

  constexpr std::size_t corners = Cell<Dim>::corners, facet_corners = Cell<Dim>::facet_corners;
  const std::size_t total = mesh.cells.size() + mesh.facets.size();
  sink << "CELLS " << total << ' ' << mesh.cells.size() * (corners + 1) + mesh.facets.size() * (facet_corners + 1)
       << '\n';
  const auto element = [&](const auto& vertices) {
    const auto n = static_cast<Index>(vertices.size());
    value(n, ' ');
    for (Index k = 0; k < n; ++k) value(vertices[static_cast<std::size_t>(k)], k + 1 == n ? '\n' : ' ');
  };
  for (const auto& cell : mesh.cells) element(file_order(cell));
  for (const auto& facet : mesh.facets) element(file_order(facet.vertices));
  end_values();

  sink << "CELL_TYPES " << total << '\n';
  for (std::size_t i = 0; i < total; ++i)
    value(static_cast<Index>(i < mesh.cells.size() ? kVtkCell<Dim> : kVtkFacet<Dim>), '\n');
  end_values();
  const auto write_fields = [&](bool of_cells, std::size_t count) {
    for (const FieldArray& f : mesh.fields) {
      if (f.of_cells != of_cells) continue;
      std::string name = f.name;  // a name is one word here
      for (char& c : name)
        if (c == ' ' || c == '\t' || c == '\n') c = '_';
      const std::size_t n = count * static_cast<std::size_t>(f.components);
      sink << name << ' ' << f.components << ' ' << count << (f.whole ? " long\n" : " double\n");
      for (std::size_t i = 0; i < n; ++i) {
        const double v = i < f.values.size() ? f.values[i] : 0.0;
        if (f.whole)
          value(static_cast<std::int64_t>(v), '\n');
        else
          value(v, '\n');
      }
      end_values();
    }
  };
  const auto of_cells = static_cast<std::size_t>(
      std::count_if(mesh.fields.begin(), mesh.fields.end(), [](const FieldArray& f) { return f.of_cells; }));
  sink << "CELL_DATA " << total << "\nFIELD FieldData " << of_cells + 1 << "\ngroup 1 " << total << " int\n";
  for (Index group : group_array(mesh)) value(group, '\n');
  end_values();
  write_fields(true, total);
  if (of_cells == mesh.fields.size()) return;
  sink << "POINT_DATA " << mesh.points.size() << "\nFIELD FieldData " << mesh.fields.size() - of_cells << '\n';
  write_fields(false, mesh.points.size());
}

template void write_vtk<2>(const MeshInput<2>&, Sink&, bool);
template void write_vtk<3>(const MeshInput<3>&, Sink&, bool);

}  // namespace pillowmesh
