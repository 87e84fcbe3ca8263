#include "pillowmesh/io/medit.h"

#include <algorithm>
#include <utility>

namespace pillowmesh {
namespace {

// libmeshb's keyword numbers.
enum Keyword : std::int32_t {
  kDimension = 3,
  kVertices = 4,
  kEdges = 5,
  kQuadrilaterals = 7,
  kHexahedra = 10,
  kCorners = 13,
  kRidges = 14,
  kRequiredVertices = 15,
  kRequiredEdges = 16,
  kRequiredQuadrilaterals = 18,
  kEnd = 54
};

/// Writes one section after the other in either encoding. Binary: version 3 (doubles, 64-bit positions).
class SectionWriter {
 public:
  SectionWriter(Sink& sink, bool binary) : sink_(sink), binary_(binary) {}

  void begin_file(int dim) {
    if (binary_) {
      integer(1);
      integer(3);
      position_ = 8;
      section(kDimension, 4);
      integer(dim);
    } else {
      sink_ << "MeshVersionFormatted 2\nDimension " << dim << "\n";
    }
  }
  void begin(Keyword keyword, const char* name, std::size_t count, std::size_t unit) {
    if (binary_) {
      section(keyword, 4 + count * unit);
      integer(static_cast<std::int32_t>(count));
    } else {
      sink_ << "\n" << name << "\n" << count << "\n";
    }
  }
  void end_file() {
    if (binary_) {
      section(kEnd, 0);
    } else {
      sink_ << "\nEnd\n";
    }
  }
  void number(double v) {
    if (binary_) {
      sink_.raw(v);
    } else {
      sink_ << v << ' ';
    }
  }
  void integer(std::int32_t v) {
    if (binary_) {
      sink_.raw(v);
    } else {
      sink_ << v << ' ';
    }
  }
  /// The last integer of a line.
  void last(std::int32_t v) {
    if (binary_) {
      sink_.raw(v);
    } else {
      sink_ << v << '\n';
    }
  }

 private:
  void section(Keyword keyword, std::size_t size) {
    position_ += 12 + static_cast<std::int64_t>(size);
    integer(keyword);
    sink_.raw(position_);
  }
  Sink& sink_;
  bool binary_;
  std::int64_t position_ = 0;
};

/// Where the required facets are in the list of facets.
template <int Dim>
std::vector<Index> places_of_required_facets(const MeshInput<Dim>& mesh) {
  std::vector<std::pair<FacetCorners<Dim>, Index>> known;
  std::vector<Index> places;
  if (mesh.required_facets.empty()) return places;
  const auto key = [](FacetCorners<Dim> v) {
    std::sort(v.begin(), v.end());
    return v;
  };
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) known.push_back({key(mesh.facets[i].vertices), static_cast<Index>(i)});
  std::sort(known.begin(), known.end());
  for (const auto& facet : mesh.required_facets) {
    const auto wanted = key(facet);
    const auto at = std::lower_bound(known.begin(), known.end(), std::pair(wanted, Index{0}));
    if (at != known.end() && at->first == wanted) places.push_back(at->second);
  }
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace

template <int Dim>
void write_medit(const MeshInput<Dim>& mesh, Sink& sink, bool binary) {
  SectionWriter out(sink, binary);
  out.begin_file(Dim);
  out.begin(kVertices, "Vertices", mesh.points.size(), Dim * 8 + 4);
  for (const Point<Dim>& p : mesh.points) {
    for (int d = 0; d < Dim; ++d) out.number(p[d]);
    out.last(0);
  }
  const std::vector<Index> facet_tags = distinct_tags(mesh.facet_groups);
  const std::vector<Index> region_tags = distinct_tags(mesh.region_groups);
  const auto number = [&](Keyword keyword, const char* name, std::size_t first, std::size_t count) {
    if (count == 0) return;
    out.begin(keyword, name, count, 4);
    for (std::size_t i = 0; i < count; ++i) out.last(static_cast<Index>(first + i) + 1);
  };
  if (Dim == 3 && mesh.ridges.size() + mesh.required_edges.size() > 0) {
    out.begin(kEdges, "Edges", mesh.ridges.size() + mesh.required_edges.size(), 12);
    for (const auto* list : {&mesh.ridges, &mesh.required_edges})
      for (const auto& edge : *list) {
        out.integer(edge[0] + 1);
        out.integer(edge[1] + 1);
        out.last(0);
      }
    number(kRidges, "Ridges", 0, mesh.ridges.size());
    number(kRequiredEdges, "RequiredEdges", mesh.ridges.size(), mesh.required_edges.size());
  }
  if (!mesh.facets.empty()) {
    constexpr int n = Cell<Dim>::facet_corners;
    out.begin(Dim == 2 ? kEdges : kQuadrilaterals, Dim == 2 ? "Edges" : "Quadrilaterals", mesh.facets.size(),
              (n + 1) * 4);
    for (const auto& facet : mesh.facets) {
      for (Index v : file_order(facet.vertices)) out.integer(v + 1);
      out.last(facet_tags[facet.group]);
    }
  }
  out.begin(Dim == 2 ? kQuadrilaterals : kHexahedra, Dim == 2 ? "Quadrilaterals" : "Hexahedra", mesh.cells.size(),
            (Cell<Dim>::corners + 1) * 4);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (Index v : file_order(mesh.cells[c])) out.integer(v + 1);
    out.last(region_tags.empty() || mesh.cell_region.empty() ? 0 : region_tags[mesh.cell_region[c]]);
  }
  const auto list = [&](Keyword keyword, const char* name, const std::vector<Index>& numbers) {
    if (numbers.empty()) return;
    out.begin(keyword, name, numbers.size(), 4);
    for (const Index i : numbers) out.last(i + 1);
  };
  list(kCorners, "Corners", mesh.corners);
  list(kRequiredVertices, "RequiredVertices", mesh.required_vertices);
  list(Dim == 2 ? kRequiredEdges : kRequiredQuadrilaterals, Dim == 2 ? "RequiredEdges" : "RequiredQuadrilaterals",
       places_of_required_facets(mesh));
  if (Dim == 2) list(kRequiredQuadrilaterals, "RequiredQuadrilaterals", mesh.required_cells);
  out.end_file();
}

template void write_medit<2>(const MeshInput<2>&, Sink&, bool);
template void write_medit<3>(const MeshInput<3>&, Sink&, bool);

}  // namespace pillowmesh
