#include <algorithm>
#include <bit>
#include <string>

#include "pillowmesh/io/codec.h"
#include "pillowmesh/io/vtk.h"

namespace pillowmesh {
namespace {

/// The values of one <DataArray> in either format.
class ArrayWriter {
 public:
  ArrayWriter(Sink& sink, bool binary) : sink_(sink), binary_(binary) {}

  template <class T>
  void begin(const char* type, const char* name, int components, std::size_t count) {
    sink_ << "        <DataArray type=\"" << type << "\" Name=\"" << name << "\"";
    if (components > 1) sink_ << " NumberOfComponents=\"" << components << "\"";
    sink_ << (binary_ ? " format=\"binary\">\n" : " format=\"ascii\">\n");
    if (binary_) encode(static_cast<std::uint64_t>(count * sizeof(T)));
  }
  template <class T>
  void value(T v, char separator) {
    if (binary_) {
      encode(v);
    } else if constexpr (sizeof(T) == 1) {
      sink_ << static_cast<int>(v) << separator;
    } else {
      sink_ << v << separator;
    }
  }
  void end() {
    if (binary_) {
      encoder_.finish(sink_);
      sink_ << '\n';
    }
    sink_ << "        </DataArray>\n";
  }

 private:
  template <class T>
  void encode(T v) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &v, sizeof(T));
    encoder_.add(sink_, bytes, sizeof(T));
  }
  Sink& sink_;
  bool binary_;
  Base64Encoder encoder_;
};

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// Names of groups as field data, in meshio's way: an array of that name with the group's number and dimension.
template <int Dim>
void write_names(const MeshInput<Dim>& mesh, Sink& sink) {
  std::vector<std::string> names;
  std::string arrays;
  const auto add = [&](int dim, const std::vector<Group>& groups) {
    const std::vector<Index> tags = distinct_tags(groups);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (groups[i].name.empty() || std::find(names.begin(), names.end(), groups[i].name) != names.end()) continue;
      names.push_back(groups[i].name);
      arrays += "      <DataArray type=\"Int32\" Name=\"" + escaped(groups[i].name) +
                "\" NumberOfComponents=\"2\" NumberOfTuples=\"1\" format=\"ascii\">" + std::to_string(tags[i]) + " " +
                std::to_string(dim) + "</DataArray>\n";
    }
  };
  add(Dim - 1, mesh.facet_groups);
  add(Dim, mesh.region_groups);
  if (!names.empty()) sink << "    <FieldData>\n" << arrays << "    </FieldData>\n";
}

}  // namespace

template <int Dim>
void write_vtu(const MeshInput<Dim>& mesh, Sink& sink, bool binary) {
  constexpr std::size_t corners = Cell<Dim>::corners, facet_corners = Cell<Dim>::facet_corners;
  const std::size_t n_cells = mesh.cells.size(), n_facets = mesh.facets.size(), total = n_cells + n_facets;
  ArrayWriter out(sink, binary);
  sink << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""
       << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
       << "\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n";
  write_names(mesh, sink);
  sink << "    <Piece NumberOfPoints=\"" << mesh.points.size() << "\" NumberOfCells=\"" << total
       << "\">\n      <Points>\n";
  out.begin<double>("Float64", "Points", 3, 3 * mesh.points.size());
  for (const Point<Dim>& p : mesh.points) {
    out.value(p[0], ' ');
    out.value(p[1], ' ');
    out.value(Dim == 3 ? p[Dim - 1] : 0.0, '\n');
  }
  out.end();
  sink << "      </Points>\n      <Cells>\n";

  out.begin<Index>("Int32", "connectivity", 1, n_cells * corners + n_facets * facet_corners);
  const auto element = [&](const auto& vertices) {
    for (std::size_t k = 0; k < vertices.size(); ++k) out.value(vertices[k], k + 1 == vertices.size() ? '\n' : ' ');
  };
  for (const auto& cell : mesh.cells) element(file_order(cell));
  for (const auto& facet : mesh.facets) element(file_order(facet.vertices));
  out.end();

  out.begin<std::int64_t>("Int64", "offsets", 1, total);
  std::int64_t end = 0;
  for (std::size_t i = 0; i < total; ++i) {
    end += static_cast<std::int64_t>(i < n_cells ? corners : facet_corners);
    out.value(end, '\n');
  }
  out.end();

  out.begin<std::uint8_t>("UInt8", "types", 1, total);
  for (std::size_t i = 0; i < total; ++i)
    out.value(static_cast<std::uint8_t>(i < n_cells ? kVtkCell<Dim> : kVtkFacet<Dim>), '\n');
  out.end();

  sink << "      </Cells>\n      <CellData Scalars=\"group\">\n";
  out.begin<Index>("Int32", "group", 1, total);
  for (Index group : group_array(mesh)) out.value(group, '\n');
  out.end();
  const auto write_fields = [&](bool of_cells, std::size_t count) {
    for (const FieldArray& f : mesh.fields) {
      if (f.of_cells != of_cells) continue;
      const std::size_t n = count * static_cast<std::size_t>(f.components);
      const std::string name = escaped(f.name);
      f.whole ? out.begin<std::int64_t>("Int64", name.c_str(), f.components, n)
              : out.begin<double>("Float64", name.c_str(), f.components, n);
      for (std::size_t i = 0; i < n; ++i) {
        const double v = i < f.values.size() ? f.values[i] : 0.0;
        f.whole ? out.value(static_cast<std::int64_t>(v), '\n') : out.value(v, '\n');
      }
      out.end();
    }
  };
  write_fields(true, total);
  sink << "      </CellData>\n";
  if (std::any_of(mesh.fields.begin(), mesh.fields.end(), [](const FieldArray& f) { return !f.of_cells; })) {
    sink << "      <PointData>\n";
    write_fields(false, mesh.points.size());
    sink << "      </PointData>\n";
  }
  sink << "    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
}

template void write_vtu<2>(const MeshInput<2>&, Sink&, bool);
template void write_vtu<3>(const MeshInput<3>&, Sink&, bool);

}  // namespace pillowmesh
