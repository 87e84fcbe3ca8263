#include "pillowmesh/coarsen/chord_collapse.h"

#include <algorithm>

#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {
namespace {

/// Vertices that become one, by union-find over the few vertices of a chord.
class Classes {
 public:
  void add(VertexId v) { vertices_.push_back(v); }
  void close() {
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    parent_.resize(vertices_.size());
    for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = static_cast<Index>(i);
  }
  [[nodiscard]] Index index(VertexId v) const {
    const auto at = std::lower_bound(vertices_.begin(), vertices_.end(), v);
    return at != vertices_.end() && *at == v ? static_cast<Index>(at - vertices_.begin()) : kNone;
  }
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(VertexId a, VertexId b) {
    const Index i = root(index(a)), j = root(index(b));
    parent_[std::max(i, j)] = std::min(i, j);
  }
  [[nodiscard]] const std::vector<VertexId>& vertices() const { return vertices_; }

 private:
  std::vector<VertexId> vertices_;
  std::vector<Index> parent_;
};

/// What a class of merged vertices becomes.
struct Merged {
  VertexId keep = kNone;
  Point<2> sum = Point<2>::Zero();
  int interior = 0, boundary = 0;
};

}  // namespace

bool plan_chord_collapse(const Mesh<2>& mesh, const Chord& chord, Cavity& cavity) {
  cavity.clear();
  Classes classes;
  for (std::size_t k = 0; k < chord.rungs(); ++k)
    for (const VertexId v : rung(mesh, chord, k)) classes.add(v);
  classes.close();
  for (std::size_t k = 0; k < chord.rungs(); ++k) {
    const auto [l, r] = rung(mesh, chord, k);
    classes.join(l, r);
  }
  // Two vertices of the boundary may merge only along it: through a rung at an end of the chord.
  std::vector<Merged> merged(classes.vertices().size());
  for (const VertexId v : classes.vertices()) {
    Merged& m = merged[classes.root(classes.index(v))];
    if (m.keep == kNone || mesh.support[v].dim < mesh.support[m.keep].dim) m.keep = v;
    (mesh.support[v].dim == 2 ? m.interior : m.boundary) += 1;
    m.sum += mesh.points[v];
  }
  if (!chord.closed)
    for (const std::size_t k : {std::size_t{0}, chord.cells.size()}) {
      const auto [l, r] = rung(mesh, chord, k);
      const VertexSupport &a = mesh.support[l], &b = mesh.support[r];
      if (a.dim == 0 && b.dim == 0) return false;
      if (a.dim == 1 && b.dim == 1 && a.entity != b.entity) return false;
      Merged& m = merged[classes.root(classes.index(l))];
      if (m.boundary != 2) return false;
      m.boundary = 1;
      if (a.dim == 1 && b.dim == 1) {
        Index anchor = mesh.anchor[m.keep];
        cavity.moved.push_back(m.keep);
        cavity.moved_to.push_back(slide<2>(*mesh.geometry, a, anchor, 0.5 * (mesh.points[l] + mesh.points[r])));
      }
    }
  for (const VertexId v : classes.vertices()) {
    const Merged& m = merged[classes.root(classes.index(v))];
    if (m.boundary > 1) return false;
    if (v != m.keep) {
      cavity.removed.push_back(v);
      cavity.merged_into.push_back(m.keep);
      continue;
    }
    cavity.around.push_back(v);
    if (m.boundary > 0) continue;
    cavity.moved.push_back(v);
    cavity.moved_to.push_back(m.sum / m.interior);
  }

  std::vector<CellId> inside;
  for (const ChordCell& k : chord.cells) inside.push_back(k.cell);
  std::sort(inside.begin(), inside.end());
  inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
  cavity.old_cells = inside;
  OrderedStar star;
  for (const VertexId d : cavity.removed) {
    if (!find_star(mesh, d, star)) return false;
    for (int n = 0; n < star.count; ++n) cavity.old_cells.push_back(star.cell[n]);
  }
  std::sort(cavity.old_cells.begin(), cavity.old_cells.end());
  cavity.old_cells.erase(std::unique(cavity.old_cells.begin(), cavity.old_cells.end()), cavity.old_cells.end());
  for (const CellId c : cavity.old_cells) {
    if (mesh.region[c] != mesh.region[inside[0]]) return false;
    if (std::binary_search(inside.begin(), inside.end(), c)) continue;
    Corners<2> corners = mesh.cells[c];
    for (VertexId& v : corners) {
      const Index i = classes.index(v);
      if (i != kNone) v = merged[classes.root(i)].keep;
    }
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j)
        if (corners[i] == corners[j]) return false;
    cavity.new_cells.push_back(corners);
  }
  return !cavity.new_cells.empty();
}

}  // namespace pillowmesh
