#include "pillowmesh/refine/dice.h"

#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/overlap.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/mesh/topology.h"

namespace pillowmesh {
namespace {

/// Numbers the lattice points of the cells so that neighbours share those of their common edges and facets.
template <int Dim>
class Lattice {
 public:
  using C = Cell<Dim>;

  Lattice(const Mesh<Dim>& mesh, int n) : mesh_(mesh), n_(n) {}

  /// Lattice points of all cells: (n + 1)^Dim vertex numbers per cell, axis 0 fastest.
  void number(std::vector<VertexId>& lattice, Mesh<Dim>& out) {
    std::size_t per_cell = 1;
    for (int d = 0; d < Dim; ++d) {
      stride_[d] = static_cast<int>(per_cell);
      per_cell *= n_ + 1;
    }
    lattice.assign(per_cell * mesh_.cells.size(), kNone);
    for (CellId c = 0; c < mesh_.cell_count(); ++c) {
      VertexId* own = lattice.data() + per_cell * c;
      for (int i = 0; i < static_cast<int>(per_cell); ++i) {
        std::array<int, Dim> at;
        int inner = 0, axis = 0, corner = 0;
        for (int d = 0; d < Dim; ++d) {
          at[d] = i / stride_[d] % (n_ + 1);
          if (at[d] != 0 && at[d] != n_) {
            ++inner;
            axis = d;
          } else if (at[d] == n_) {
            corner |= 1 << d;
          }
        }
        if (inner == 0) {
          own[i] = mesh_.cells[c][corner];
        } else if (own[i] == kNone) {
          own[i] = add(c, at, inner, axis, corner, out);
          if (inner == 1) spread_edge(lattice, per_cell, c, {c, C::edge_at(corner, axis)}, at[axis], own[i]);
          if (Dim == 3 && inner == 2) spread_facet(lattice, per_cell, c, at, own[i]);
        }
      }
    }
  }

  [[nodiscard]] int stride(int d) const { return stride_[d]; }

 private:
  VertexId add(CellId c, const std::array<int, Dim>& at, int inner, int axis, int corner, Mesh<Dim>& out) const {
    Point<Dim> p = Point<Dim>::Zero();
    for (int k = 0; k < C::corners; ++k) {
      double weight = 1.0;
      for (int d = 0; d < Dim; ++d) weight *= (k >> d) & 1 ? at[d] / double(n_) : (n_ - at[d]) / double(n_);
      p += weight * mesh_.points[mesh_.cells[c][k]];
    }
    VertexSupport support{Dim, kNone};
    if (inner < Dim) support = entity_support(c, at, inner, axis, corner);
    Index anchor = kNone;
    if (support.dim < Dim) {
      anchor = anchor_on(mesh_, support, mesh_.cells[c][corner], p);
      p = slide(*mesh_.geometry, support, anchor, p);
    }
    out.points.push_back(p);
    out.support.push_back(support);
    out.anchor.push_back(anchor);
    return static_cast<VertexId>(out.points.size() - 1);
  }

  /// Support of a lattice point inside an edge or facet of the cell.
  VertexSupport entity_support(CellId c, const std::array<int, Dim>& at, int inner, int axis, int corner) const {
    if (inner == Dim - 1) {
      for (int d = 0; d < Dim; ++d) {
        const int f = C::facet(d, at[d] == n_);
        if ((at[d] == 0 || at[d] == n_) && mesh_.on_boundary(c, f)) return {Dim - 1, mesh_.patch_of(c, f)};
      }
      return {Dim, kNone};
    }
    // An edge of a hex: on no patch, one, or on the curve between two.
    PatchId first = kNone, second = kNone;
    for_each_cell_at_edge(mesh_, {c, C::edge_at(corner, axis)}, [&](CellId n, int e) {
      for (int d = 0; d < Dim; ++d) {
        const int f = C::facet(d, (C::edge_from(e) >> d) & 1);
        if (d != C::edge_axis(e) && mesh_.on_boundary(n, f)) (first == kNone ? first : second) = mesh_.patch_of(n, f);
      }
    });
    if (first == kNone) return {Dim, kNone};
    if (second == kNone || first == second) return {Dim - 1, first};
    const VertexSupport a = mesh_.support[mesh_.cells[c][corner]], b = mesh_.support[mesh_.cells[c][corner ^ (1 << axis)]];
    if (a.dim == 1) return a;
    if (b.dim == 1) return b;
    // Both ends are corners: the curve of these two patches that has both as its ends is the only candidate.
    const std::array<PatchId, 2> pair{std::min(first, second), std::max(first, second)};
    const auto& curves = mesh_.geometry->curve_patches;
    for (Index i = 0; i < static_cast<Index>(curves.size()); ++i)
      if (curves[i] == pair) return {1, i};
    return {0, kNone};
  }

  void spread_edge(std::vector<VertexId>& lattice, std::size_t per_cell, CellId from, CellEdge edge, int steps,
                   VertexId v) const {
    const VertexId start = mesh_.cells[from][C::edge_from(edge.edge)];
    for_each_cell_at_edge(mesh_, edge, [&](CellId n, int e) {
      const int k = C::edge_from(e), axis = C::edge_axis(e);
      std::size_t i = 0;
      for (int d = 0; d < Dim; ++d)
        i += static_cast<std::size_t>(stride_[d]) *
             (d == axis ? (mesh_.cells[n][k] == start ? steps : n_ - steps) : ((k >> d) & 1) * n_);
      lattice[per_cell * n + i] = v;
    });
  }

  void spread_facet(std::vector<VertexId>& lattice, std::size_t per_cell, CellId c, const std::array<int, Dim>& at,
                    VertexId v) const {
    int normal = 0;
    for (int d = 0; d < Dim; ++d)
      if (at[d] == 0 || at[d] == n_) normal = d;
    const int f = C::facet(normal, at[normal] == n_);
    if (mesh_.on_boundary(c, f)) return;
    const CellId n = mesh_.neighbour(c, f);
    // The neighbour's lattice coordinates from where it has the facet's corner 0 and the two beside it.
    const int origin = C::facet_corner(f, 0);
    const int there = corner_of(mesh_, n, mesh_.cells[c][origin]);
    std::array<int, Dim> coordinate;
    for (int d = 0; d < Dim; ++d) coordinate[d] = ((there >> d) & 1) * n_;
    for (int d = 0; d < Dim; ++d) {
      if (d == normal) continue;
      const int step = there ^ corner_of(mesh_, n, mesh_.cells[c][origin ^ (1 << d)]);
      for (int a = 0; a < Dim; ++a)
        if (step == 1 << a) coordinate[a] += (there & step) ? -at[d] : at[d];
    }
    std::size_t i = 0;
    for (int d = 0; d < Dim; ++d) i += static_cast<std::size_t>(stride_[d]) * coordinate[d];
    lattice[per_cell * n + i] = v;
  }

  const Mesh<Dim>& mesh_;
  int n_;
  std::array<int, Dim> stride_{};
};

}  // namespace

template <int Dim>
Status dice(Mesh<Dim>& mesh, int n) {
  using C = Cell<Dim>;
  if (n <= 1) return {};
  Mesh<Dim> out;
  out.points = mesh.points;
  out.support = mesh.support;
  out.anchor = mesh.anchor;
  std::vector<VertexId> lattice;
  Lattice<Dim> numbering(mesh, n);
  numbering.number(lattice, out);

  int pieces = 1;
  for (int d = 0; d < Dim; ++d) pieces *= n;
  const std::size_t per_cell = lattice.size() / mesh.cells.size();
  struct Patch {
    CellId cell;
    int facet;
    PatchId patch;
  };
  std::vector<Patch> patches;
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    for (int piece = 0; piece < pieces; ++piece) {
      std::size_t base = 0;
      const CellId id = static_cast<CellId>(out.cells.size());
      for (int d = 0, rest = piece; d < Dim; ++d, rest /= n) {
        const int i = rest % n;
        base += static_cast<std::size_t>(i) * numbering.stride(d);
        for (int side = 0; side < 2; ++side)
          if (i == (side ? n - 1 : 0) && mesh.on_boundary(c, C::facet(d, side)))
            patches.push_back({id, C::facet(d, side), mesh.patch_of(c, C::facet(d, side))});
      }
      Corners<Dim> corners;
      for (int k = 0; k < C::corners; ++k) {
        std::size_t i = base;
        for (int d = 0; d < Dim; ++d) i += static_cast<std::size_t>((k >> d) & 1) * numbering.stride(d);
        corners[k] = lattice[per_cell * c + i];
      }
      out.cells.push_back(corners);
      out.region.push_back(mesh.region[c]);
      if (!(min_corner_jacobian(out, id) > 0))
        return Status::illegal("a piece of cell " + std::to_string(c) + " would be inside out");
    }
  if (Status s = connect_cells(out); !s.ok()) return s;
  for (const Patch& p : patches) out.twins[p.cell][p.facet] = ~p.patch;
  out.geometry = mesh.geometry;
  if constexpr (Dim == 2) {  // where an edge spans a corner of its curve, the vertex in its middle may lie beyond its neighbours
    OrderedStar star;
    for (VertexId v = 0; v < out.vertex_count(); ++v)
      if (out.support[v].dim < 2 && find_star(out, v, star) && overlaps(out, v, star))
        return Status::illegal("the pieces at vertex " + std::to_string(v) + " would overlap");
  }
  out.patch_groups = std::move(mesh.patch_groups);
  out.region_groups = std::move(mesh.region_groups);
  mesh = std::move(out);
  return {};
}

template Status dice(Mesh<2>&, int);
template Status dice(Mesh<3>&, int);

}  // namespace pillowmesh
