#include "pillowmesh/refine/balance.h"

#include <bit>

namespace pillowmesh {
namespace {

/// The edge masks of the quadrilaterals to which the rule applies.
template <int Dim>
constexpr auto quadrilaterals() {
  using Mask = typename EdgeTags<Dim>::Mask;
  if constexpr (Dim == 2) {
    return std::array<Mask, 1>{EdgeTags<2>::all};
  } else {
    std::array<Mask, 6> masks{};
    for (int f = 0; f < 6; ++f) masks[f] = facet_edges<3>(f);
    return masks;
  }
}

}  // namespace

template <int Dim>
Index balance_tags(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, std::span<const CellId> touched) {
  constexpr auto quads = quadrilaterals<Dim>();
  Index added = 0;
  std::vector<CellId> stack(touched.begin(), touched.end());
  while (!stack.empty()) {
    const CellId c = stack.back();
    stack.pop_back();
    for (const auto quad : quads) {
      const unsigned tagged = tags.mask[c] & quad;
      if (std::popcount(tagged) <= 2 || tagged == quad) continue;
      for (int e = 0; e < Cell<Dim>::edges; ++e) {
        if (!((quad >> e) & 1) || tags.has(c, e)) continue;
        set_tag(mesh, tags, {c, e});
        ++added;
        for_each_cell_at_edge(mesh, {c, e}, [&](CellId n, int) { stack.push_back(n); });
      }
    }
  }
  return added;
}

template Index balance_tags(const Mesh<2>&, EdgeTags<2>&, std::span<const CellId>);
template Index balance_tags(const Mesh<3>&, EdgeTags<3>&, std::span<const CellId>);

}  // namespace pillowmesh
