#include "pillowmesh/io/io.h"

#include <utility>
#include <variant>

#include "pillowmesh/io/file_mesh.h"
#include "pillowmesh/io/gmsh.h"
#include "pillowmesh/io/medit.h"
#include "pillowmesh/io/vtk.h"

namespace pillowmesh {
namespace {

enum class Format { unknown, medit, medit_binary, gmsh, vtk, vtu };

constexpr const char* kKnown = ".mesh, .meshb (Medit), .msh (Gmsh), .vtk, .vtu";

/// The ending with its dot, in lower case; empty if there is none.
std::string ending(std::string_view name) {
  const std::size_t slash = name.find_last_of("/\\");
  if (slash != std::string_view::npos) name.remove_prefix(slash + 1);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return {};
  std::string out(name.substr(dot));
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  return out;
}

Format format_of(std::string_view name) {
  const std::string e = ending(name);
  if (e == ".mesh") return Format::medit;
  if (e == ".meshb") return Format::medit_binary;
  if (e == ".msh") return Format::gmsh;
  if (e == ".vtk") return Format::vtk;
  if (e == ".vtu") return Format::vtu;
  return Format::unknown;
}

std::string unknown_ending(std::string_view name) {
  const std::string e = ending(name);
  return std::string(name) + ": " + (e.empty() ? "the name has no ending" : "the ending '" + e + "' is not known") +
         "; known are " + kKnown;
}

}  // namespace

Expected<FileMesh> read_file_mesh(std::string_view name, std::span<const char> bytes, bool fields) {
  const Format format = format_of(name);
  if (format == Format::unknown) return Status::bad_input(unknown_ending(name));
  if (bytes.empty()) return Status::bad_input(std::string(name) + ": the file is empty");
  Source source(name, bytes, format == Format::medit ? '#' : '\0');
  FileMesh mesh;
  switch (format) {
    case Format::medit:
      mesh = read_medit_ascii(source);
      break;
    case Format::medit_binary:
      mesh = read_medit_binary(source);
      break;
    case Format::gmsh:
      mesh = read_gmsh(source);
      break;
    case Format::vtk:
      mesh = read_vtk(source, fields);
      break;
    case Format::vtu:
      mesh = read_vtu(source, fields);
      break;
    case Format::unknown:
      break;
  }
  if (source.failed()) return source.status();
  return mesh;
}

Expected<AnyInput> read_input(std::string_view name, std::span<const char> bytes) {
  auto mesh = read_file_mesh(name, bytes);
  if (!mesh) return mesh.status();
  return finish(std::move(*mesh), name);
}

Expected<AnyMesh> read_mesh(std::string_view name, std::span<const char> bytes, const BoundaryOptions& options) {
  auto input = read_input(name, bytes);
  if (!input) return input.status();
  return std::visit([&](auto& i) { return make_any_mesh(std::move(i), name, options); }, *input);
}

Status check_writable(std::string_view name, const WriteOptions& options) {
  const Format format = format_of(name);
  if (format == Format::unknown) return Status::usage(unknown_ending(name));
  if (format == Format::medit && options.binary)
    return Status::usage(std::string(name) + ": binary Medit files end in .meshb");
  if (options.gmsh_version != 22 && options.gmsh_version != 41)
    return Status::usage("the Gmsh version should be 22 (2.2) or 41 (4.1)");
  return {};
}

namespace {

/// \pre check_writable
template <int Dim>
void write_to(Sink& sink, MeshInput<Dim> input, std::string_view name, const WriteOptions& options) {
  sort_groups(input);
  switch (format_of(name)) {
    case Format::medit:
      write_medit(input, sink, false);
      break;
    case Format::medit_binary:
      write_medit(input, sink, true);
      break;
    case Format::gmsh:
      write_gmsh(input, sink, options.gmsh_version, options.binary);
      break;
    case Format::vtk:
      write_vtk(input, sink, options.binary);
      break;
    case Format::vtu:
      write_vtu(input, sink, options.binary);
      break;
    case Format::unknown:
      break;
  }
}

}  // namespace

template <int Dim>
Status write_mesh_to(Sink& sink, const Mesh<Dim>& mesh, std::string_view name, const WriteOptions& options,
                     std::vector<FieldArray> fields) {
  if (Status s = check_writable(name, options); !s.ok()) return s;
  auto input = to_input(mesh);
  input.fields = std::move(fields);
  continue_fields(input);
  write_to(sink, std::move(input), name, options);
  return {};
}

template <int Dim>
Expected<std::string> write_input(MeshInput<Dim> input, std::string_view name, const WriteOptions& options) {
  if (Status s = check_writable(name, options); !s.ok()) return s;
  Sink sink;
  write_to(sink, std::move(input), name, options);
  return sink.take();
}

template <int Dim>
Expected<std::string> write_mesh(const Mesh<Dim>& mesh, std::string_view name, const WriteOptions& options) {
  Sink sink;
  if (Status s = write_mesh_to(sink, mesh, name, options); !s.ok()) return s;
  return sink.take();
}

Expected<std::string> write_mesh(const AnyMesh& mesh, std::string_view name, const WriteOptions& options) {
  return std::visit([&](const auto& m) { return write_mesh(m, name, options); }, mesh);
}

template Expected<std::string> write_input(MeshInput<2>, std::string_view, const WriteOptions&);
template Expected<std::string> write_input(MeshInput<3>, std::string_view, const WriteOptions&);
template Status write_mesh_to(Sink&, const Mesh<2>&, std::string_view, const WriteOptions&, std::vector<FieldArray>);
template Status write_mesh_to(Sink&, const Mesh<3>&, std::string_view, const WriteOptions&, std::vector<FieldArray>);
template Expected<std::string> write_mesh(const Mesh<2>&, std::string_view, const WriteOptions&);
template Expected<std::string> write_mesh(const Mesh<3>&, std::string_view, const WriteOptions&);

}  // namespace pillowmesh
