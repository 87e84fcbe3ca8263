// Meshes with groups, the variants in which they can be written, and comparison: for the tests of io/.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "pillowmesh/io/io.h"
#include "pillowmesh/mesh/boundary.h"

namespace io_test {

using namespace pillowmesh;

/// A file name, and options that choose one of the format's variants.
struct Variant {
  std::string name;
  WriteOptions options;
};

inline std::vector<Variant> all_variants() {
  return {{"a.mesh", {}},         {"a.meshb", {}},       {"a.msh", {false, 41}}, {"b.msh", {true, 41}},
          {"c.msh", {false, 22}}, {"d.msh", {true, 22}}, {"a.vtk", {false, 41}}, {"b.vtk", {true, 41}},
          {"a.vtu", {false, 41}}, {"b.vtu", {true, 41}}};
}

inline std::string describe(const Variant& v) {
  return v.name + (v.options.binary ? " binary" : " text") + " " + std::to_string(v.options.gmsh_version);
}

/// A grid with uneven coordinates, two regions, and named groups on its sides.
template <int Dim>
MeshInput<Dim> grouped_grid() {
  Point<Dim> low = Point<Dim>::Constant(-1.0 / 3.0), high = Point<Dim>::Constant(0.7);
  high[0] = 1e-7;
  std::array<int, Dim> n{};
  n.fill(2);
  n[0] = 3;
  MeshInput<Dim> input = to_input(make_grid<Dim>(n, low, high));
  input.region_groups = {{7, "left"}, {4, "right part"}};
  for (std::size_t c = 0; c < input.cells.size(); ++c) input.cell_region[c] = c % 3 == 0 ? 0 : 1;
  return input;
}

template <int Dim>
Mesh<Dim> grouped_mesh() {
  auto mesh = make_mesh<Dim>(grouped_grid<Dim>());
  return *mesh;
}

/// Facets as (vertices, tag), sorted.
template <int Dim>
std::vector<std::pair<std::vector<Index>, Index>> facet_tags(const MeshInput<Dim>& input) {
  std::vector<std::pair<std::vector<Index>, Index>> facets;
  for (const auto& f : input.facets) {
    std::vector<Index> v(f.vertices.begin(), f.vertices.end());
    std::sort(v.begin(), v.end());
    facets.emplace_back(v, input.facet_groups[f.group].tag);
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

template <int Dim>
std::vector<Corners<Dim>> sorted_cells(const MeshInput<Dim>& input) {
  std::vector<Corners<Dim>> cells = input.cells;
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// Cells with the tag of their region, sorted.
template <int Dim>
std::vector<std::pair<Corners<Dim>, Index>> tagged_cells(const MeshInput<Dim>& input) {
  std::vector<std::pair<Corners<Dim>, Index>> cells;
  for (std::size_t c = 0; c < input.cells.size(); ++c)
    cells.emplace_back(input.cells[c], input.region_groups[input.cell_region[c]].tag);
  std::sort(cells.begin(), cells.end());
  return cells;
}

template <int Dim>
std::vector<Index> cell_tags(const MeshInput<Dim>& input) {
  std::vector<Index> tags;
  for (Index r : input.cell_region) tags.push_back(input.region_groups[r].tag);
  return tags;
}

inline std::string read_data(const std::string& name) {
  std::ifstream file(std::filesystem::path(PILLOWMESH_TEST_DATA) / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The message with which a file is refused; "accepted" when it is not.
inline std::string refusal(const std::string& name, const std::string& bytes) {
  const auto mesh = read_mesh(name, bytes);
  if (mesh.ok()) return "accepted";
  return mesh.status().code == StatusCode::bad_input ? mesh.status().message
                                                     : "not bad_input: " + mesh.status().message;
}

/// Empty when `message` holds all of `parts`; else what it lacks, for a test's output.
inline std::string lacks(const std::string& message, std::initializer_list<std::string> parts) {
  for (const std::string& part : parts)
    if (message.find(part) == std::string::npos) return "\"" + part + "\" is missing in: " + message;
  return {};
}

/// `text` with its first `from` replaced; the text itself must hold `from`.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "TEST BUG: '" + from + "' not found";
  return text.replace(at, from.size(), to);
}

}  // namespace io_test
