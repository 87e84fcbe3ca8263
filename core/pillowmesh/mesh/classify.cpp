#include "pillowmesh/mesh/classify.h"

#include <algorithm>
#include <cmath>

namespace pillowmesh {
namespace {

/// A side of a boundary facet: an end point in 2D, an edge in 3D, by its sorted vertices.
template <int Dim>
struct Side {
  std::array<VertexId, Dim - 1> key;
  Index facet;
  int side;
};

template <int Dim>
struct Surface {
  std::vector<std::array<Index, 2>> half_facet;  // cell, facet
  std::vector<FacetCorners<Dim>> vertices;
  std::vector<Index> group;
  std::vector<Point<Dim>> normal;
  std::vector<Side<Dim>> sides;  // sorted: the two facets at a side are neighbours
};

/// Vector along the outward normal; length = area in 3D, length in 2D.
Point<2> outward(const std::vector<Point<2>>& p, const FacetCorners<2>& v, int sign) {
  const Point<2> e = p[v[1]] - p[v[0]];
  return Point<2>(sign * e[1], -sign * e[0]);
}
Point<3> outward(const std::vector<Point<3>>& p, const FacetCorners<3>& v, int sign) {
  const Point<3> a = p[v[3]] - p[v[0]], b = p[v[2]] - p[v[1]];
  return 0.5 * sign * Point<3>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

template <int Dim>
std::array<VertexId, Dim - 1> side_key(const FacetCorners<Dim>& v, int side) {
  if constexpr (Dim == 2) return {v[side]};
  if constexpr (Dim == 3) {
    const VertexId a = v[Cell<2>::facet_corner(side, 0)], b = v[Cell<2>::facet_corner(side, 1)];
    return {std::min(a, b), std::max(a, b)};
  }
}

template <int Dim>
Surface<Dim> collect_surface(const Mesh<Dim>& mesh, const MeshInput<Dim>& input) {
  struct Named {
    FacetCorners<Dim> key;
    std::size_t place;  // in the input: of a facet given twice, the first counts
  };
  std::vector<Named> named;
  for (std::size_t i = 0; i < input.facets.size(); ++i) {
    Named n{input.facets[i].vertices, i};
    std::sort(n.key.begin(), n.key.end());
    named.push_back(n);
  }
  std::sort(named.begin(), named.end(),
            [](const Named& a, const Named& b) { return a.key != b.key ? a.key < b.key : a.place < b.place; });

  Surface<Dim> surface;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; f < Cell<Dim>::facets; ++f) {
      if (!mesh.on_boundary(c, f)) continue;
      const Index i = static_cast<Index>(surface.vertices.size());
      const auto v = mesh.facet_vertices(c, f);
      surface.half_facet.push_back({c, f});
      surface.vertices.push_back(v);
      surface.normal.push_back(outward(mesh.points, v, facet_sign<Dim>(f)));
      auto key = v;
      std::sort(key.begin(), key.end());
      const auto at =
          std::lower_bound(named.begin(), named.end(), key, [](const Named& a, const auto& k) { return a.key < k; });
      surface.group.push_back(at != named.end() && at->key == key ? input.facets[at->place].group : kNone);
      for (int s = 0; s < Geometry<Dim>::facet_sides; ++s) surface.sides.push_back({side_key<Dim>(v, s), i, s});
    }
  std::sort(surface.sides.begin(), surface.sides.end(), [](const Side<Dim>& a, const Side<Dim>& b) {
    return a.key != b.key ? a.key < b.key : (a.facet != b.facet ? a.facet < b.facet : a.side < b.side);
  });
  return surface;
}

/// Neighbours of the same patch, and the sides where patches part.
template <int Dim>
void find_features(const MeshInput<Dim>& input, const BoundaryOptions& options,
                   const Surface<Dim>& surface, Geometry<Dim>& geometry, std::vector<Side<Dim>>& features) {
  std::vector<std::array<VertexId, Dim - 1>> pinned;  // sides that the file names as corners or ridges
  if constexpr (Dim == 2)
    for (const VertexId v : input.corners) pinned.push_back({v});
  else
    for (const auto& r : input.ridges) pinned.push_back({std::min(r[0], r[1]), std::max(r[0], r[1])});
  std::sort(pinned.begin(), pinned.end());

  std::array<Index, Geometry<Dim>::facet_sides> none;
  none.fill(kNone);
  geometry.neighbours.assign(surface.vertices.size(), none);
  for (std::size_t i = 0; i + 1 < surface.sides.size(); ++i) {
    const auto& a = surface.sides[i];
    const auto& b = surface.sides[i + 1];
    if (a.key != b.key) continue;
    const Point<Dim>&na = surface.normal[a.facet], &nb = surface.normal[b.facet];
    const bool turns = na.dot(nb) < options.corner_cosine * std::sqrt(na.squaredNorm() * nb.squaredNorm());
    if (turns || surface.group[a.facet] != surface.group[b.facet] ||
        std::binary_search(pinned.begin(), pinned.end(), a.key)) {
      features.push_back(a);
    } else {
      geometry.neighbours[a.facet][a.side] = b.facet;
      geometry.neighbours[b.facet][b.side] = a.facet;
    }
    ++i;
  }
}

template <int Dim>
void flood_patches(Mesh<Dim>& mesh, const MeshInput<Dim>& input, const Surface<Dim>& surface,
                   Geometry<Dim>& geometry) {
  geometry.patch.assign(surface.vertices.size(), kNone);
  mesh.patch_groups.clear();
  std::vector<Index> stack;
  for (Index seed = 0; seed < static_cast<Index>(surface.vertices.size()); ++seed) {
    if (geometry.patch[seed] != kNone) continue;
    const PatchId patch = static_cast<PatchId>(mesh.patch_groups.size());
    const Index g = surface.group[seed];
    mesh.patch_groups.push_back(g == kNone ? Group{} : input.facet_groups[g]);
    geometry.patch[seed] = patch;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const Index i = stack.back();
      stack.pop_back();
      mesh.twins[surface.half_facet[i][0]][surface.half_facet[i][1]] = ~patch;
      for (const Index n : geometry.neighbours[i])
        if (n != kNone && geometry.patch[n] == kNone) {
          geometry.patch[n] = patch;
          stack.push_back(n);
        }
    }
  }
}

/// 3D: chains feature edges into curves; vertices where chains end, fork or turn sharply become corners.
void chain_curves(Mesh<3>& mesh, const BoundaryOptions& options, const std::vector<Side<3>>& features,
                  Geometry<3>& geometry, const std::vector<PatchId>& other_patch) {
  std::vector<std::array<VertexId, 2>> ends;
  for (const auto& f : features) ends.push_back(f.key);
  std::vector<std::array<Index, 2>> at_vertex;  // vertex, segment
  for (Index s = 0; s < static_cast<Index>(ends.size()); ++s)
    for (const VertexId v : ends[s]) at_vertex.push_back({v, s});
  std::sort(at_vertex.begin(), at_vertex.end());
  const auto patches = [&](Index s) {
    const PatchId a = geometry.patch[features[s].facet], b = other_patch[s];
    return std::array<PatchId, 2>{std::min(a, b), std::max(a, b)};
  };
  geometry.segments = ends;  // renumbered by the caller
  geometry.segment_neighbours.assign(ends.size(), {kNone, kNone});
  for (std::size_t i = 0; i < at_vertex.size();) {
    std::size_t j = i;
    while (j < at_vertex.size() && at_vertex[j][0] == at_vertex[i][0]) ++j;
    const VertexId v = at_vertex[i][0];
    bool corner = j - i != 2 || mesh.support[v].dim == 0;
    if (!corner) {
      const Index s = at_vertex[i][1], t = at_vertex[i + 1][1];
      const VertexId a = ends[s][0] == v ? ends[s][1] : ends[s][0], b = ends[t][0] == v ? ends[t][1] : ends[t][0];
      const Point<3> in = mesh.points[v] - mesh.points[a], out = mesh.points[b] - mesh.points[v];
      corner = patches(s) != patches(t) ||
               in.dot(out) < options.corner_cosine * std::sqrt(in.squaredNorm() * out.squaredNorm());
      if (!corner) {
        geometry.segment_neighbours[s][ends[s][0] == v ? 0 : 1] = t;
        geometry.segment_neighbours[t][ends[t][0] == v ? 0 : 1] = s;
      }
    }
    mesh.support[v] = {static_cast<std::int8_t>(corner ? 0 : 1), kNone};
    i = j;
  }
  geometry.curve.assign(ends.size(), kNone);
  std::vector<Index> stack;
  for (Index seed = 0; seed < static_cast<Index>(ends.size()); ++seed) {
    if (geometry.curve[seed] != kNone) continue;
    const Index curve = static_cast<Index>(geometry.curve_patches.size());
    geometry.curve_patches.push_back(patches(seed));
    geometry.curve[seed] = curve;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const Index s = stack.back();
      stack.pop_back();
      for (const VertexId v : ends[s]) {
        if (mesh.support[v].dim != 1) continue;
        mesh.support[v].entity = curve;
        mesh.anchor[v] = s;
      }
      for (const Index n : geometry.segment_neighbours[s])
        if (n != kNone && geometry.curve[n] == kNone) {
          geometry.curve[n] = curve;
          stack.push_back(n);
        }
    }
  }
}

}  // namespace

template <int Dim>
void classify_boundary(Mesh<Dim>& mesh, const MeshInput<Dim>& input, const BoundaryOptions& options) {
  const Surface<Dim> surface = collect_surface(mesh, input);
  auto geometry = std::make_shared<Geometry<Dim>>();
  std::vector<Side<Dim>> features;
  find_features(input, options, surface, *geometry, features);
  flood_patches(mesh, input, surface, *geometry);

  mesh.support.assign(mesh.points.size(), {Dim, kNone});
  mesh.anchor.assign(mesh.points.size(), kNone);
  for (Index i = 0; i < static_cast<Index>(surface.vertices.size()); ++i)
    for (const VertexId v : surface.vertices[i]) {
      mesh.support[v] = {Dim - 1, geometry->patch[i]};
      mesh.anchor[v] = i;
    }
  for (const VertexId v : input.corners)
    if (mesh.support[v].dim < Dim) mesh.support[v] = {0, kNone};
  if constexpr (Dim == 2) {
    for (const auto& f : features) mesh.support[f.key[0]] = {0, kNone};
  } else {
    std::vector<PatchId> other_patch;
    for (const auto& f : features) {
      const auto pair = std::equal_range(surface.sides.begin(), surface.sides.end(), f,
                                         [](const auto& a, const auto& b) { return a.key < b.key; });
      other_patch.push_back(geometry->patch[(pair.first + 1)->facet]);
    }
    chain_curves(mesh, options, features, *geometry, other_patch);
  }

  // The geometry keeps its own copy of the boundary vertices.
  std::vector<Index> own(mesh.points.size(), kNone);
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    FacetCorners<Dim> facet = surface.vertices[i];
    for (VertexId& v : facet) {
      if (own[v] == kNone) {
        own[v] = static_cast<Index>(geometry->points.size());
        geometry->points.push_back(mesh.points[v]);
      }
      v = own[v];
    }
    geometry->facets.push_back(facet);
    geometry->sign.push_back(static_cast<std::int8_t>(facet_sign<Dim>(surface.half_facet[i][1])));
  }
  for (auto& s : geometry->segments) s = {own[s[0]], own[s[1]]};
  mesh.geometry = std::move(geometry);
}

template void classify_boundary(Mesh<2>&, const MeshInput<2>&, const BoundaryOptions&);
template void classify_boundary(Mesh<3>&, const MeshInput<3>&, const BoundaryOptions&);

}  // namespace pillowmesh
