#include "pillowmesh/io/medit.h"

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
  if (Dim == 3 && !mesh.ridges.empty()) {
    out.begin(kEdges, "Edges", mesh.ridges.size(), 12);
    for (const auto& ridge : mesh.ridges) {
      out.integer(ridge[0] + 1);
      out.integer(ridge[1] + 1);
      out.last(0);
    }
    out.begin(kRidges, "Ridges", mesh.ridges.size(), 4);
    for (std::size_t i = 0; i < mesh.ridges.size(); ++i) out.last(static_cast<Index>(i) + 1);
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
  if (!mesh.corners.empty()) {
    out.begin(kCorners, "Corners", mesh.corners.size(), 4);
    for (VertexId v : mesh.corners) out.last(v + 1);
  }
  out.end_file();
}

template void write_medit<2>(const MeshInput<2>&, Sink&, bool);
template void write_medit<3>(const MeshInput<3>&, Sink&, bool);

}  // namespace pillowmesh
