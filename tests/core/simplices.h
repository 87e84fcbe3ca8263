// Properties that a background of simplices must have.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "pillowmesh/metric/nodal.h"

namespace checks {

using namespace pillowmesh;

/// Every facet belongs to two simplices, or to one when it lies on a side of the box from (low, ...) to (high, ...).
template <int Dim>
bool conforming(const NodalMetric<Dim>& m, double low = 0.0, double high = 1.0) {
  std::vector<std::array<VertexId, Dim>> facets;
  for (const Simplex<Dim>& s : m.simplices)
    for (int f = 0; f <= Dim; ++f) {
      std::array<VertexId, Dim> v;
      for (int k = 0; k < Dim; ++k) v[k] = s[(f + 1 + k) % (Dim + 1)];
      std::sort(v.begin(), v.end());
      facets.push_back(v);
    }
  std::sort(facets.begin(), facets.end());
  const auto on_a_side = [&](const std::array<VertexId, Dim>& facet) {
    for (int d = 0; d < Dim; ++d)
      for (const double side : {low, high})
        if (std::all_of(facet.begin(), facet.end(), [&](VertexId v) { return m.points[v][d] == side; })) return true;
    return false;
  };
  for (auto first = facets.begin(); first != facets.end();) {
    const auto next = std::find_if(first, facets.end(), [&](const auto& f) { return f != *first; });
    if (next - first != (on_a_side(*first) ? 1 : 2)) return false;
    first = next;
  }
  return !facets.empty();
}

}  // namespace checks
