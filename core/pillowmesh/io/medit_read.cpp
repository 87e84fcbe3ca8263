#include <array>
#include <cmath>
#include <string>

#include "pillowmesh/io/medit.h"

namespace pillowmesh {
namespace {

/// Sections that matter, with libmeshb's keyword numbers.
struct Section {
  std::string_view keyword;
  int code;
  std::string_view plural;
  int vertices;  ///< of an element; 0: not an element section
  bool foreign;
};
constexpr std::array<Section, 21> kSections{{
    {"Vertices", 4, "vertices", 0, false},
    {"Edges", 5, "edges", 2, false},
    {"Triangles", 6, "triangles", 3, true},
    {"Quadrilaterals", 7, "quads", 4, false},
    {"Tetrahedra", 8, "tetrahedra", 4, true},
    {"Prisms", 9, "prisms", 6, true},
    {"Hexahedra", 10, "hexahedra", 8, false},
    {"Corners", 13, "corners", 0, false},
    {"Ridges", 14, "ridges", 0, false},
    {"RequiredVertices", 15, "required vertices", 0, false},
    {"RequiredEdges", 16, "required edges", 0, false},
    {"RequiredQuadrilaterals", 18, "required quads", 0, false},
    {"Pyramids", 49, "pyramids", 5, true},
    {"Pentahedra", 9, "prisms", 6, true},
    {"Wedges", 9, "prisms", 6, true},
    {"EdgesP2", 25, "second-order edges", 3, true},
    {"TrianglesP2", 24, "second-order triangles", 6, true},
    {"QuadrilateralsQ2", 27, "second-order quads", 9, true},
    {"TetrahedraP2", 30, "second-order tetrahedra", 10, true},
    {"HexahedraQ2", 33, "second-order hexahedra", 27, true},
    {"Hexaedra", 10, "hexahedra", 8, false},  // a common misspelling
}};

/// Reads sections from either encoding; `Id` and `Real` are the binary types, unused in text.
template <class Id, class Real>
class SectionReader {
 public:
  SectionReader(Source& source, FileMesh& mesh, int dim) : in_(source), mesh_(mesh), dim_(dim) {}

  void read(const Section& s) {
    if (s.code == 4) {
      read_vertices();
    } else if (s.code == 13) {
      read_list(mesh_.corners, s, "a vertex number");
    } else if (s.code == 15) {
      read_list(mesh_.required_vertices, s, "a vertex number");
    } else if (s.code == 16) {
      read_list(mesh_.required_lines, s, "an edge number");
    } else if (s.code == 18) {
      read_list(mesh_.required_quads, s, "a quad number");
    } else if (s.code == 14) {
      read_list(mesh_.ridges, s, "an edge number");
    } else if (s.foreign) {
      const std::int64_t n = count(s, s.vertices + 1);
      for (std::int64_t i = 0; i < n && !in_.failed(); ++i) {
        add_foreign(mesh_, s.plural, in_.binary() ? 0 : in_.line() + (i == 0 ? 1 : 0));
        std::array<Index, 28> v;
        for (int k = 0; k <= s.vertices; ++k) v[k] = id(in_.template integer<Id>("a vertex number or reference")) - 1;
        if (s.vertices == 3 && s.code == 6) mesh_.triangles.push_back({v[0], v[1], v[2]});
        if (s.vertices == 4) mesh_.tetrahedra.push_back({v[0], v[1], v[2], v[3]});
      }
    } else if (s.vertices == 2) {
      read_elements(mesh_.lines, s);
    } else if (s.vertices == 4) {
      read_elements(mesh_.quads, s);
    } else if (s.vertices == 8) {
      read_elements(mesh_.hexes, s);
    }
  }

 private:
  std::int64_t count(const Section& s, int numbers) {
    return in_.template count<Id>(std::string(s.plural).c_str(),
                                  in_.binary() ? numbers * static_cast<std::int64_t>(sizeof(Id)) : numbers);
  }
  Index id(std::int64_t value) {
    if (value >= -0x7fffffff && value <= 0x7fffffff) return static_cast<Index>(value);
    in_.fail("the number " + std::to_string(value) + " does not fit in 32 bits");
    return 0;
  }

  void read_vertices() {
    if (!mesh_.points.empty()) return in_.fail("the vertices are listed twice");
    const std::int64_t unit =
        in_.binary() ? dim_ * static_cast<std::int64_t>(sizeof(Real)) + static_cast<std::int64_t>(sizeof(Id))
                     : dim_ + 1;
    const std::int64_t n = in_.template count<Id>("vertices", unit);
    mesh_.points.reserve(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n && !in_.failed(); ++i) {
      Point<3> p(0.0, 0.0, 0.0);
      for (int d = 0; d < dim_; ++d) {
        p[d] = in_.template real<Real>("a coordinate");
        if (!std::isfinite(p[d]))
          in_.fail("a coordinate of vertex " + std::to_string(i + 1) + " is not a finite number");
      }
      in_.template integer<Id>("a vertex reference");
      mesh_.points.push_back(p);
    }
  }

  template <int N>
  void read_elements(Elements<N>& elements, const Section& s) {
    const auto n = static_cast<std::size_t>(count(s, N + 1));
    elements.vertices.reserve(elements.vertices.size() + n);
    elements.tag.reserve(elements.tag.size() + n);
    if (!in_.binary()) elements.line.reserve(elements.line.size() + n);
    for (std::size_t i = 0; i < n && !in_.failed(); ++i) {
      std::array<Index, N> v;
      for (int k = 0; k < N; ++k) v[k] = id(in_.template integer<Id>("a vertex number")) - 1;
      elements.vertices.push_back(v);
      elements.tag.push_back(id(in_.template integer<Id>("a reference")));
      if (!in_.binary()) elements.line.push_back(static_cast<Index>(in_.line()));
    }
  }

  void read_list(std::vector<Index>& list, const Section& s, const char* what) {
    const std::int64_t n = count(s, 1);
    for (std::int64_t i = 0; i < n && !in_.failed(); ++i) list.push_back(id(in_.template integer<Id>(what)) - 1);
  }

  Source& in_;
  FileMesh& mesh_;
  int dim_;
};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

template <class Id, class Real, class Offset>
void read_binary_sections(Source& in, FileMesh& mesh) {
  int dim = 0;
  while (in.remaining() > 0 && !in.failed()) {
    const std::size_t start = in.position();
    const int code = static_cast<int>(in.integer<std::int32_t>("a keyword"));
    if (code == 54) return;  // End
    const auto next = static_cast<std::int64_t>(in.value<Offset>("a section's end"));
    if (in.failed()) return;
    if (code == 3) {
      dim = static_cast<int>(in.integer<std::int32_t>("the dimension"));
      if (dim != 2 && dim != 3) return in.fail("the dimension " + std::to_string(dim) + " is neither 2 nor 3");
      continue;
    }
    const Section* section = nullptr;
    for (const Section& s : kSections)
      if (s.code == code && section == nullptr) section = &s;
    if (section != nullptr) {
      if (dim == 0) return in.fail("the dimension should come before any section");
      SectionReader<Id, Real>(in, mesh, dim).read(*section);
    } else {
      if (next <= static_cast<std::int64_t>(start) || next > static_cast<std::int64_t>(start + in.remaining() + 64))
        return in.fail("section " + std::to_string(code) + " ends outside of the file; it is truncated");
      in.seek(static_cast<std::size_t>(next));
    }
  }
  in.fail("the file ends before its keyword End; it is truncated");
}

}  // namespace

FileMesh read_medit_ascii(Source& in) {
  FileMesh mesh;
  if (in.word() != "MeshVersionFormatted") {
    in.fail("a Medit file should begin with MeshVersionFormatted");
    return mesh;
  }
  const std::int64_t version = in.integer("the version");
  if (!in.failed() && (version < 1 || version > 4))
    in.fail("Medit version " + std::to_string(version) + " is not supported");
  int dim = 0;
  while (!in.failed()) {
    const std::string_view keyword = in.word();
    if (keyword.empty()) {
      // Some programs leave out End; a file cut in the middle of a word is still told apart.
      const char last = in.view(in.position() - 1, 1)[0];
      if (last != '\n' && last != ' ' && last != '\t') in.fail("the file ends before its keyword End; it is truncated");
      break;
    }
    if (keyword == "End") break;
    if (keyword == "Dimension") {
      dim = static_cast<int>(in.integer("the dimension"));
      if (dim != 2 && dim != 3) in.fail("the dimension " + std::to_string(dim) + " is neither 2 nor 3");
      continue;
    }
    const Section* section = nullptr;
    for (const Section& s : kSections)
      if (s.keyword == keyword) section = &s;
    if (section != nullptr) {
      if (dim == 0) in.fail("the Dimension should come before " + std::string(keyword));
      SectionReader<std::int32_t, double>(in, mesh, dim).read(*section);
    } else if (!is_letter(keyword[0])) {
      in.fail("expected a keyword, found " + quoted(keyword) +
              "; the section before holds more numbers than its count says");
    } else {  // a section that does not matter: to the next keyword
      for (;;) {
        const Source::Mark before = in.mark();
        const std::string_view word = in.word();
        if (word.empty()) break;
        if (is_letter(word[0]) && word != "nan" && word != "inf") {
          in.reset(before);
          break;
        }
      }
    }
  }
  return mesh;
}

FileMesh read_medit_binary(Source& in) {
  FileMesh mesh;
  in.set_binary(false);
  const auto code = in.value<std::int32_t>("Medit's byte-order mark");
  if (code == 0x01000000) {
    in.set_binary(true);
  } else if (code != 1) {
    in.fail_whole("not a binary Medit file: it does not begin with Medit's byte-order mark");
  }
  const auto version = in.value<std::int32_t>("the version");
  if (in.failed()) return mesh;
  switch (version) {
    case 1:
      read_binary_sections<std::int32_t, float, std::int32_t>(in, mesh);
      break;
    case 2:
      read_binary_sections<std::int32_t, double, std::int32_t>(in, mesh);
      break;
    case 3:
      read_binary_sections<std::int32_t, double, std::int64_t>(in, mesh);
      break;
    case 4:
      read_binary_sections<std::int64_t, double, std::int64_t>(in, mesh);
      break;
    default:
      in.fail_whole("Medit version " + std::to_string(version) + " is not supported");
  }
  return mesh;
}

}  // namespace pillowmesh
