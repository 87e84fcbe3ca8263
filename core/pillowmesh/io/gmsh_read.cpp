#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "pillowmesh/io/gmsh.h"
#include "pillowmesh/io/node_tags.h"

namespace pillowmesh {
namespace {

/// Element types by Gmsh's number: those with a role, then those that are named in a refusal.
struct ElementType {
  int code;
  int vertices;
  std::string_view plural;
};
constexpr ElementType kGmshTypes[] = {
    {1, 2, "edges"},
    {2, 3, "triangles"},
    {3, 4, "quads"},
    {4, 4, "tetrahedra"},
    {5, 8, "hexahedra"},
    {6, 6, "prisms"},
    {7, 5, "pyramids"},
    {8, 3, "second-order edges"},
    {9, 6, "second-order triangles"},
    {10, 9, "second-order quads"},
    {11, 10, "second-order tetrahedra"},
    {12, 27, "second-order hexahedra"},
    {13, 18, "second-order prisms"},
    {14, 14, "second-order pyramids"},
    {15, 1, "points"},
    {16, 8, "second-order quads"},
    {17, 20, "second-order hexahedra"},
    {18, 15, "second-order prisms"},
    {19, 13, "second-order pyramids"},
};

const ElementType* find_type(std::int64_t code) {
  for (const ElementType& t : kGmshTypes)
    if (t.code == code) return &t;
  return nullptr;
}

class GmshReader {
 public:
  explicit GmshReader(Source& source) : in_(source) {}

  FileMesh read() {
    read_format();
    bool nodes = false, elements = false;
    while (!in_.failed()) {
      text([&] { section_ = in_.word(); });
      if (section_.empty()) break;
      if (binary_) in_.rest_of_line();
      if (section_ == "$PhysicalNames") {
        text([&] { read_names(); });
      } else if (section_ == "$Entities" && version_ == 41) {
        read_entities();
      } else if (section_ == "$PartitionedEntities") {
        in_.fail("partitioned meshes are not supported: save the mesh without partitions");
      } else if (section_ == "$Nodes") {
        version_ == 41 ? read_nodes_41() : read_nodes_22();
        if (const std::int64_t tag = in_.failed() ? 0 : tags_.finish(); tag != 0)
          in_.fail(tag > 0 ? "node " + std::to_string(tag) + " is defined twice" : "a node number is not positive");
        nodes = true;
      } else if (section_ == "$Elements") {
        if (!nodes) in_.fail("$Elements comes before $Nodes");
        version_ == 41 ? read_elements_41() : read_elements_22();
        elements = true;
      } else if (section_[0] == '$') {
        skip_section();
        continue;
      } else {
        in_.fail("expected a section such as $Nodes, found " + quoted(section_));
      }
      if (!in_.failed()) end_section();
    }
    if (!in_.failed() && !(nodes && elements))
      in_.fail_whole(std::string("the file has no ") + (nodes ? "$Elements" : "$Nodes") + "; it is truncated or empty");
    return std::move(mesh_);
  }

 private:
  /// Section names and physical names are text in binary files too.
  template <class F>
  void text(F&& f) {
    in_.set_text(true);
    f();
    in_.set_text(!binary_);
  }

  void read_format() {
    if (in_.word() != "$MeshFormat")
      return in_.fail("a Gmsh file should begin with $MeshFormat (version 1 is not supported)");
    const std::string version(in_.word());
    if (version == "4.1") {
      version_ = 41;
    } else if (version == "2.2" || version == "2.1" || version == "2" || version == "2.0") {
      version_ = 22;
    } else {
      return in_.fail("Gmsh format version " + quoted(version) + " is not supported: save as 4.1 or 2.2");
    }
    const std::int64_t kind = in_.integer("the file type");
    const std::int64_t size = in_.integer("the data size");
    if (in_.failed()) return;
    if (kind != 0 && kind != 1) return in_.fail("the file type should be 0 (ASCII) or 1 (binary)");
    if (kind == 1) {
      if (size != 8) return in_.fail("binary data of size " + std::to_string(size) + " is not supported, only 8");
      in_.rest_of_line();
      in_.set_binary(false);
      const auto one = in_.value<std::int32_t>("the byte-order mark");
      if (one == 0x01000000) {
        in_.set_binary(true);
      } else if (one != 1) {
        in_.fail("the byte-order mark is not 1");
      }
      binary_ = true;
    }
    section_ = "$MeshFormat";
    if (!in_.failed()) end_section();
  }

  void end_section() {
    text([&] {
      const std::string_view word = in_.word();
      const std::string expected = "$End" + std::string(section_.substr(1));
      if (in_.failed() || word == expected) return;
      in_.fail(word.empty()
                   ? "the file ends before " + quoted(expected) + "; it is truncated"
                   : "expected " + quoted(expected) + ", found " + quoted(word) + "; a count before it is wrong");
    });
  }

  void skip_section() {
    const std::string end = "$End" + std::string(section_.substr(1));
    const std::size_t at = in_.find(end);
    if (at == std::string_view::npos) return in_.fail("the file ends before " + quoted(end) + "; it is truncated");
    in_.seek(at + end.size(), !binary_);
  }

  Index index32(std::int64_t value, const char* what) {
    if (value >= -0x7fffffff && value <= 0x7fffffff) return static_cast<Index>(value);
    in_.fail(std::string(what) + " " + std::to_string(value) + " does not fit in 32 bits");
    return 0;
  }

  void read_names() {
    const std::int64_t n = in_.count("physical names", 3);
    for (std::int64_t i = 0; i < n && !in_.failed(); ++i) {
      const auto dim = in_.integer("a dimension");
      const auto tag = in_.integer("a physical tag");
      std::string_view line = in_.rest_of_line();
      const std::size_t open = line.find('"'), close = line.rfind('"');
      if (in_.failed()) return;
      if (open == std::string_view::npos || close == open) return in_.fail("a physical name should stand in quotes");
      mesh_.names.push_back({static_cast<int>(dim), index32(tag, "the physical tag"),
                             std::string(line.substr(open + 1, close - open - 1))});
    }
  }

  /// 4.1 only: which physical group each geometric entity belongs to.
  void read_entities() {
    std::int64_t counts[4];
    for (auto& n : counts) n = in_.count<std::int64_t>("entities", 4);
    for (int dim = 0; dim < 4; ++dim)
      for (std::int64_t i = 0; i < counts[dim] && !in_.failed(); ++i) {
        const Index tag = index32(in_.integer("an entity tag"), "the entity tag");
        for (int k = 0; k < (dim == 0 ? 3 : 6); ++k) in_.real("a coordinate");
        const std::int64_t physicals = in_.count<std::int64_t>("physical tags", 1);
        Index first = 0;
        for (std::int64_t k = 0; k < physicals && !in_.failed(); ++k) {
          const Index p = index32(in_.integer("a physical tag"), "the physical tag");
          if (k == 0) first = std::abs(p);  // the sign is an orientation
        }
        if (first != 0) physical_[dim].emplace_back(tag, first);
        if (dim == 0) continue;
        const std::int64_t bounding = in_.count<std::int64_t>("bounding entities", 1);
        for (std::int64_t k = 0; k < bounding && !in_.failed(); ++k) in_.integer("a bounding entity");
      }
    for (auto& p : physical_) std::sort(p.begin(), p.end());
  }
  [[nodiscard]] Index physical_of(int dim, Index entity) const {
    const auto& p = physical_[dim];
    const auto at = std::lower_bound(p.begin(), p.end(), std::pair<Index, Index>(entity, 0));
    return at != p.end() && at->first == entity ? at->second : 0;
  }

  void read_point() {
    Point<3> p;
    for (int d = 0; d < 3; ++d) {
      p[d] = in_.real("a coordinate");
      if (!in_.failed() && !std::isfinite(p[d])) in_.fail("a coordinate is not a finite number");
    }
    mesh_.points.push_back(p);
  }

  void read_nodes_22() {
    std::int64_t n = 0;
    text([&] {
      n = in_.integer("the number of nodes");
      if (binary_) in_.rest_of_line();
    });
    n = in_.checked_count(n, "nodes", binary_ ? 28 : 4);
    mesh_.points.reserve(static_cast<std::size_t>(n));
    tags_.reserve(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n && !in_.failed(); ++i) {
      tags_.add(in_.integer("a node number"));
      read_point();
    }
  }

  void read_nodes_41() {
    const std::int64_t blocks = in_.integer<std::int64_t>("the number of node blocks");
    const std::int64_t total = in_.count<std::int64_t>("nodes", binary_ ? 32 : 4);
    in_.integer<std::int64_t>("the lowest node number");
    in_.integer<std::int64_t>("the highest node number");
    mesh_.points.reserve(static_cast<std::size_t>(total));
    tags_.reserve(static_cast<std::size_t>(total));
    for (std::int64_t b = 0; b < blocks && !in_.failed(); ++b) {
      const std::int64_t dim = in_.integer("an entity dimension");
      in_.integer("an entity tag");
      const std::int64_t parametric = in_.integer("0 or 1 for parametric coordinates");
      if (!in_.failed() && (dim < 0 || dim > 3)) return in_.fail("the entity dimension is not 0 to 3");
      const std::int64_t n = in_.count<std::int64_t>("nodes", binary_ ? 32 : 4);
      for (std::int64_t i = 0; i < n && !in_.failed(); ++i) tags_.add(in_.integer<std::int64_t>("a node number"));
      for (std::int64_t i = 0; i < n && !in_.failed(); ++i) {
        read_point();
        if (parametric != 0)
          for (std::int64_t d = 0; d < dim; ++d) in_.real("a parametric coordinate");
      }
    }
    const auto found = static_cast<std::int64_t>(mesh_.points.size());
    if (!in_.failed() && found != total)
      in_.fail("the file promises " + std::to_string(total) + " nodes but lists " + std::to_string(found));
  }

  template <int N>
  void keep(Elements<N>& elements, const Index* v, Index physical, std::int64_t line) {
    std::array<Index, N> vertices;
    std::copy(v, v + N, vertices.begin());
    // Version 2.2 repeats an element for each of its physical groups: the first one counts.
    if (version_ == 22 && !elements.vertices.empty() && elements.vertices.back() == vertices) return;
    elements.vertices.push_back(vertices);
    elements.tag.push_back(physical);
    if (!binary_) elements.line.push_back(static_cast<Index>(line));
  }

  /// The nodes of one element, whose number and tags have been read.
  template <class Id>
  void read_element(const ElementType& type, Index physical) {
    Index v[8] = {};
    const std::int64_t line = in_.line();
    for (int k = 0; k < type.vertices; ++k) {
      const std::int64_t tag = in_.integer<Id>("a node number");
      if (in_.failed()) return;
      const Index index = tags_.index_of(tag);
      if (index == kNone)
        return in_.fail("an element names node " + std::to_string(tag) + ", which the file does not define");
      if (k < 8) v[k] = index;
    }
    switch (type.code) {
      case 15:
        if (physical == 0) break;
        mesh_.corners.push_back(v[0]);
        mesh_.corner_tags.push_back(physical);
        break;
      case 1:
        if (physical != 0) mesh_.ridges.push_back(static_cast<Index>(mesh_.lines.vertices.size()));
        keep(mesh_.lines, v, physical, line);
        if (physical != 0 && mesh_.ridges.back() >= static_cast<Index>(mesh_.lines.vertices.size()))
          mesh_.ridges.pop_back();  // it was a repetition
        break;
      case 3:
        keep(mesh_.quads, v, physical, line);
        break;
      case 5:
        keep(mesh_.hexes, v, physical, line);
        break;
      default:
        add_foreign(mesh_, type.plural, binary_ ? 0 : line);
    }
  }

  const ElementType* known_type(std::int64_t code) {
    const ElementType* type = find_type(code);
    if (type == nullptr && !in_.failed())
      in_.fail("Gmsh element type " + std::to_string(code) +
               " is not supported; pillowmesh takes first-order quads and hexahedra");
    return type;
  }

  void read_elements_22() {
    std::int64_t n = 0;
    text([&] {
      n = in_.integer("the number of elements");
      if (binary_) in_.rest_of_line();
    });
    n = in_.checked_count(n, "elements", binary_ ? 8 : 4);
    std::int64_t code = 0, following = 1, tag_count = 0;
    for (std::int64_t i = 0; i < n && !in_.failed(); i += following) {
      if (binary_) {
        code = in_.integer("an element type");
        following = in_.count("elements", 8);
        tag_count = in_.count("element tags", 4);
        if (!in_.failed() && following == 0) return in_.fail("a block of elements is empty");
      }
      for (std::int64_t k = 0; k < following && !in_.failed(); ++k) {
        in_.integer("an element number");
        if (!binary_) {
          code = in_.integer("an element type");
          tag_count = in_.count("element tags", 1);
        }
        const ElementType* type = known_type(code);
        Index physical = 0;
        for (std::int64_t t = 0; t < tag_count && !in_.failed(); ++t) {
          const Index tag = index32(in_.integer("an element tag"), "the element tag");
          if (t == 0) physical = std::abs(tag);
        }
        if (type == nullptr || in_.failed()) return;
        read_element<std::int32_t>(*type, physical);
      }
    }
  }

  void read_elements_41() {
    const std::int64_t blocks = in_.integer<std::int64_t>("the number of element blocks");
    const std::int64_t total = in_.count<std::int64_t>("elements", binary_ ? 16 : 2);
    in_.integer<std::int64_t>("the lowest element number");
    in_.integer<std::int64_t>("the highest element number");
    std::int64_t found = 0;
    for (std::int64_t b = 0; b < blocks && !in_.failed(); ++b) {
      const std::int64_t dim = in_.integer("an entity dimension");
      const Index entity = index32(in_.integer("an entity tag"), "the entity tag");
      const ElementType* type = known_type(in_.integer("an element type"));
      const std::int64_t n = in_.count<std::int64_t>("elements", binary_ ? 16 : 2);
      if (in_.failed()) return;
      if (dim < 0 || dim > 3) return in_.fail("the entity dimension is not 0 to 3");
      const Index physical = physical_of(static_cast<int>(dim), entity);
      for (std::int64_t i = 0; i < n && !in_.failed(); ++i) {
        in_.integer<std::int64_t>("an element number");
        read_element<std::int64_t>(*type, physical);
      }
      found += n;
    }
    if (!in_.failed() && found != total)
      in_.fail("the file promises " + std::to_string(total) + " elements but lists " + std::to_string(found));
  }

  Source& in_;
  FileMesh mesh_;
  NodeTags tags_;
  std::string_view section_;
  int version_ = 0;
  bool binary_ = false;
  std::vector<std::pair<Index, Index>> physical_[4];  // entity -> physical group, sorted
};

}  // namespace

FileMesh read_gmsh(Source& source) { return GmshReader(source).read(); }

}  // namespace pillowmesh
