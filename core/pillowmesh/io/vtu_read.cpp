#include <bit>
#include <limits>
#include <string>
#include <type_traits>

#include "pillowmesh/io/codec.h"
#include "pillowmesh/mesh/number.h"
#include "pillowmesh/io/vtk.h"
#include "pillowmesh/io/xml.h"

namespace pillowmesh {
namespace {

/// One <DataArray>: where it is and how it is encoded.
struct DataArray {
  XmlTag tag;
  std::string_view content;
};

class VtuReader {
 public:
  VtuReader(Source& source, bool fields)
      : in_(source), text_(source.view(0, source.remaining())), wants_fields_(fields) {}

  FileMesh read() {
    if (!find_arrays()) return {};
    VtkGrid grid;
    read_points(grid);
    if (!in_.failed()) read_array(connectivity_, "connectivity", grid.connectivity);
    if (!in_.failed()) read_array(offsets_, "offsets", grid.ends);
    if (!in_.failed()) read_array(types_, "types", grid.types);
    if (!in_.failed() && !groups_.tag.name.empty()) read_array(groups_, "group", grid.groups);
    if (!in_.failed()) {
      expect(grid.ends.size(), cell_count_, "offsets", "NumberOfCells");
      expect(grid.types.size(), cell_count_, "types", "NumberOfCells");
      if (grid.groups.size() != grid.ends.size()) grid.groups.clear();
    }
    read_fields(grid);
    FileMesh mesh = to_file_mesh(std::move(grid), in_);
    mesh.names = std::move(names_);
    return mesh;
  }

 private:
  void fail(std::size_t position, const std::string& reason) { in_.fail_at(in_.line_of(position), reason); }
  void expect(std::size_t found, std::int64_t promised, const char* array, const char* attribute_name) {
    if (static_cast<std::int64_t>(found) != promised)
      in_.fail_whole(std::string("the array '") + array + "' has " + std::to_string(found) + " entries, but " +
                     attribute_name + " is " + std::to_string(promised));
  }

  /// Finds what matters and checks what the header says.
  bool find_arrays() {
    std::string_view section;
    int pieces = 0, rank = 0;
    bool closed = false;
    XmlTag tag = next_tag(text_, 0);
    if (tag.name != "VTKFile") {
      in_.fail("a .vtu file should begin with <VTKFile>");
      return false;
    }
    if (attribute(tag, "type") != "UnstructuredGrid") {
      fail(tag.begin, "the dataset is " + quoted(attribute(tag, "type")) + "; only UnstructuredGrid is read");
      return false;
    }
    const bool big = attribute(tag, "byte_order") == "BigEndian";
    swapped_ = big == (std::endian::native == std::endian::little);
    header_size_ = attribute(tag, "header_type") == "UInt64" ? 8 : 4;
    const std::string_view compressor = attribute(tag, "compressor");
    compressed_ = !compressor.empty();
    if (compressed_ && compressor != "vtkZLibDataCompressor") {
      fail(tag.begin,
           "data compressed by " + quoted(compressor) + " is not read: save with zlib or without compression");
      return false;
    }
    for (tag = next_tag(text_, tag.end); !tag.name.empty(); tag = next_tag(text_, tag.end)) {
      if (tag.name == "Piece") {
        if (++pieces > 1) {
          fail(tag.begin, "the file has several pieces; only one is read");
          return false;
        }
        if (!parse_integer(attribute(tag, "NumberOfPoints"), point_count_) ||
            !parse_integer(attribute(tag, "NumberOfCells"), cell_count_)) {
          fail(tag.begin, "NumberOfPoints or NumberOfCells is missing or not a number");
          return false;
        }
      } else if (tag.name == "AppendedData") {
        const std::size_t mark = text_.find('_', tag.end);
        if (mark == std::string_view::npos) break;
        raw_ = attribute(tag, "encoding") == "raw";
        appended_ = text_.substr(mark + 1);
        closed = appended_.find("</VTKFile>") != std::string_view::npos;
        break;
      } else if (tag.name == "DataArray") {
        DataArray array{tag, {}};
        if (!tag.closed) {
          const std::size_t end = text_.find('<', tag.end);
          if (end == std::string_view::npos) break;
          array.content = text_.substr(tag.end, end - tag.end);
        }
        const std::string_view name = attribute(tag, "Name");
        if (section == "FieldData") read_name(array);
        if (section == "Points") points_ = array;
        if (section == "Cells" && name == "connectivity") connectivity_ = array;
        if (section == "Cells" && name == "offsets") offsets_ = array;
        if (section == "Cells" && name == "types") types_ = array;
        if (wants_fields_ && !name.empty() &&
            (section == "PointData" || (section == "CellData" && group_array_rank(name) == 0)))
          fields_.push_back({array, section == "CellData"});
        if (section == "CellData" && group_array_rank(name) > rank) {
          rank = group_array_rank(name);
          groups_ = array;
        }
      } else if (tag.name == "/VTKFile") {
        closed = true;
        break;
      } else if (tag.name[0] != '/') {
        section = tag.name;
      }
    }
    if (!closed) {
      in_.fail_whole("the file ends before </VTKFile>; it is truncated");
    } else if (pieces == 0) {
      in_.fail_whole("the mesh is empty: the file has no <Piece>");
    }
    return !in_.failed();
  }

  /// Field data may name groups: an array of that name with the group's number and dimension, as meshio has it.
  void read_name(const DataArray& array) {
    if (attribute(array.tag, "format") != "ascii" || attribute(array.tag, "type").find("Int") == std::string_view::npos)
      return;
    std::vector<Index> values;
    read_ascii(array, values);
    const std::string name = unescaped(attribute(array.tag, "Name"));
    if (values.size() == 2 && !name.empty()) names_.push_back({values[1], values[0], name});
  }

  void read_points(VtkGrid& grid) {
    std::vector<double> values;
    if (point_count_ == 0 && points_.tag.name.empty()) return;
    read_array(points_, "Points", values);
    if (in_.failed()) return;
    if (values.size() % 3 != 0) return in_.fail_whole("the coordinates are not three per point");
    expect(values.size() / 3, point_count_, "Points", "NumberOfPoints");
    if (in_.failed()) return;
    grid.points.reserve(values.size() / 3);
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      grid.points.emplace_back(values[i], values[i + 1], values[i + 2]);
  }

  void read_fields(VtkGrid& grid) {
    for (const auto& [array, of_cells] : fields_) {
      if (in_.failed()) return;
      const std::string_view type = attribute(array.tag, "type"), count = attribute(array.tag, "NumberOfComponents");
      if (type == "String") continue;
      std::int64_t components = 1;
      if (!count.empty() && (!parse_integer(count, components) || components < 1 || components > 1000)) continue;
      FieldArray& field = grid.fields.emplace_back();
      field.name = unescaped(attribute(array.tag, "Name"));
      field.of_cells = of_cells;
      field.whole = !type.starts_with("Float");
      field.components = static_cast<int>(components);
      read_array(array, field.name.c_str(), field.values);
    }
  }

  template <class T>
  void read_array(const DataArray& array, const char* name, std::vector<T>& out) {
    if (array.tag.name.empty()) {
      if (cell_count_ != 0) in_.fail_whole(std::string("the array '") + name + "' is missing");
      return;
    }
    const std::string_view format = attribute(array.tag, "format");
    if (format == "ascii" || format.empty()) return read_ascii(array, out);
    std::string bytes;
    if (!read_bytes(array, format, bytes)) {
      fail(array.tag.begin, std::string("the data of the array '") + name + "' is truncated or malformed");
      return;
    }
    const std::string_view type = attribute(array.tag, "type");
    if (type == "Float64") return convert<double>(bytes, out);
    if (type == "Float32") return convert<float>(bytes, out);
    if (type == "Int64") return convert<std::int64_t>(bytes, out);
    if (type == "UInt64") return convert<std::uint64_t>(bytes, out);
    if (type == "Int32") return convert<std::int32_t>(bytes, out);
    if (type == "UInt32") return convert<std::uint32_t>(bytes, out);
    if (type == "Int16") return convert<std::int16_t>(bytes, out);
    if (type == "UInt16") return convert<std::uint16_t>(bytes, out);
    if (type == "Int8") return convert<std::int8_t>(bytes, out);
    if (type == "UInt8") return convert<std::uint8_t>(bytes, out);
    fail(array.tag.begin, "the data type " + quoted(type) + " is not supported");
  }

  template <class T>
  void read_ascii(const DataArray& array, std::vector<T>& out) {
    Source words(in_.name(), {array.content.data(), array.content.size()});
    for (std::string_view w = words.word(); !w.empty(); w = words.word()) {
      double value = 0.0;
      if (!parse_double(w, value)) {
        fail(static_cast<std::size_t>(w.data() - text_.data()), "expected a number, found " + quoted(w));
        return;
      }
      out.push_back(number<T>(value));
    }
  }

  template <class T>
  static T number(double value) {
    if constexpr (std::is_same_v<T, double>) {
      return value;
    } else {
      // What does not fit becomes a number that no vertex, offset or type has.
      return value >= -2e9 && value <= 2e9 ? static_cast<T>(value) : std::numeric_limits<T>::min();
    }
  }

  template <class Stored, class T>
  void convert(const std::string& bytes, std::vector<T>& out) const {
    out.reserve(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i + sizeof(Stored) <= bytes.size(); i += sizeof(Stored))
      out.push_back(number<T>(static_cast<double>(load<Stored>(bytes, i))));
  }
  template <class Stored>
  [[nodiscard]] Stored load(std::string_view bytes, std::size_t at) const {
    char copy[sizeof(Stored)];
    for (std::size_t i = 0; i < sizeof(Stored); ++i) copy[swapped_ ? sizeof(Stored) - 1 - i : i] = bytes[at + i];
    Stored value;
    std::memcpy(&value, copy, sizeof(Stored));
    return value;
  }
  [[nodiscard]] std::uint64_t header(std::string_view bytes, std::size_t word) const {
    return header_size_ == 8 ? load<std::uint64_t>(bytes, word * 8) : load<std::uint32_t>(bytes, word * 4);
  }

  /// The array's bytes, decoded and expanded.
  bool read_bytes(const DataArray& array, std::string_view format, std::string& bytes) const {
    std::string_view stored = array.content;
    bool raw = false;
    if (format == "appended") {
      std::int64_t offset = 0;
      if (!parse_integer(attribute(array.tag, "offset"), offset) || offset < 0) return false;
      if (static_cast<std::uint64_t>(offset) > appended_.size()) return false;
      stored = appended_.substr(static_cast<std::size_t>(offset));
      raw = raw_;
    } else if (format != "binary") {
      return false;
    }
    // The first `n` bytes that are stored, as a view of the file or of `decoded`.
    std::string decoded;
    const auto first = [&](std::uint64_t n, std::string_view& out) {
      if (n > stored.size()) return false;
      const auto size = static_cast<std::size_t>(n);
      if (raw) {
        out = stored.substr(0, size);
        return true;
      }
      decoded.clear();
      if (!decode_base64(stored, size, decoded) || decoded.size() < size) return false;
      out = decoded;
      return true;
    };
    std::string_view data;
    const auto word = static_cast<std::uint64_t>(header_size_);
    if (!first(word, data)) return false;
    if (!compressed_) {
      const std::uint64_t size = header(data, 0);
      if (size > stored.size() || !first(word + size, data)) return false;
      bytes.assign(data.substr(static_cast<std::size_t>(word)));
      return true;
    }
    // [blocks] [size of a block] [size of the last] [compressed sizes ...] [blocks ...]
    const std::uint64_t blocks = header(data, 0);
    if (blocks > stored.size() / word) return false;
    const std::uint64_t head = (3 + blocks) * word;
    if (!first(head, data)) return false;
    const std::uint64_t block_size = header(data, 1), last_size = header(data, 2);
    std::vector<std::uint64_t> sizes;
    std::uint64_t total = head;
    for (std::uint64_t b = 0; b < blocks; ++b) {
      sizes.push_back(header(data, static_cast<std::size_t>(3 + b)));
      if (sizes.back() > stored.size()) return false;
      total += sizes.back();
    }
    if (!first(total, data)) return false;
    std::size_t at = static_cast<std::size_t>(head);
    for (std::uint64_t b = 0; b < blocks; ++b) {
      const std::uint64_t expanded = b + 1 == blocks && last_size != 0 ? last_size : block_size;
      const std::size_t before = bytes.size();
      if (!inflate_zlib(data.substr(at, static_cast<std::size_t>(sizes[b])), static_cast<std::size_t>(expanded), bytes))
        return false;
      if (bytes.size() - before != expanded) return false;
      at += static_cast<std::size_t>(sizes[b]);
    }
    return true;
  }

  Source& in_;
  std::string_view text_;
  bool wants_fields_;
  DataArray points_, connectivity_, offsets_, types_, groups_;
  struct Field {
    DataArray array;
    bool of_cells;
  };
  std::vector<Field> fields_;
  std::vector<FileMesh::Name> names_;
  std::string_view appended_;
  bool raw_ = false, swapped_ = false, compressed_ = false;
  int header_size_ = 4;
  std::int64_t point_count_ = 0, cell_count_ = 0;
};

}  // namespace

FileMesh read_vtu(Source& source, bool fields) { return VtuReader(source, fields).read(); }

}  // namespace pillowmesh
