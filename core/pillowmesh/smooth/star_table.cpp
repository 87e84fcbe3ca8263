#include "pillowmesh/smooth/star_table.h"

#include <algorithm>

#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {
namespace {

using C = Cell<3>;

/// Finds w in `spokes` from `first` on, or appends it. \return its position relative to `first`
std::int16_t position_of(std::vector<VertexId>& spokes, std::size_t first, VertexId w) {
  const auto found = std::find(spokes.begin() + static_cast<std::ptrdiff_t>(first), spokes.end(), w);
  const auto at = found - spokes.begin() - static_cast<std::ptrdiff_t>(first);
  if (found == spokes.end()) spokes.push_back(w);
  return static_cast<std::int16_t>(at);
}

}  // namespace

StarTable::StarTable(const Mesh<3>& mesh) {
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  start_.reserve(vertices + 1);
  spokes_.reserve(6 * vertices);
  facets_.reserve(12 * vertices);
  corners_.reserve(8 * vertices);
  std::vector<CellCorner> star;
  const auto mark = [&] {
    start_.push_back({static_cast<std::uint32_t>(spokes_.size()), static_cast<std::uint32_t>(facets_.size()),
                      static_cast<std::uint32_t>(corners_.size())});
  };
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    mark();
    if (mesh.support[v].dim == 0) continue;  // stays where it is
    vertex_star(mesh, v, star);
    const auto [first_spoke, first_facet, first_corner] = start_.back();
    for (const auto& [c, k] : star) {
      // Right-handed in the order of the axes, or with the last two exchanged.
      const std::array<int, 3> axis = C::corner_sign(k) > 0 ? std::array{0, 1, 2} : std::array{0, 2, 1};
      StarCorner corner{};
      for (int j = 0; j < 3; ++j)
        corner.spoke[j] = position_of(spokes_, first_spoke, mesh.cells[c][k ^ (1 << axis[j])]);
      for (int j = 0; j < 3; ++j) {
        const int next = (j + 1) % 3;
        const std::int16_t a = corner.spoke[j], b = corner.spoke[next];
        std::size_t q = first_facet;
        while (q < facets_.size() && !(facets_[q].a == a && facets_[q].b == b) &&
               !(facets_[q].a == b && facets_[q].b == a))
          ++q;
        if (q == facets_.size()) facets_.push_back({mesh.cells[c][k ^ (1 << axis[j]) ^ (1 << axis[next])], a, b});
        const auto edge = static_cast<std::int16_t>(2 * (q - first_facet));
        const bool forward = facets_[q].a == a;
        corner.outer[j][0] = static_cast<std::int16_t>(edge + (forward ? 0 : 1));
        corner.outer[next][1] = static_cast<std::int16_t>(edge + (forward ? 1 : 0));
      }
      corners_.push_back(corner);
    }
  }
  mark();
}

}  // namespace pillowmesh
