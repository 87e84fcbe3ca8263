#include "input_bytes.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace pillowmesh {
namespace {

constexpr char kMark[] = {'p', 'i', 'l', 'l', 'o', 'w'};

struct Writer {
  std::string bytes;

  template <class T>
  void operator()(const std::vector<T>& values) {
    const auto count = static_cast<std::uint32_t>(values.size());
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void operator()(const std::vector<Group>& groups) {
    std::vector<std::array<Index, 2>> heads;  // tag, length of the name
    std::vector<char> names;
    for (const Group& group : groups) {
      heads.push_back({group.tag, static_cast<Index>(group.name.size())});
      names.insert(names.end(), group.name.begin(), group.name.end());
    }
    (*this)(heads);
    (*this)(names);
  }
};

struct Reader {
  std::span<const char> bytes;
  bool whole = true;

  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint32_t count = 0;
    whole = whole && bytes.size() >= sizeof count;
    if (!whole) return;
    std::memcpy(&count, bytes.data(), sizeof count);
    bytes = bytes.subspan(sizeof count);
    whole = count <= bytes.size() / sizeof(T);
    if (!whole || count == 0) return;
    values.resize(count);
    std::memcpy(static_cast<void*>(values.data()), bytes.data(), count * sizeof(T));
    bytes = bytes.subspan(count * sizeof(T));
  }
  void operator()(std::vector<Group>& groups) {
    std::vector<std::array<Index, 2>> heads;
    std::vector<char> names;
    (*this)(heads);
    (*this)(names);
    std::string_view rest(names.data(), names.size());
    for (const auto& [tag, length] : heads) {
      const std::string_view name = rest.substr(0, static_cast<std::size_t>(length));
      groups.push_back({tag, std::string(name)});
      rest.remove_prefix(name.size());
    }
  }
};

/// The one list of what crosses, for both directions.
template <class Input, class Visitor>
void each_array(Input& input, Visitor& visit) {
  visit(input.points);
  visit(input.cells);
  visit(input.cell_region);
  visit(input.region_groups);
  visit(input.facets);
  visit(input.facet_groups);
  visit(input.corners);
  visit(input.ridges);
  visit(input.required_vertices);
  visit(input.required_edges);
  visit(input.required_facets);
  visit(input.required_cells);
  visit(input.marks);
  visit(input.mark_groups);
  visit(input.cell_lines);
}

}  // namespace

template <int Dim>
std::string to_bytes(const MeshInput<Dim>& input) {
  Writer writer{std::string(kMark, sizeof kMark) + static_cast<char>('0' + Dim)};
  each_array(input, writer);
  return std::move(writer.bytes);
}

int dimension_of(std::span<const char> bytes) {
  if (bytes.size() <= sizeof kMark || std::memcmp(bytes.data(), kMark, sizeof kMark) != 0) return 0;
  return bytes[sizeof kMark] - '0';
}

template <int Dim>
Expected<MeshInput<Dim>> from_bytes(std::span<const char> bytes) {
  MeshInput<Dim> input;
  Reader reader{bytes.subspan(sizeof kMark + 1)};
  each_array(input, reader);
  if (!reader.whole) return Status::bad_input("the bytes of the mesh end too early");
  return input;
}

template std::string to_bytes(const MeshInput<2>&);
template std::string to_bytes(const MeshInput<3>&);
template Expected<MeshInput<2>> from_bytes(std::span<const char>);
template Expected<MeshInput<3>> from_bytes(std::span<const char>);

}  // namespace pillowmesh
