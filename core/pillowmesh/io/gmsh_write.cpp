#include <algorithm>
#include <limits>
#include <string>

#include "pillowmesh/io/gmsh.h"

namespace pillowmesh {
namespace {

constexpr int kPointType = 15;

/// The pinned vertices that a reader would not find again by itself. In 2D those are corners where the boundary hardly
/// turns and no groups meet; in 3D all.
template <int Dim>
std::vector<VertexId> corners_to_write(const MeshInput<Dim>& mesh) {
  std::vector<VertexId> corners = mesh.corners;
  if constexpr (Dim == 2) {
    constexpr double turn = 0.70710678118654752;  // cos 45 degrees: beyond it, BoundaryOptions sees a corner
    std::sort(corners.begin(), corners.end());
    struct Ends {
      int facets = 0;
      Index group = kNone;
      Point<2> direction[2];
    };
    std::vector<Ends> ends(corners.size());
    std::vector<bool> keep(corners.size(), true);
    for (const auto& facet : mesh.facets)
      for (int k = 0; k < 2; ++k) {
        const auto at = std::lower_bound(corners.begin(), corners.end(), facet.vertices[k]);
        if (at == corners.end() || *at != facet.vertices[k]) continue;
        const auto i = static_cast<std::size_t>(at - corners.begin());
        Ends& e = ends[i];
        if (e.facets == 2) continue;
        e.direction[e.facets] = (mesh.points[facet.vertices[1 - k]] - mesh.points[facet.vertices[k]]).normalized();
        if (e.facets == 1 && (e.group != facet.group || -e.direction[0].dot(e.direction[1]) < turn)) keep[i] = false;
        e.group = facet.group;
        ++e.facets;
      }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (keep[i]) corners[kept++] = corners[i];
    corners.resize(kept);
  }
  return corners;
}

/// Writes `MeshInput` in one of the four variants. Each region and each group of facets is one geometric entity, each
/// pinned vertex another one; entities carry the physical groups. Either all elements of a file or none should have a
/// physical group (Gmsh drops, and meshio refuses, the others): facets without a group are left out, and cells without
/// one get a number of their own.
template <int Dim>
class GmshWriter {
 public:
  GmshWriter(const MeshInput<Dim>& mesh, Sink& sink, bool binary)
      : mesh_(mesh),
        out_(sink),
        binary_(binary),
        corners_(corners_to_write(mesh)),
        facet_tags_(distinct_tags(mesh.facet_groups)),
        region_tags_(distinct_tags(mesh.region_groups)) {
    if (region_tags_.empty()) region_tags_.push_back(0);
    for (Index& tag : region_tags_)
      if (tag == 0) tag = *std::max_element(region_tags_.begin(), region_tags_.end()) + 1;
    by_region_.resize(region_tags_.size());
    by_group_.resize(facet_tags_.size());
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) ++by_region_[region_of(c)];
    for (const auto& f : mesh.facets) {
      if (!listed(f)) continue;
      ++by_group_[static_cast<std::size_t>(f.group)];
      ++facet_count_;
    }
  }

  void write(int version) {
    out_ << "$MeshFormat\n" << (version == 41 ? "4.1" : "2.2") << (binary_ ? " 1 8\n" : " 0 8\n");
    if (binary_) {
      out_.raw(std::int32_t{1});
      out_ << '\n';
    }
    out_ << "$EndMeshFormat\n";
    write_names();
    if (version == 41) {
      write_entities();
      write_nodes_41();
      write_elements_41();
    } else {
      write_22();
    }
  }

 private:
  [[nodiscard]] bool listed(const typename MeshInput<Dim>::Facet& facet) const { return facet_tags_[facet.group] != 0; }
  [[nodiscard]] std::size_t region_of(std::size_t cell) const {
    return mesh_.cell_region.empty() ? 0 : static_cast<std::size_t>(mesh_.cell_region[cell]);
  }

  template <class T>
  void value(T v, char separator = ' ') {
    if (binary_) {
      out_.raw(v);
    } else {
      out_ << v << separator;
    }
  }
  void integer(std::size_t v, char separator = ' ') { value(static_cast<std::int32_t>(v), separator); }
  void size(std::size_t v, char separator = ' ') { value(static_cast<std::int64_t>(v), separator); }
  void new_line() { out_ << '\n'; }
  void point(const Point<Dim>& p, char separator) {
    value(p[0]);
    value(p[1]);
    value(Dim == 3 ? p[Dim - 1] : 0.0, separator);
  }

  void write_names() {
    struct Name {
      int dim;
      Index tag;
      std::string_view name;
    };
    std::vector<Name> names;
    const auto add = [&](int dim, const std::vector<Group>& groups, const std::vector<Index>& tags) {
      for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto same = [&](const Name& n) { return n.dim == dim && n.tag == tags[i]; };
        if (!groups[i].name.empty() && std::find_if(names.begin(), names.end(), same) == names.end())
          names.push_back({dim, tags[i], groups[i].name});
      }
    };
    if (!corners_.empty()) names.push_back({0, 1, "corners"});
    add(Dim - 1, mesh_.facet_groups, facet_tags_);
    add(Dim, mesh_.region_groups, region_tags_);
    if (names.empty()) return;
    out_ << "$PhysicalNames\n" << names.size() << '\n';
    for (const Name& n : names) out_ << n.dim << ' ' << n.tag << " \"" << n.name << "\"\n";
    out_ << "$EndPhysicalNames\n";
  }

  void write_entities() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Point<Dim> low = Point<Dim>::Constant(inf), high = Point<Dim>::Constant(-inf);
    for (const Point<Dim>& p : mesh_.points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    std::size_t counts[4] = {corners_.size(), 0, 0, 0};
    counts[Dim - 1] = facet_tags_.size();
    counts[Dim] = region_tags_.size();
    out_ << "$Entities\n";
    for (int d = 0; d < 4; ++d) size(counts[d], d == 3 ? '\n' : ' ');
    const auto physical = [&](Index tag) {
      size(tag == 0 ? 0 : 1);
      if (tag != 0) value(tag);
    };
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      integer(i + 1);
      point(mesh_.points[corners_[i]], ' ');
      physical(1);
      if (!binary_) new_line();
    }
    for (const auto* tags : {&facet_tags_, &region_tags_})
      for (std::size_t i = 0; i < tags->size(); ++i) {
        integer(i + 1);
        point(low, ' ');
        point(high, ' ');
        physical((*tags)[i]);
        size(0, '\n');  // bounding entities: not known
      }
    if (binary_) new_line();
    out_ << "$EndEntities\n";
  }

  void write_nodes_41() {
    const std::size_t n = mesh_.points.size();
    out_ << "$Nodes\n";
    size(1), size(n), size(1), size(n, '\n');
    integer(Dim), integer(1), integer(0), size(n, '\n');
    for (std::size_t i = 0; i < n; ++i) size(i + 1, '\n');
    for (const Point<Dim>& p : mesh_.points) point(p, '\n');
    if (binary_) new_line();
    out_ << "$EndNodes\n";
  }

  void begin_block(int dim, std::size_t entity, int type, std::size_t count) {
    integer(dim), integer(entity + 1), integer(type), size(count, '\n');
  }
  template <std::size_t N>
  void element_41(const std::array<Index, N>& v) {
    size(++number_);
    for (std::size_t k = 0; k < N; ++k) size(static_cast<std::size_t>(v[k]) + 1, k + 1 == N ? '\n' : ' ');
  }

  void write_elements_41() {
    const auto used = [](const std::vector<std::size_t>& n) {
      return n.size() - static_cast<std::size_t>(std::count(n.begin(), n.end(), std::size_t{0}));
    };
    const std::size_t total = corners_.size() + facet_count_ + mesh_.cells.size();
    out_ << "$Elements\n";
    size(corners_.size() + used(by_group_) + used(by_region_)), size(total), size(1), size(total, '\n');
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      begin_block(0, i, kPointType, 1);
      element_41(std::array<Index, 1>{corners_[i]});
    }
    for (std::size_t g = 0; g < by_group_.size(); ++g) {
      if (by_group_[g] == 0) continue;
      begin_block(Dim - 1, g, Dim == 2 ? 1 : 3, by_group_[g]);
      for (const auto& f : mesh_.facets)
        if (static_cast<std::size_t>(f.group) == g && listed(f)) element_41(file_order(f.vertices));
    }
    for (std::size_t r = 0; r < by_region_.size(); ++r) {
      if (by_region_[r] == 0) continue;
      begin_block(Dim, r, Dim == 2 ? 3 : 5, by_region_[r]);
      for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
        if (region_of(c) == r) element_41(file_order(mesh_.cells[c]));
    }
    if (binary_) new_line();
    out_ << "$EndElements\n";
  }

  /// ASCII: number type 2 physical entity nodes; binary: type and 2 stand in the block's header.
  template <std::size_t N>
  void element_22(int type, Index physical, std::size_t entity, const std::array<Index, N>& v) {
    integer(++number_);
    if (!binary_) out_ << type << " 2 ";
    value(physical);
    integer(entity + 1);
    for (std::size_t k = 0; k < N; ++k) value(v[k] + 1, k + 1 == N ? '\n' : ' ');
  }
  void begin_block_22(int type, std::size_t count) {
    if (!binary_ || count == 0) return;
    integer(static_cast<std::size_t>(type)), integer(count), integer(2);
  }

  void write_22() {
    out_ << "$Nodes\n" << mesh_.points.size() << '\n';
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      integer(i + 1);
      point(mesh_.points[i], '\n');
    }
    if (binary_) new_line();
    out_ << "$EndNodes\n$Elements\n" << corners_.size() + facet_count_ + mesh_.cells.size() << '\n';
    begin_block_22(kPointType, corners_.size());
    for (std::size_t i = 0; i < corners_.size(); ++i) element_22(kPointType, 1, i, std::array<Index, 1>{corners_[i]});
    begin_block_22(Dim == 2 ? 1 : 3, facet_count_);
    for (const auto& f : mesh_.facets) {
      if (!listed(f)) continue;
      element_22(Dim == 2 ? 1 : 3, facet_tags_[f.group], static_cast<std::size_t>(f.group), file_order(f.vertices));
    }
    begin_block_22(Dim == 2 ? 3 : 5, mesh_.cells.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const std::size_t r = region_of(c);
      element_22(Dim == 2 ? 3 : 5, region_tags_[r], r, file_order(mesh_.cells[c]));
    }
    if (binary_) new_line();
    out_ << "$EndElements\n";
  }

  const MeshInput<Dim>& mesh_;
  Sink& out_;
  bool binary_;
  std::vector<VertexId> corners_;
  std::vector<Index> facet_tags_, region_tags_;
  std::vector<std::size_t> by_group_, by_region_;  // numbers of elements
  std::size_t facet_count_ = 0;
  std::size_t number_ = 0;  // of the element written last
};

}  // namespace

template <int Dim>
void write_gmsh(const MeshInput<Dim>& mesh, Sink& sink, int version, bool binary) {
  GmshWriter<Dim>(mesh, sink, binary).write(version);
}

template void write_gmsh<2>(const MeshInput<2>&, Sink&, int, bool);
template void write_gmsh<3>(const MeshInput<3>&, Sink&, int, bool);

}  // namespace pillowmesh
