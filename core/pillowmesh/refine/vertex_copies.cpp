#include "pillowmesh/refine/vertex_copies.h"

#include <algorithm>
#include <cmath>

#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/refine/pinched_edges.h"

namespace pillowmesh {
namespace {

int find_root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

void unite(std::vector<int>& parent, int i, int j) {
  i = find_root(parent, i);
  j = find_root(parent, j);
  parent[std::max(i, j)] = std::min(i, j);
}

template <int Dim>
class VertexPlanner {
 public:
  using C = Cell<Dim>;

  VertexPlanner(const Mesh<Dim>& mesh, const Hull<Dim>& hull, double shrink, CopyPlan<Dim>& plan)
      : mesh_(mesh), hull_(hull), shrink_(shrink), plan_(plan), star_(plan.star), component_(plan.component),
        normals_(plan.normals) {}

  Status run(VertexId v) {
    vertex_star(mesh_, v, star_);
    if (!find_components(v))
      return Status::illegal("the shrink set touches itself at an edge of vertex " + std::to_string(v) +
                             " where neither it nor the rest can be joined");
    // The first component outside keeps v; where there is none v is left to the hull on the boundary, if any.
    bool kept = false;
    for (int i = 0; i < static_cast<int>(star_.size()); ++i) {
      if (component_[i] != i) continue;
      const bool inside = hull_.in_set[star_[i].cell];
      if (!inside && !kept) {
        kept = true;
        continue;
      }
      if (Status s = copy(v, i, inside); !s.ok()) return s;
    }
    return {};
  }

 private:
  /// False if the runs of one side at a pinched edge cannot be kept apart.
  bool find_components(VertexId v) {
    const int n = static_cast<int>(star_.size());
    component_.resize(n);
    for (int i = 0; i < n; ++i) component_[i] = i;
    int hull_facets = 0;
    plan_.pinched_here = false;
    for (int i = 0; i < n; ++i) {
      const auto [c, corner] = star_[i];
      for (int axis = 0; axis < Dim; ++axis) {
        const int f = C::facet(axis, (corner >> axis) & 1);
        const CellId neighbour = mesh_.neighbour(c, f);
        if (neighbour == kNone) continue;
        if (hull_.in_set[neighbour] != hull_.in_set[c]) {
          ++hull_facets;
          continue;
        }
        unite(component_, i, position_of(neighbour));
      }
    }
    if constexpr (Dim == 2) {
      // The outside is joined across v; at a boundary vertex too, so that the shrink set lets go of the boundary there.
      if (hull_facets / 2 >= 2) unite_side(false);
    } else {
      pinched_edges_at(mesh_, hull_, v, star_, [&](VertexId w, bool join_inside, const EdgeRing& ring) {
        int first = -1;
        for (const CellEdge& r : ring.cells) {
          if ((hull_.in_set[r.cell] != 0) != join_inside) continue;
          const int at = position_of(r.cell);
          if (first >= 0) unite(component_, first, at);
          first = at;
        }
        plan_.pinched_here = true;
        if (join_inside) plan_.kept_inside.push_back({std::min(v, w), std::max(v, w)});
      });
    }
    for (int i = 0; i < n; ++i) component_[i] = find_root(component_, i);
    bool apart = true;
    if constexpr (Dim == 3) {
      if (plan_.pinched_here)
        pinched_edges_at(mesh_, hull_, v, star_, [&](VertexId, bool join_inside, const EdgeRing& ring) {
          if (!apart || runs_apart(!join_inside, ring)) return;
          apart = false;
          shortest_run_outside(hull_, ring, plan_.parting);
        });
    }
    return apart;
  }

  /// True if the runs of cells of one side around an edge are of different components at the vertex.
  bool runs_apart(bool inside, const EdgeRing& ring) const {
    const std::size_t n = ring.cells.size();
    plan_.runs.clear();
    for (std::size_t i = 0; i < n; ++i) {
      if ((hull_.in_set[ring.cells[i].cell] != 0) != inside) continue;
      const bool first = i == 0 && !ring.closed;
      if (!first && (hull_.in_set[ring.cells[(i + n - 1) % n].cell] != 0) == inside) continue;  // within its run
      const int c = component_[position_of(ring.cells[i].cell)];
      if (std::find(plan_.runs.begin(), plan_.runs.end(), c) != plan_.runs.end()) return false;
      plan_.runs.push_back(c);
    }
    return true;
  }

  void unite_side(bool inside) {
    int first = -1;
    for (int i = 0; i < static_cast<int>(star_.size()); ++i) {
      if ((hull_.in_set[star_[i].cell] != 0) != inside) continue;
      if (first >= 0) unite(component_, first, i);
      first = i;
    }
  }

  int position_of(CellId c) const {
    for (int i = 0; i < static_cast<int>(star_.size()); ++i)
      if (star_[i].cell == c) return i;
    return -1;
  }

  /// True if facet f of cell c parts the two sides: hull, seen from inside or outside.
  bool parts(CellId c, int f) const {
    if (hull_.is_hull(c, f)) return true;
    const CellId n = mesh_.neighbour(c, f);
    return n != kNone && hull_.in_set[n] != hull_.in_set[c];
  }

  Status copy(VertexId v, int component, bool inside) {
    VertexCopy<Dim> made;
    made.origin = v;
    made.from_inside = mesh_.support[v].dim == Dim;
    made.cell = star_[component].cell;
    if (!find_support(v, component, made.support))
      return Status::illegal("a corner or feature of the domain would have to be duplicated at vertex " + std::to_string(v));
    const VertexId id = mesh_.vertex_count() + static_cast<Index>(plan_.copies.size());
    made.position = place(v, component, inside, made.support);
    if (inside) turn_inwards(v, component, made.position);
    made.anchor = anchor_on(mesh_, made.support, v, made.position);
    if (made.support.dim > 0 && made.support.dim < Dim) {
      if (made.anchor == kNone)
        return Status::illegal("a copy of vertex " + std::to_string(v) + " has no boundary to slide on");
      made.position = slide(*mesh_.geometry, made.support, made.anchor, made.position);
    }
    for (int i = 0; i < static_cast<int>(star_.size()); ++i)
      if (component_[i] == component)
        plan_.changes.push_back({star_[i].cell, static_cast<std::int8_t>(star_[i].corner), id});
    plan_.copies.push_back(made);
    return {};
  }

  /// The copy's support from the boundary facets of its component. A corner of the domain can be handed to a copy, if the
  /// rest lets go of it; that is seen when the new cells are there. False when no entity fits.
  bool find_support(VertexId v, int component, VertexSupport& support) {
    PatchId patch[3];
    int patches = 0;
    for (int i = 0; i < static_cast<int>(star_.size()); ++i) {
      if (component_[i] != component) continue;
      for (int axis = 0; axis < Dim; ++axis) {
        const int f = C::facet(axis, (star_[i].corner >> axis) & 1);
        if (!mesh_.on_boundary(star_[i].cell, f) || hull_.is_hull(star_[i].cell, f)) continue;
        const PatchId p = mesh_.patch_of(star_[i].cell, f);
        if (std::find(patch, patch + patches, p) != patch + patches) continue;
        if (patches == Dim - 1) {
          support = {0, kNone};
          return mesh_.support[v].dim == 0;
        }
        patch[patches++] = p;
      }
    }
    if (patches == 0) support = {Dim, kNone};
    if (patches == 1) support = {Dim - 1, patch[0]};
    if (patches == 2) {
      if (mesh_.support[v].dim == 1) {
        support = mesh_.support[v];
      } else {  // v is a corner: the curve that leaves it between the two patches
        const std::array<PatchId, 2> pair{std::min(patch[0], patch[1]), std::max(patch[0], patch[1])};
        Index curve = kNone;
        const auto& g = *mesh_.geometry;
        for (std::size_t i = 0; i < g.segments.size() && curve == kNone; ++i)
          if (g.curve_patches[g.curve[i]] == pair &&
              (g.points[g.segments[i][0]] == mesh_.points[v] || g.points[g.segments[i][1]] == mesh_.points[v]))
            curve = g.curve[i];
        if (curve == kNone) return false;
        support = {1, curve};
      }
    }
    return true;
  }

  /// v + t * mean of the component's edges at v that are not on the hull; restricted to the boundary for a copy that
  /// slides. Where all of them are on the hull, the multilinear image of a step off every hull facet.
  Point<Dim> place(VertexId v, int component, bool inside, VertexSupport support) {
    plan_.on_hull.clear();
    for (int i = 0; i < static_cast<int>(star_.size()); ++i) {
      if (component_[i] != component) continue;
      const auto [c, corner] = star_[i];
      for (int axis = 0; axis < Dim; ++axis) {
        if (!parts(c, C::facet(axis, (corner >> axis) & 1))) continue;
        for (int other = 0; other < Dim; ++other)
          if (other != axis) plan_.on_hull.push_back(mesh_.cells[c][corner ^ (1 << other)]);
      }
    }
    const Point<Dim>& origin = mesh_.points[v];
    Point<Dim> sum = Point<Dim>::Zero();
    int count = 0;
    for (int i = 0; i < static_cast<int>(star_.size()); ++i) {
      if (component_[i] != component) continue;
      const auto [c, corner] = star_[i];
      for (int axis = 0; axis < Dim; ++axis) {
        const VertexId w = mesh_.cells[c][corner ^ (1 << axis)];
        if (std::find(plan_.on_hull.begin(), plan_.on_hull.end(), w) != plan_.on_hull.end()) continue;
        if (support.dim < Dim && !stays_on(mesh_.support[w], support, c, corner, axis)) continue;
        sum += step(inside && hull_.slot[w] != kNone) * (mesh_.points[w] - origin);
        ++count;
      }
    }
    if (count > 0) return origin + sum / count;
    for (int i = 0; i < static_cast<int>(star_.size()); ++i) {
      if (component_[i] != component) continue;
      const auto [c, corner] = star_[i];
      std::array<double, Dim> t{};
      bool off = false;
      for (int axis = 0; axis < Dim; ++axis) {
        const int f = C::facet(axis, (corner >> axis) & 1);
        if (!parts(c, f)) continue;
        t[axis] = step(parts(c, C::opposite_facet(f)));
        off = true;
      }
      if (!off) continue;
      for (int k = 0; k < C::corners; ++k) {
        double weight = 1.0;
        for (int axis = 0; axis < Dim; ++axis) weight *= ((k ^ corner) >> axis) & 1 ? t[axis] : 1.0 - t[axis];
        sum += weight * (mesh_.points[mesh_.cells[c][k]] - origin);
      }
      ++count;
    }
    return count > 0 ? Point<Dim>(origin + sum / count) : origin;
  }

  /// Where a copy would not lie inside of all hull facets at v (mixed convex and re-entrant hulls), turns its direction
  /// towards the one that is most normal to them: the worst facet's normal is added until none is left behind.
  void turn_inwards(VertexId v, int component, Point<Dim>& position) {
    constexpr double well_inside = 0.15;
    normals_.clear();
    for (int i = 0; i < static_cast<int>(star_.size()); ++i) {
      if (component_[i] != component) continue;
      const auto [c, corner] = star_[i];
      std::array<Point<Dim>, Dim> e;
      for (int d = 0; d < Dim; ++d) e[d] = mesh_.points[mesh_.cells[c][corner ^ (1 << d)]] - mesh_.points[v];
      for (int axis = 0; axis < Dim; ++axis) {
        if (!hull_.is_hull(c, C::facet(axis, (corner >> axis) & 1))) continue;
        Point<Dim> n;
        if constexpr (Dim == 2)
          n = Point<2>(-e[1 - axis][1], e[1 - axis][0]);
        else
          n = vector_product(e[(axis + 1) % 3], e[(axis + 2) % 3]);
        if (n.dot(e[axis]) < 0) n = -n;
        normals_.push_back(n / std::sqrt(n.squaredNorm()));
      }
    }
    const Point<Dim>& origin = mesh_.points[v];
    const double length = std::sqrt((position - origin).squaredNorm());
    if (normals_.empty() || !(length > 0)) return;
    Point<Dim> direction = (position - origin) / length, best = direction;
    double best_angle = -2.0;
    for (int turn = 0; turn < 40 && best_angle < well_inside; ++turn) {
      const Point<Dim>* worst = &normals_[0];
      for (const auto& n : normals_)
        if (n.dot(direction) < worst->dot(direction)) worst = &n;
      if (worst->dot(direction) > best_angle) {
        best_angle = worst->dot(direction);
        best = direction;
      }
      direction += 0.4 * *worst;
      const double norm = std::sqrt(direction.squaredNorm());
      if (!(norm > 1e-6)) break;
      direction /= norm;
    }
    position = origin + length * best;
  }

  /// True if the edge (c, corner, axis) lies on the entity of `support`.
  bool stays_on(VertexSupport w, VertexSupport support, CellId c, int corner, int axis) const {
    if (w.dim == Dim || support.dim == 0) return false;  // nothing else lies on a corner
    PatchId found[2];
    int count = 0;
    for_each_cell_at_edge(mesh_, {c, C::edge_at(corner, axis)}, [&](CellId n, int e) {
      const int along = C::edge_axis(e), from = C::edge_from(e);
      for (int d = 0; d < Dim; ++d) {
        const int f = C::facet(d, (from >> d) & 1);
        if (d != along && mesh_.on_boundary(n, f) && count < 2) found[count++] = mesh_.patch_of(n, f);
      }
    });
    if (support.dim == Dim - 1) return count > 0 && (found[0] == support.entity || (count > 1 && found[1] == support.entity));
    if (count < 2 || found[0] == found[1]) return false;
    const auto& pair = mesh_.geometry->curve_patches[support.entity];
    return std::min(found[0], found[1]) == pair[0] && std::max(found[0], found[1]) == pair[1];
  }

  /// Share of an edge that a copy moves: thirds where the shrink set is one cell across, else halves.
  [[nodiscard]] double step(bool across) const { return shrink_ * (across ? 1.0 / 3.0 : 0.5); }

  const Mesh<Dim>& mesh_;
  const Hull<Dim>& hull_;
  double shrink_;
  CopyPlan<Dim>& plan_;
  std::vector<CellCorner>& star_;
  std::vector<int>& component_;
  std::vector<Point<Dim>>& normals_;
};

}  // namespace

template <int Dim>
Status plan_copies(const Mesh<Dim>& mesh, const Hull<Dim>& hull, double shrink, CopyPlan<Dim>& plan) {
  plan.changes.clear();
  plan.copies.clear();
  plan.kept_inside.clear();
  plan.parting.clear();
  VertexPlanner<Dim> planner(mesh, hull, shrink, plan);
  for (const VertexId v : hull.vertices)
    if (Status s = planner.run(v); !s.ok()) return s;
  std::sort(plan.kept_inside.begin(), plan.kept_inside.end());
  return {};
}

template Status plan_copies(const Mesh<2>&, const Hull<2>&, double, CopyPlan<2>&);
template Status plan_copies(const Mesh<3>&, const Hull<3>&, double, CopyPlan<3>&);

}  // namespace pillowmesh
