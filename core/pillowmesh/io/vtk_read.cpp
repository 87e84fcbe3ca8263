#include <bit>
#include <string>

#include "pillowmesh/mesh/number.h"
#include "pillowmesh/io/vtk.h"

namespace pillowmesh {
namespace {

enum class Type { none, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

Type type_of(std::string_view name) {
  struct Entry {
    std::string_view name;
    Type type;
  };
  constexpr Entry entries[] = {
      {"double", Type::f64},         {"float", Type::f32},         {"int", Type::i32},
      {"vtkIdType", Type::i32},      {"long", Type::i64},          {"vtktypeint64", Type::i64},
      {"unsigned_long", Type::u64},  {"vtktypeuint64", Type::u64}, {"unsigned_int", Type::u32},
      {"vtktypeint32", Type::i32},   {"vtktypeuint32", Type::u32}, {"short", Type::i16},
      {"unsigned_short", Type::u16}, {"char", Type::i8},           {"signed_char", Type::i8},
      {"unsigned_char", Type::u8},
  };
  std::string lower;
  for (char c : name) lower += c >= 'A' && c <= 'Z' && name != "vtkIdType" ? static_cast<char>(c + 32) : c;
  for (const Entry& e : entries)
    if (e.name == lower) return e.type;
  return Type::none;
}

int size_of(Type type) {
  switch (type) {
    case Type::i8:
    case Type::u8:
      return 1;
    case Type::i16:
    case Type::u16:
      return 2;
    case Type::i32:
    case Type::u32:
    case Type::f32:
      return 4;
    default:
      return 8;
  }
}

class VtkReader {
 public:
  VtkReader(Source& source, bool fields) : in_(source), fields_(fields) {}

  FileMesh read() {
    const std::string_view header = in_.rest_of_line();
    if (!header.starts_with("# vtk DataFile Version")) {
      in_.fail("a legacy VTK file should begin with '# vtk DataFile Version'");
      return {};
    }
    double version = 0.0;
    std::string_view digits = header.substr(22);
    while (!digits.empty() && digits.front() == ' ') digits.remove_prefix(1);
    while (!digits.empty() && digits.back() == ' ') digits.remove_suffix(1);
    if (!parse_double(digits, version) || version < 1.0 || version >= 6.0)
      in_.fail("VTK file version " + quoted(digits) + " is not supported");
    modern_ = version >= 5.0;
    in_.rest_of_line();  // the title
    const std::string format(in_.word());
    if (format == "BINARY") {
      binary_ = true;
    } else if (format != "ASCII") {
      in_.fail("expected ASCII or BINARY, found " + quoted(format));
    }
    if (in_.word() != "DATASET") in_.fail("expected DATASET");
    const std::string dataset(in_.word());
    if (dataset != "UNSTRUCTURED_GRID")
      in_.fail("the dataset is " + quoted(dataset) + "; only UNSTRUCTURED_GRID is read");
    if (binary_ && !in_.failed()) in_.set_binary(std::endian::native == std::endian::little);
    while (!in_.failed() && read_section()) {
    }
    if (!in_.failed() && !(points_ && cells_ && types_))
      in_.fail_whole(std::string("the file has no ") +
                     (!points_  ? "POINTS"
                      : !cells_ ? "CELLS"
                                : "CELL_TYPES") +
                     "; it is truncated or empty");
    return to_file_mesh(std::move(grid_), in_);
  }

 private:
  std::string word() {
    in_.set_text(true);
    std::string w(in_.word());
    in_.set_text(!binary_);
    return w;
  }
  std::int64_t number(const char* what) {
    in_.set_text(true);
    const std::int64_t n = in_.integer(what);
    in_.set_text(!binary_);
    return n;
  }
  /// A count in a header line, whose values follow on the next line.
  std::int64_t count(const char* things, std::int64_t unit) {
    return in_.checked_count(number("a count"), things, unit);
  }
  void end_line() {
    if (binary_ && !in_.failed()) in_.rest_of_line();
  }

  double value(Type type) {
    const char* what = "a value";
    switch (type) {
      case Type::i8:
        return in_.real<std::int8_t>(what);
      case Type::u8:
        return in_.real<std::uint8_t>(what);
      case Type::i16:
        return in_.real<std::int16_t>(what);
      case Type::u16:
        return in_.real<std::uint16_t>(what);
      case Type::i32:
        return in_.real<std::int32_t>(what);
      case Type::u32:
        return in_.real<std::uint32_t>(what);
      case Type::i64:
        return in_.real<std::int64_t>(what);
      case Type::u64:
        return in_.real<std::uint64_t>(what);
      case Type::f32:
        return in_.real<float>(what);
      default:
        return in_.real<double>(what);
    }
  }
  Type type(const std::string& name) {
    const Type t = type_of(name);
    if (t == Type::none) in_.fail("the data type " + quoted(name) + " is not supported");
    return t;
  }
  Index index(std::int64_t v) {
    if (v >= -0x7fffffff && v <= 0x7fffffff) return static_cast<Index>(v);
    in_.fail("the number " + std::to_string(v) + " does not fit in 32 bits");
    return 0;
  }

  /// \return false at the end of what can be read.
  bool read_section() {
    const std::string keyword = word();
    if (keyword.empty()) return false;
    if (keyword == "POINTS") {
      read_points();
    } else if (keyword == "CELLS") {
      modern_ ? read_offset_cells() : read_cells();
    } else if (keyword == "CELL_TYPES") {
      read_types();
    } else if (keyword == "CELL_DATA" || keyword == "POINT_DATA") {
      of_cells_ = keyword == "CELL_DATA";
      in_data_ = true;
      tuples_ = number("a count");
    } else if (keyword == "METADATA") {
      skip_metadata();
    } else if (keyword == "FIELD") {
      return read_field();
    } else {
      return read_attribute(keyword);
    }
    return true;
  }

  void read_points() {
    if (points_) return in_.fail("POINTS are listed twice");
    const std::int64_t promised = number("the number of points");
    const Type t = type(word());
    const std::int64_t n = in_.checked_count(promised, "points", binary_ ? 3 * size_of(t) : 3);
    end_line();
    grid_.points.reserve(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n && !in_.failed(); ++i) {
      Point<3> p;
      for (int d = 0; d < 3; ++d) p[d] = value(t);
      grid_.points.push_back(p);
    }
    points_ = true;
  }

  void read_cells() {
    if (cells_) return in_.fail("CELLS are listed twice");
    const std::int64_t n = count("cells", binary_ ? 4 : 1);
    const std::int64_t total = count("numbers", binary_ ? 4 : 1);
    end_line();
    if (total < n) in_.fail("the size of CELLS is less than their number");
    if (in_.failed()) return;
    grid_.ends.reserve(static_cast<std::size_t>(n));
    grid_.connectivity.reserve(static_cast<std::size_t>(total - n));
    for (std::int64_t c = 0; c < n && !in_.failed(); ++c) {
      const std::int64_t vertices = in_.integer("a number of vertices");
      if (!in_.failed() && (vertices < 0 || vertices > total))
        in_.fail("a cell with " + std::to_string(vertices) + " vertices is impossible");
      if (!binary_) grid_.lines.push_back(static_cast<Index>(in_.line()));
      for (std::int64_t k = 0; k < vertices && !in_.failed(); ++k)
        grid_.connectivity.push_back(index(in_.integer("a vertex number")));
      grid_.ends.push_back(static_cast<Index>(grid_.connectivity.size()));
    }
    if (!in_.failed() && static_cast<std::int64_t>(grid_.connectivity.size()) + n != total)
      in_.fail("CELLS promises " + std::to_string(total) + " numbers but has " +
               std::to_string(static_cast<std::int64_t>(grid_.connectivity.size()) + n));
    cells_ = true;
  }

  /// Version 5: CELLS offsets connectivity / OFFSETS type ... / CONNECTIVITY type ...
  void read_offset_cells() {
    if (cells_) return in_.fail("CELLS are listed twice");
    const std::int64_t offsets = count("offsets", binary_ ? 4 : 1);
    const std::int64_t total = count("numbers", binary_ ? 4 : 1);
    if (word() != "OFFSETS") return in_.fail("expected OFFSETS");
    const Type offset_type = type(word());
    end_line();
    for (std::int64_t i = 0; i < offsets && !in_.failed(); ++i) {
      const double v = value(offset_type);
      if (i > 0) grid_.ends.push_back(v >= 0 && v <= 2e9 ? static_cast<Index>(v) : kNone);
    }
    if (word() != "CONNECTIVITY") return in_.fail("expected CONNECTIVITY");
    const Type id_type = type(word());
    end_line();
    for (std::int64_t i = 0; i < total && !in_.failed(); ++i) {
      const double v = value(id_type);
      grid_.connectivity.push_back(v >= 0 && v <= 2e9 ? static_cast<Index>(v) : kNone);
    }
    cells_ = true;
  }

  void read_types() {
    if (types_) return in_.fail("CELL_TYPES are listed twice");
    const std::int64_t n = count("cell types", binary_ ? 4 : 1);
    end_line();
    for (std::int64_t i = 0; i < n && !in_.failed(); ++i) grid_.types.push_back(index(in_.integer("a cell type")));
    types_ = true;
  }

  /// Keeps an array of `tuples` values if it tells groups, else skips it. \return false when its type is unknown, after
  /// which nothing more can be read.
  bool read_array(const std::string& name, const std::string& type_name, std::int64_t components, std::int64_t tuples) {
    const Type t = type_of(type_name);
    if (t == Type::none) return false;
    if (!in_.failed() && (components < 1 || components > 1000)) in_.fail("the number of components is not 1 to 1000");
    if (in_.failed()) return true;
    const std::int64_t unit = components * (binary_ ? size_of(t) : 1);
    const std::int64_t n = in_.checked_count(tuples, "tuples of data", unit);
    const int rank = of_cells_ && components == 1 ? group_array_rank(name) : 0;
    const bool wanted = rank > rank_;
    if (wanted) {
      rank_ = rank;
      grid_.groups.clear();
    }
    FieldArray* field = nullptr;
    if (fields_ && in_data_ && rank == 0 && !name.empty())
      field = &grid_.fields.emplace_back(FieldArray{name, of_cells_, t != Type::f32 && t != Type::f64,
                                                    static_cast<int>(components), {}});
    if (binary_ && !wanted && field == nullptr) {
      in_.seek(in_.position() + static_cast<std::size_t>(n * unit));
      return true;
    }
    for (std::int64_t i = 0; i < n * components && !in_.failed(); ++i) {
      const double v = value(t);
      if (wanted) grid_.groups.push_back(group_number(v));
      if (field != nullptr) field->values.push_back(v);
    }
    return true;
  }

  bool read_field() {
    word();  // its name
    const std::int64_t arrays = number("the number of arrays");
    for (std::int64_t i = 0; i < arrays && !in_.failed(); ++i) {
      std::string name = word();
      if (name == "METADATA") {
        skip_metadata();
        name = word();
      }
      const std::int64_t components = number("the number of components");
      const std::int64_t tuples = number("the number of tuples");
      const std::string type_name = word();
      end_line();
      if (!in_.failed() && !read_array(name, type_name, components, tuples)) return false;
    }
    return true;
  }

  bool read_attribute(const std::string& keyword) {
    const auto is = [&](std::string_view k) { return keyword == k; };
    const std::string name = word();
    if (is("SCALARS")) {
      const std::string type_name = word();
      // The rest of the line may hold the number of components; LOOKUP_TABLE stands on the next.
      in_.set_text(true);
      std::string_view rest = in_.rest_of_line();
      in_.set_text(!binary_);
      while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
      while (!rest.empty() && rest.back() == ' ') rest.remove_suffix(1);
      std::int64_t components = 1;
      if (!rest.empty() && !parse_integer(rest, components)) in_.fail("expected a number of components");
      if (word() != "LOOKUP_TABLE") in_.fail("expected LOOKUP_TABLE");
      word();
      end_line();
      return read_array(name, type_name, components, tuples_);
    }
    if (is("LOOKUP_TABLE")) {
      const std::int64_t n = number("a count");
      end_line();
      return read_array("", binary_ ? "unsigned_char" : "float", 4, n);
    }
    if (is("COLOR_SCALARS") || is("TEXTURE_COORDINATES")) {
      const std::int64_t n = number("a count");
      const std::string type_name = is("COLOR_SCALARS") ? (binary_ ? "unsigned_char" : "float") : word();
      end_line();
      return read_array("", type_name, n, tuples_);
    }
    const std::int64_t components = is("VECTORS") || is("NORMALS")           ? 3
                                    : is("TENSORS")                          ? 9
                                    : is("TENSORS6")                         ? 6
                                    : is("GLOBAL_IDS") || is("PEDIGREE_IDS") ? 1
                                                                             : 0;
    if (components == 0) {
      in_.fail("expected a keyword such as CELLS, found " + quoted(keyword) + "; a count before it may be wrong");
      return false;
    }
    const std::string type_name = word();
    end_line();
    return read_array(is("GLOBAL_IDS") || is("PEDIGREE_IDS") ? "" : name, type_name, components, tuples_);
  }

  /// Up to an empty line.
  void skip_metadata() {
    in_.rest_of_line();
    while (in_.remaining() > 0 && !in_.rest_of_line().empty()) {
    }
  }

  Source& in_;
  bool fields_;
  VtkGrid grid_;
  bool binary_ = false, modern_ = false;
  bool points_ = false, cells_ = false, types_ = false;
  bool of_cells_ = false;
  bool in_data_ = false;  ///< after CELL_DATA or POINT_DATA
  std::int64_t tuples_ = 0;
  int rank_ = 0;
};

}  // namespace

FileMesh read_vtk(Source& source, bool fields) { return VtkReader(source, fields).read(); }

}  // namespace pillowmesh
