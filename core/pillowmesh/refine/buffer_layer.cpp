#include "pillowmesh/refine/buffer_layer.h"

#include <algorithm>

#include "pillowmesh/mesh/frozen.h"
#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/overlap.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/refine/make_room.h"

namespace pillowmesh {
namespace {

template <int Dim>
class Inserter {
 public:
  using C = Cell<Dim>;

  Inserter(Mesh<Dim>& mesh, PillowWorkspace<Dim>& work, BufferLayer<Dim>& layer)
      : mesh_(mesh),
        hull_(work.hull),
        plan_(work.plan),
        touched_(work.touched),
        marks_(work.marks),
        layer_(layer),
        sides_(work.sides),
        old_vertex_cell_(work.old_vertex_cell),
        floor_(work.quality_floor),
        most_work_(work.most_untangling) {}

  void rename_corners() {
    touched_.clear();
    layer_.changed.clear();
    layer_.old_corners.clear();
    layer_.old_twins.clear();
    if (marks_.size() < mesh_.cells.size()) marks_.resize(mesh_.cells.size() + mesh_.cells.size() / 2, 0);
    const auto touch = [&](CellId c) {
      if (marks_[c]) return;
      marks_[c] = 1;
      touched_.push_back(c);
    };
    for (const CornerChange& change : plan_.changes) touch(change.cell);
    for (const auto& h : hull_.facets) {
      touch(h.inside);
      if (h.outside != kNone) touch(h.outside);
    }
    for (const CellId c : touched_) marks_[c] = 0;
    std::sort(touched_.begin(), touched_.end());
    for (const CellId c : touched_) {
      layer_.changed.push_back(c);
      layer_.old_corners.push_back(mesh_.cells[c]);
      layer_.old_twins.push_back(mesh_.twins[c]);
    }
    for (const CornerChange& change : plan_.changes) mesh_.cells[change.cell][change.corner] = change.vertex;
  }

  void add_vertices() {
    layer_.first_vertex = mesh_.vertex_count();
    layer_.origins.clear();
    for (const auto& copy : plan_.copies) {
      layer_.origins.push_back(copy.origin);
      mesh_.points.push_back(copy.position);
      mesh_.support.push_back(copy.support);
      mesh_.anchor.push_back(copy.anchor);
      mesh_.vertex_cell.push_back(copy.cell);
    }
  }

  /// One cell per hull facet, in the frame of its inside cell: facet `h.facet` of the new cell looks outside.
  void extrude() {
    layer_.first_cell = mesh_.cell_count();
    layer_.cell_count = static_cast<Index>(hull_.facets.size());
    for (const auto& h : hull_.facets) {
      const CellId k = mesh_.cell_count();
      const int inner = C::opposite_facet(h.facet);
      Corners<Dim> corners;
      std::array<HalfFacetId, C::facets> twins{};
      for (int i = 0; i < C::facet_corners; ++i) {
        corners[C::facet_corner(inner, i)] = mesh_.cells[h.inside][C::facet_corner(h.facet, i)];
        corners[C::facet_corner(h.facet, i)] =
            h.outside != kNone ? mesh_.cells[h.outside][h.outside_corner[i]] : h.vertices[i];
      }
      twins[inner] = mesh_.half_facet(h.inside, h.facet);
      twins[h.facet] = h.outside != kNone ? mesh_.half_facet(h.outside, h.outside_facet) : ~h.patch;
      mesh_.cells.push_back(corners);
      mesh_.twins.push_back(twins);
      mesh_.region.push_back(mesh_.region[h.inside]);
      mesh_.twins[h.inside][h.facet] = mesh_.half_facet(k, inner);
      if (h.outside != kNone) mesh_.twins[h.outside][h.outside_facet] = mesh_.half_facet(k, h.facet);
    }
  }

  /// Joins the new cells to each other, side by side.
  void connect_sides() {
    std::size_t at = 0;
    for (Index i = 0; i < layer_.cell_count; ++i) {
      const auto& h = hull_.facets[i];
      const CellId k = layer_.first_cell + i;
      for (int g = 0; g < C::facets; ++g) {
        if (C::facet_axis(g) == C::facet_axis(h.facet)) continue;
        const NewCellSide& side = sides_[at++];
        if (side.hull_cell == kNone) {
          mesh_.twins[k][g] = ~side.patch;
          continue;
        }
        // The inside cell of the partner's hull facet now has the partner itself as its twin there.
        const CellId partner = mesh_.cell_of(mesh_.twins[side.hull_cell][side.hull_facet]);
        mesh_.twins[k][g] = mesh_.half_facet(partner, side.facet);
      }
    }
  }

  /// Vertices that stay with the outside must name a cell that still has them.
  void repair_vertex_cells() {
    old_vertex_cell_.clear();
    for (const VertexId v : hull_.vertices) old_vertex_cell_.push_back(mesh_.vertex_cell[v]);
    for (Index i = 0; i < layer_.cell_count; ++i) {
      const CellId k = layer_.first_cell + i;
      for (int j = 0; j < C::facet_corners; ++j)
        mesh_.vertex_cell[mesh_.cells[k][C::facet_corner(hull_.facets[i].facet, j)]] = k;
    }
  }

  void forget_moves() {
    layer_.moved.clear();
    layer_.old_points.clear();
    layer_.old_anchors.clear();
    layer_.released.clear();
    layer_.old_supports.clear();
    layer_.released_anchors.clear();
  }

  bool conforming() const {
    for (CellId k = layer_.first_cell; k < mesh_.cell_count(); ++k)
      if (!conforming(k)) return false;
    return true;
  }

  /// All cells with new corners are valid. Those at vertices that made way have been looked at when they did.
  /// Whether new vertices have come to lie where the boundary would go back and forth: far across a bend they slide anywhere.
  bool folded() const {
    if constexpr (Dim == 2) {
      OrderedStar star;
      const auto bad = [&](VertexId v) {  // at v, or at a vertex beside it
        if (mesh_.support[v].dim == 2 || !find_star(mesh_, v, star)) return false;
        for (int k = 0; k < star.count; ++k)
          for (const VertexId w : mesh_.cells[star.cell[k]])
            if (mesh_.support[w].dim < 2 && folded_at(mesh_, w)) return true;
        return false;
      };
      for (VertexId v = layer_.first_vertex; v < mesh_.vertex_count(); ++v)
        if (bad(v)) return true;
      return std::any_of(hull_.vertices.begin(), hull_.vertices.end(), bad) ||
             std::any_of(layer_.moved.begin(), layer_.moved.end(), bad);
    }
    return false;
  }

  bool positive() const {
    for (CellId k = layer_.first_cell; k < mesh_.cell_count(); ++k)
      if (!good(mesh_.cells[k])) return false;
    for (std::size_t i = 0; i < layer_.changed.size(); ++i) {
      const Corners<Dim>& cell = mesh_.cells[layer_.changed[i]];
      if (cell == layer_.old_corners[i]) continue;  // outside: only its neighbours are others
      if (!good(cell, &layer_.old_corners[i])) return false;
    }
    return true;
  }

  /// Boundary vertices take the support that their boundary facets ask for, now that the new cells have brought theirs.
  /// A vertex that the outside keeps may have come off the boundary, or to slide where its copy takes its place on the
  /// curve or corner; a copy that has come to lie on the boundary starts at its origin. False if no entity fits. New
  /// facets on the boundary have all their vertices from there: what came from inside need not be looked at.
  bool supports_hold() {
    for (const VertexId v : hull_.vertices) {
      if (mesh_.support[v].dim == Dim) continue;
      VertexSupport found;
      if (!support_from_facets(v, v, found)) return false;
      const VertexSupport now = mesh_.support[v];
      if (now.frozen()) {  // it stays, so the boundary must stay with it
        if (found.dim == Dim && mesh_.anchor[v] != kNone) return false;
        continue;
      }
      if (found == now || (now.dim == 0 && found.dim < Dim)) continue;
      if (found.dim < now.dim) return false;
      release(v, found);
      if (mesh_.anchor[v] == kNone && found.dim < Dim) return false;
    }
    for (std::size_t i = 0; i < layer_.origins.size(); ++i) {
      const VertexId v = layer_.first_vertex + static_cast<VertexId>(i), origin = layer_.origins[i];
      if (plan_.copies[i].from_inside) continue;
      VertexSupport found;
      if (!support_from_facets(v, origin, found)) return false;
      if (found.dim == 0 && !leaves_corner(origin)) return false;
      if (found == mesh_.support[v] && found.dim > 0) continue;
      const Point<Dim> start = mesh_.points[origin];
      mesh_.anchor[v] = anchor_on(mesh_, found, origin, start);
      mesh_.support[v] = found;
      mesh_.points[v] = start;
      if (mesh_.anchor[v] == kNone && found.dim > 0 && found.dim < Dim) return false;
    }
    return true;
  }

  bool make_room() { return pillowmesh::make_room(mesh_, hull_, floor_, most_work_, layer_); }

  void undo() {
    for (std::size_t i = 0; i < layer_.moved.size(); ++i) {
      mesh_.points[layer_.moved[i]] = layer_.old_points[i];
      mesh_.anchor[layer_.moved[i]] = layer_.old_anchors[i];
    }
    for (std::size_t i = 0; i < layer_.released.size(); ++i) {
      mesh_.support[layer_.released[i]] = layer_.old_supports[i];
      mesh_.anchor[layer_.released[i]] = layer_.released_anchors[i];
    }
    forget_moves();
    for (std::size_t i = 0; i < layer_.changed.size(); ++i) {
      mesh_.cells[layer_.changed[i]] = layer_.old_corners[i];
      mesh_.twins[layer_.changed[i]] = layer_.old_twins[i];
    }
    for (std::size_t i = 0; i < hull_.vertices.size(); ++i) mesh_.vertex_cell[hull_.vertices[i]] = old_vertex_cell_[i];
    mesh_.cells.resize(layer_.first_cell);
    mesh_.twins.resize(layer_.first_cell);
    mesh_.region.resize(layer_.first_cell);
    mesh_.points.resize(layer_.first_vertex);
    mesh_.support.resize(layer_.first_vertex);
    mesh_.anchor.resize(layer_.first_vertex);
    mesh_.vertex_cell.resize(layer_.first_vertex);
  }

 private:
  /// Gives vertex v of the outside another support than it had.
  void release(VertexId v, VertexSupport support) {
    layer_.released.push_back(v);
    layer_.old_supports.push_back(mesh_.support[v]);
    layer_.released_anchors.push_back(mesh_.anchor[v]);
    mesh_.anchor[v] = anchor_on(mesh_, support, v, mesh_.points[v]);
    mesh_.support[v] = support;
  }

  /// Lets a vertex leave the corner of the domain that it is on, for a copy. False if the outside needs the corner too.
  bool leaves_corner(VertexId origin) {
    if (mesh_.support[origin].dim != 0 || mesh_.support[origin].frozen()) return false;
    VertexSupport found;
    if (!support_from_facets(origin, origin, found) || found.dim == 0) return false;
    release(origin, found);
    return found.dim == Dim || mesh_.anchor[origin] != kNone;
  }

  /// The support that the boundary facets at v ask for; v is `origin` or a copy of it. False when no entity of the
  /// domain fits.
  bool support_from_facets(VertexId v, VertexId origin, VertexSupport& support) {
    vertex_star(mesh_, v, plan_.star);
    std::array<PatchId, 3> patch{};
    int patches = 0;
    for (const auto& [c, corner] : plan_.star)
      for (int axis = 0; axis < Dim; ++axis) {
        const int f = C::facet(axis, (corner >> axis) & 1);
        if (!mesh_.on_boundary(c, f)) continue;
        const PatchId p = mesh_.patch_of(c, f);
        if (std::find(patch.begin(), patch.begin() + patches, p) != patch.begin() + patches) continue;
        if (patches == 3) break;
        patch[patches++] = p;
      }
    support = patches == 0 ? VertexSupport{Dim, kNone} : VertexSupport{Dim - 1, patch[0]};
    if (patches < 2) return true;
    const VertexSupport before = old_support(origin);
    support = {0, kNone};
    if (Dim == 2 || patches == 3) return before.dim == 0;
    const std::array<PatchId, 2> pair{std::min(patch[0], patch[1]), std::max(patch[0], patch[1])};
    for (const VertexSupport known : {mesh_.support[v], before})
      if (known.dim == 1 && mesh_.geometry->curve_patches[known.entity] == pair) {
        support = known;
        return true;
      }
    return before.dim == 0;
  }

  VertexSupport old_support(VertexId v) const {
    const auto at = std::find(layer_.released.begin(), layer_.released.end(), v);
    return at == layer_.released.end() ? mesh_.support[v] : layer_.old_supports[at - layer_.released.begin()];
  }

  /// Corners as validate wants them and above the floor. In 3D inside too, unless the cell came inverted inside.
  [[nodiscard]] bool good(const Corners<Dim>& cell, const Corners<Dim>* before = nullptr) const {
    const auto at = [&](int k) -> const Point<Dim>& { return mesh_.points[cell[k]]; };
    if constexpr (Dim == 2) {
      return floor_ > 0 ? min_scaled_jacobian<2>(at) > floor_ : min_corner_jacobian<2>(at) > 0;
    } else {
      const LatticeJacobians found = lattice_jacobians(at);
      if (!(floor_ > 0 ? found.scaled > floor_ : found.corner > 0)) return false;
      if (found.lowest > 0) return true;
      const auto was = [&](int k) -> const Point<3>& { return mesh_.points[(*before)[k]]; };
      return before != nullptr && !(min_lattice_jacobian(was) > 0);
    }
  }

  /// \pre neither has a vertex twice
  static bool same_vertices(const FacetCorners<Dim>& a, const FacetCorners<Dim>& b) {
    return std::all_of(a.begin(), a.end(), [&](VertexId v) { return std::find(b.begin(), b.end(), v) != b.end(); });
  }

  /// No vertex twice, no two facets shared with one neighbour, twins that agree.
  bool conforming(CellId k) const {
    for (int i = 0; i < C::corners; ++i)
      for (int j = 0; j < i; ++j)
        if (mesh_.cells[k][i] == mesh_.cells[k][j]) return false;
    for (int f = 0; f < C::facets; ++f) {
      const HalfFacetId twin = mesh_.twins[k][f];
      if (twin < 0) continue;
      const CellId n = mesh_.cell_of(twin);
      if (n >= mesh_.cell_count() || mesh_.twins[n][mesh_.facet_of(twin)] != mesh_.half_facet(k, f)) return false;
      if (!same_vertices(mesh_.facet_vertices(k, f), mesh_.facet_vertices(n, mesh_.facet_of(twin)))) return false;
      for (int g = 0; g < f; ++g)
        if (mesh_.neighbour(k, g) == n) return false;
    }
    return true;
  }

  Mesh<Dim>& mesh_;
  Hull<Dim>& hull_;
  CopyPlan<Dim>& plan_;
  std::vector<CellId>& touched_;
  std::vector<std::uint8_t>& marks_;
  BufferLayer<Dim>& layer_;
  std::vector<NewCellSide>& sides_;
  std::vector<CellId>& old_vertex_cell_;
  double floor_;
  std::int64_t most_work_;
};

template <int Dim>
Status try_to_insert(Mesh<Dim>& mesh, std::span<const CellId> shrink_set, std::span<const HalfFacetId> boundary_hull,
                     PillowWorkspace<Dim>& work, BufferLayer<Dim>& layer) {
  work.plan.parting.clear();
  find_hull(mesh, shrink_set, boundary_hull, work.hull);
  Status status;
  if (work.hull.facets.empty()) status = Status::illegal("the shrink set is the whole mesh: it has no hull");
  Inserter<Dim> inserter(mesh, work, layer);
  // A third of the way across at first; a tenth where thin or bent cells would turn inside out; then untangling.
  constexpr std::array<double, 3> shrinks{1.0, 0.3, 1.0};
  inserter.forget_moves();
  for (std::size_t attempt = 0; attempt < shrinks.size() && !work.hull.facets.empty(); ++attempt) {
    status = plan_copies(mesh, work.hull, shrinks[attempt], work.plan);
    if (!status.ok()) break;
    find_side_partners(mesh, work.hull, work.plan, work.sides);
    inserter.rename_corners();
    inserter.add_vertices();
    inserter.extrude();
    inserter.connect_sides();
    inserter.repair_vertex_cells();
    if (!frozen_remain<Dim>(mesh, layer.old_corners)) {
      inserter.undo();
      status = Status::illegal("something frozen would be split");
      break;
    }
    if (!inserter.conforming() || !inserter.supports_hold()) {
      inserter.undo();
      status = Status::illegal("the new cells would not fit: two share more than one facet, or leave their boundary");
      break;
    }
    const bool last = attempt + 1 == shrinks.size();
    if ((inserter.positive() || (last && inserter.make_room())) && !inserter.folded()) break;
    inserter.undo();
    status = Status::illegal("no position of the new vertices keeps all corner Jacobians positive");
  }
  clear_hull(shrink_set, work.hull);
  return status;
}

}  // namespace

template <int Dim>
Status insert_buffer_layer(Mesh<Dim>& mesh, std::span<const CellId> shrink_set,
                           std::span<const HalfFacetId> boundary_hull, PillowWorkspace<Dim>& work,
                           BufferLayer<Dim>& layer) {
  layer.added.clear();
  Status status = try_to_insert(mesh, shrink_set, boundary_hull, work, layer);
  if (status.ok() || work.plan.parting.empty()) return status;
  // Cells are added where the set touches itself, until it does not or has more than doubled.
  work.set.assign(shrink_set.begin(), shrink_set.end());
  const std::size_t most = 2 * shrink_set.size() + 2;
  while (!status.ok() && !work.plan.parting.empty() && work.set.size() + work.plan.parting.size() <= most) {
    work.set.insert(work.set.end(), work.plan.parting.begin(), work.plan.parting.end());
    status = try_to_insert<Dim>(mesh, work.set, boundary_hull, work, layer);
  }
  layer.added.assign(work.set.begin() + static_cast<std::ptrdiff_t>(shrink_set.size()), work.set.end());
  return status;
}

template Status insert_buffer_layer(Mesh<2>&, std::span<const CellId>, std::span<const HalfFacetId>,
                                    PillowWorkspace<2>&, BufferLayer<2>&);
template Status insert_buffer_layer(Mesh<3>&, std::span<const CellId>, std::span<const HalfFacetId>,
                                    PillowWorkspace<3>&, BufferLayer<3>&);

}  // namespace pillowmesh
