#include "pillowmesh/mesh/smooth_geometry.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/circle_fit.h"
#include "pillowmesh/mesh/jacobian.h"

namespace pillowmesh {
namespace {

constexpr double kStraight = 1e-9;  ///< a bend smaller than this, of the chord, is none

template <int Dim>
Point<Dim> unit(const Point<Dim>& p) {
  const double length = std::sqrt(p.squaredNorm());
  return length > 0 ? Point<Dim>(p / length) : p;
}

/// The cubic over chord e that leaves along unit vector a and arrives along b: slopes as long as those of an arc.
template <int Dim>
Bend<Dim> bend_of(const Point<Dim>& e, const Point<Dim>& a, const Point<Dim>& b) {
  const double length = std::sqrt(e.squaredNorm());
  const auto slope = [&](const Point<Dim>& t) {
    return Point<Dim>(2 * length / (1 + std::max(0.0, t.dot(e) / length)) * t - e);
  };
  const Bend<Dim> bend{slope(a), slope(b)};
  const double most = std::max(bend.from.squaredNorm(), bend.to.squaredNorm());
  return most > kStraight * kStraight * e.squaredNorm() ? bend : Bend<Dim>{};
}

/// Unit tangents at the vertices of a chain, in its direction.
template <int Dim>
std::vector<Point<Dim>> tangents_of(const std::vector<Point<Dim>>& points, const Chain& chain) {
  const Index n = static_cast<Index>(chain.vertices.size());
  const auto at = [&](Index k) -> const Point<Dim>& { return points[chain.vertex(k)]; };
  // Inversion at a vertex makes a line of the circle through it, parallel to the tangent there.
  const auto inverted = [](const Point<Dim>& d) { return Point<Dim>(d / d.squaredNorm()); };
  std::vector<Point<Dim>> tangent(n);
  for (Index k = 0; k < n; ++k) {
    if (n == 2)
      tangent[k] = unit<Dim>(at(1) - at(0));
    else if (chain.closed || (k > 0 && k + 1 < n))
      tangent[k] = unit<Dim>(inverted(at(k + 1) - at(k)) + inverted(at(k) - at(k - 1)));
    else if (k == 0)
      tangent[k] = unit<Dim>(inverted(at(1) - at(0)) - inverted(at(2) - at(0)));
    else
      tangent[k] = unit<Dim>(inverted(at(k) - at(k - 1)) - inverted(at(k) - at(k - 2)));
  }
  // Where two pieces are in line the line goes on to their ends.
  for (Index k = chain.closed ? 0 : 1; k < (chain.closed ? n : n - 1); ++k) {
    const Point<Dim> in = at(k) - at(k - 1), out = at(k + 1) - at(k);
    const Point<Dim> off = out - out.dot(tangent[k]) * tangent[k];
    if (!(off.squaredNorm() <= 1e-14 * out.squaredNorm() && in.dot(out) > 0)) continue;
    tangent[(k + n - 1) % n] = tangent[(k + 1) % n] = tangent[k];
  }
  return tangent;
}

template <int Dim>
void bend_chain(const std::vector<Point<Dim>>& points, const Chain& chain, const std::vector<Point<Dim>>& tangent,
                const std::vector<std::array<Index, 2>>& ends, const auto& set) {
  const Index n = static_cast<Index>(chain.vertices.size());
  for (Index k = 0; k < static_cast<Index>(chain.pieces.size()); ++k) {
    const Index piece = chain.pieces[k];
    Point<Dim> a = tangent[k], b = tangent[(k + 1) % n];
    if (chain.reversed[k]) {
      std::swap(a, b);
      a = -a;
      b = -b;
    }
    set(piece, bend_of<Dim>(points[ends[piece][1]] - points[ends[piece][0]], a, b));
  }
}

void smooth(Geometry<2>& g) {
  g.bends.resize(g.facets.size());
  g.circle.assign(g.facets.size(), kNone);
  for (const Chain& chain : find_chains(g.facets, g.neighbours)) {
    const Index n = static_cast<Index>(chain.vertices.size());
    auto tangent = tangents_of<2>(g.points, chain);
    for (const CircleRun& run : find_circles(g.points, chain)) {
      for (Index k = run.first; k < run.first + run.count; ++k) {
        const Point<2> out = g.points[chain.vertex(k)] - run.circle.centre;
        Point<2>& t = tangent[k % n];
        const Point<2> turned = unit<2>(Point<2>(-out[1], out[0]));
        t = turned.dot(t) > 0 ? turned : Point<2>(-turned);
      }
      const Index arcs = chain.closed && run.count == n ? n : run.count - 1;
      for (Index k = 0; k < arcs; ++k)
        g.circle[chain.pieces[(run.first + k) % chain.pieces.size()]] = static_cast<Index>(g.circles.size());
      g.circles.push_back(run.circle);
    }
    bend_chain<2>(g.points, chain, tangent, g.facets, [&](Index i, const Bend<2>& bend) { g.bends[i][0] = bend; });
  }
}

/// The mean of the unit normals of a patch's facets at each of its vertices, by patch and vertex.
struct VertexNormals {
  struct Entry {
    PatchId patch;
    Index vertex;
    Point<3> normal;
  };
  std::vector<Entry> entries;  // sorted, one per patch and vertex

  explicit VertexNormals(const Geometry<3>& g) {
    for (std::size_t i = 0; i < g.facets.size(); ++i) {
      const auto& f = g.facets[i];
      for (int k = 0; k < 4; ++k) {
        const Point<3>&p = g.points[f[k]], a = g.points[f[k ^ 1]] - p, b = g.points[f[k ^ 2]] - p;
        const double sign = g.sign[i] * (k == 0 || k == 3 ? 1.0 : -1.0);
        entries.push_back({g.patch[i], f[k], sign * unit<3>(vector_product(a, b))});
      }
    }
    std::stable_sort(entries.begin(), entries.end(), before);
    std::size_t last = 0;
    for (std::size_t i = 1; i < entries.size(); ++i) {
      if (!before(entries[last], entries[i]))
        entries[last].normal += entries[i].normal;
      else
        entries[++last] = entries[i];
    }
    entries.resize(entries.empty() ? 0 : last + 1);
    for (Entry& e : entries) e.normal = unit<3>(e.normal);
  }
  [[nodiscard]] const Point<3>& at(PatchId patch, Index vertex) const {
    return std::lower_bound(entries.begin(), entries.end(), Entry{patch, vertex, {}}, before)->normal;
  }

 private:
  static bool before(const Entry& a, const Entry& b) {
    return a.patch != b.patch ? a.patch < b.patch : a.vertex < b.vertex;
  }
};

void smooth(Geometry<3>& g) {
  g.segment_bends.resize(g.segments.size());
  for (const Chain& chain : find_chains(g.segments, g.segment_neighbours))
    bend_chain<3>(g.points, chain, tangents_of<3>(g.points, chain), g.segments,
                  [&](Index i, const Bend<3>& bend) { g.segment_bends[i] = bend; });
  std::vector<std::array<Index, 3>> features;  // sorted ends, segment
  for (Index s = 0; s < static_cast<Index>(g.segments.size()); ++s) {
    const auto [low, high] = std::minmax(g.segments[s][0], g.segments[s][1]);
    features.push_back({low, high, s});
  }
  std::sort(features.begin(), features.end());

  const VertexNormals normals(g);
  g.bends.resize(g.facets.size());
  for (std::size_t i = 0; i < g.facets.size(); ++i)
    for (int side = 0; side < 4; ++side) {
      const Index a = g.facets[i][Cell<2>::facet_corner(side, 0)], b = g.facets[i][Cell<2>::facet_corner(side, 1)];
      const auto feature =
          std::lower_bound(features.begin(), features.end(), std::array<Index, 3>{std::min(a, b), std::max(a, b), 0});
      Bend<3>& bend = g.bends[i][side];
      if (feature != features.end() && (*feature)[0] == std::min(a, b) && (*feature)[1] == std::max(a, b)) {
        bend = g.segment_bends[(*feature)[2]];
        if (g.segments[(*feature)[2]][0] != a) bend = {-bend.to, -bend.from};
        continue;
      }
      const Point<3> e = g.points[b] - g.points[a];
      const auto in_plane = [&](Index v) {
        const Point<3>& n = normals.at(g.patch[i], v);
        return unit<3>(e - e.dot(n) * n);
      };
      bend = bend_of<3>(e, in_plane(a), in_plane(b));
    }
}

}  // namespace

template <int Dim>
std::shared_ptr<const Geometry<Dim>> smooth_geometry(std::shared_ptr<const Geometry<Dim>> geometry) {
  if (!geometry || !geometry->bends.empty()) return geometry;
  auto curved = std::make_shared<Geometry<Dim>>(*geometry);
  smooth(*curved);
  return curved;
}

template std::shared_ptr<const Geometry<2>> smooth_geometry(std::shared_ptr<const Geometry<2>>);
template std::shared_ptr<const Geometry<3>> smooth_geometry(std::shared_ptr<const Geometry<3>>);

}  // namespace pillowmesh
