#include "pillowmesh/mesh/cavity.h"

#include <algorithm>

#include "pillowmesh/mesh/compact.h"
#include "pillowmesh/mesh/frozen.h"
#include "pillowmesh/mesh/ordered_star.h"

namespace pillowmesh {

void Cavity::clear() {
  old_cells.clear();
  new_cells.clear();
  new_vertices.clear();
  split_sides.clear();
  removed.clear();
  merged_into.clear();
  moved.clear();
  moved_to.clear();
  around.clear();
}

Journal::Journal(Mesh<2>& mesh) : mesh_(mesh) {
  for (CellId c = mesh.cell_count(); c-- > 0;)
    if (!mesh.alive(c)) free_cells_.push_back(c);
  for (VertexId v = mesh.vertex_count(); v-- > 0;)
    if (mesh.vertex_cell[v] == kNone) free_vertices_.push_back(v);
  begin();
}

void Journal::begin() {
  // What the last change gave up is free from now on.
  free_cells_.insert(free_cells_.end(), given_cells_.begin(), given_cells_.end());
  free_vertices_.insert(free_vertices_.end(), given_vertices_.begin(), given_vertices_.end());
  for (auto* list : {&given_cells_, &taken_cells_, &given_vertices_, &taken_vertices_, &touched_cells_, &touched_vertices_})
    list->clear();
  old_cells_.clear();
  old_vertices_.clear();
  cell_stamp_.resize(mesh_.cells.size(), 0);
  vertex_stamp_.resize(mesh_.points.size(), 0);
  ++stamp_;
  cells_before_ = mesh_.cell_count();
  vertices_before_ = mesh_.vertex_count();
}

void Journal::touch_cell(CellId c) {
  if (c >= cells_before_ || cell_stamp_[c] == stamp_) return;
  cell_stamp_[c] = stamp_;
  touched_cells_.push_back(c);
  old_cells_.push_back({mesh_.cells[c], mesh_.twins[c], mesh_.region[c]});
}

void Journal::touch(VertexId v) {
  if (v >= vertices_before_ || vertex_stamp_[v] == stamp_) return;
  vertex_stamp_[v] = stamp_;
  touched_vertices_.push_back(v);
  old_vertices_.push_back({mesh_.points[v], mesh_.vertex_cell[v], mesh_.support[v], mesh_.anchor[v]});
}

void Journal::undo() {
  resize(mesh_, vertices_before_, cells_before_);
  for (std::size_t i = 0; i < touched_cells_.size(); ++i) {
    const CellId c = touched_cells_[i];
    mesh_.cells[c] = old_cells_[i].corners;
    mesh_.twins[c] = old_cells_[i].twins;
    mesh_.region[c] = old_cells_[i].region;
  }
  for (std::size_t i = 0; i < touched_vertices_.size(); ++i) {
    const VertexId v = touched_vertices_[i];
    mesh_.points[v] = old_vertices_[i].point;
    mesh_.vertex_cell[v] = old_vertices_[i].cell;
    mesh_.support[v] = old_vertices_[i].support;
    mesh_.anchor[v] = old_vertices_[i].anchor;
  }
  given_cells_.clear();
  given_vertices_.clear();
  while (!taken_cells_.empty()) free_cells_.push_back(taken_cells_.back()), taken_cells_.pop_back();
  while (!taken_vertices_.empty()) free_vertices_.push_back(taken_vertices_.back()), taken_vertices_.pop_back();
  touched_cells_.clear();
  touched_vertices_.clear();
  old_cells_.clear();
  old_vertices_.clear();
  ++stamp_;
}

/// True if what is frozen among the old cells is among the new ones.
bool Journal::keeps_frozen(const Cavity& cavity) const {
  if (!mesh_.frozen) return true;
  const auto frozen = [&](VertexId v) { return mesh_.support[v].frozen(); };
  if (std::any_of(cavity.removed.begin(), cavity.removed.end(), frozen)) return false;
  if (std::any_of(cavity.moved.begin(), cavity.moved.end(), frozen)) return false;
  const auto remains = [&](VertexId a, VertexId b) {
    for (const Corners<2>& cell : cavity.new_cells)
      for (int i = 0; i < 4; ++i)
        if (cell[kAround[i]] == a && cell[kAround[(i + 1) & 3]] == b) return true;
    return false;
  };
  for (const CellId c : cavity.old_cells) {
    if (is_frozen_cell(mesh_, mesh_.cells[c])) return false;
    for (int i = 0; i < 4; ++i) {
      const VertexId a = around(mesh_, c, i), b = around(mesh_, c, i + 1);
      if (is_frozen_edge(mesh_, a, b) && !remains(a, b)) return false;
    }
  }
  return true;
}

CellId Journal::take_cell() {
  if (!free_cells_.empty()) {
    const CellId c = free_cells_.back();
    free_cells_.pop_back();
    taken_cells_.push_back(c);
    touch_cell(c);
    return c;
  }
  resize(mesh_, mesh_.vertex_count(), mesh_.cell_count() + 1);
  return mesh_.cell_count() - 1;
}

VertexId Journal::take_vertex() {
  if (!free_vertices_.empty()) {
    const VertexId v = free_vertices_.back();
    free_vertices_.pop_back();
    taken_vertices_.push_back(v);
    touch(v);
    return v;
  }
  resize(mesh_, mesh_.vertex_count() + 1, mesh_.cell_count());
  return mesh_.vertex_count() - 1;
}

bool Journal::apply(Cavity& cavity, std::vector<CellId>& new_ids) {
  if (!keeps_frozen(cavity)) return false;
  const auto merged = [&](VertexId v) {
    for (std::size_t i = 0; i < cavity.removed.size(); ++i)
      if (cavity.removed[i] == v) return cavity.merged_into[i];
    return v;
  };
  // The outline, before anything changes. A cell of the cavity is marked by corners[3] = kNone meanwhile.
  outline_.clear();
  for (const CellId c : cavity.old_cells) {
    touch_cell(c);
    for (const VertexId v : mesh_.cells[c]) {
      touch(v);
      mesh_.vertex_cell[v] = kNone;
    }
  }
  const Index region = mesh_.region[cavity.old_cells[0]];
  for (const CellId c : cavity.old_cells) mesh_.region[c] = kNone;
  for (const CellId c : cavity.old_cells)
    for (int i = 0; i < 4; ++i) {
      const HalfFacetId twin = twin_of_side(mesh_, c, i);
      if (twin >= 0 && mesh_.region[mesh_.cell_of(twin)] == kNone) continue;
      if (twin >= 0) touch_cell(mesh_.cell_of(twin));
      outline_.push_back({merged(around(mesh_, c, i)), merged(around(mesh_, c, i + 1)), twin, kNone});
    }
  for (const auto& split : cavity.split_sides)
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      if (outline_[i].outside >= 0 || outline_[i].a != split.a || outline_[i].b != split.b) continue;
      outline_[i].b = split.m;
      outline_.push_back({split.m, split.b, outline_[i].outside, kNone});
      break;
    }

  // Cells: numbers of old ones first.
  new_ids.clear();
  for (std::size_t i = 0; i < cavity.new_cells.size(); ++i)
    new_ids.push_back(i < cavity.old_cells.size() ? cavity.old_cells[i] : take_cell());
  for (std::size_t i = cavity.new_cells.size(); i < cavity.old_cells.size(); ++i) {
    const CellId c = cavity.old_cells[i];
    mesh_.cells[c].fill(kNone);
    mesh_.twins[c].fill(~0);
    mesh_.region[c] = region;
    given_cells_.push_back(c);
  }
  // Vertices.
  const std::size_t first_new = cavity.around.size();
  for (const auto& n : cavity.new_vertices) {
    const VertexId v = take_vertex();
    mesh_.points[v] = n.point;
    mesh_.support[v] = n.support;
    mesh_.anchor[v] = n.anchor;
    cavity.around.push_back(v);
  }
  const auto named = [&](VertexId& v) {
    if (v <= Cavity::kNew) v = cavity.around[first_new + static_cast<std::size_t>(Cavity::kNew - v)];
  };
  for (Side& s : outline_) named(s.a), named(s.b);
  for (std::size_t i = 0; i < cavity.moved.size(); ++i) {
    touch(cavity.moved[i]);
    mesh_.points[cavity.moved[i]] = cavity.moved_to[i];
  }
  for (const VertexId v : cavity.removed) {
    mesh_.vertex_cell[v] = kNone;
    given_vertices_.push_back(v);
  }
  for (std::size_t i = 0; i < new_ids.size(); ++i) {
    for (VertexId& v : cavity.new_cells[i]) named(v);
    mesh_.cells[new_ids[i]] = cavity.new_cells[i];
    mesh_.region[new_ids[i]] = region;
    for (const VertexId v : cavity.new_cells[i]) mesh_.vertex_cell[v] = new_ids[i];
  }
  if (!link(new_ids)) return false;
  // Vertices that the change took all their known cells from.
  for (const Side& s : outline_) {
    if (s.outside < 0) continue;
    for (const VertexId v : {s.a, s.b})
      if (mesh_.vertex_cell[v] == kNone) mesh_.vertex_cell[v] = mesh_.cell_of(s.outside);
  }
  return true;
}

bool Journal::link(const std::vector<CellId>& ids) {
  sides_.clear();
  for (const CellId c : ids)
    for (int i = 0; i < 4; ++i)
      sides_.push_back({around(mesh_, c, i), around(mesh_, c, i + 1), kNone, mesh_.half_facet(c, kSideFacet[i])});
  // Each side of a new cell meets one of the outline (same direction) or one of another new cell (the opposite one).
  const auto join = [&](HalfFacetId a, HalfFacetId b) {
    if (a >= 0) mesh_.twins[mesh_.cell_of(a)][mesh_.facet_of(a)] = b;
    if (b >= 0) mesh_.twins[mesh_.cell_of(b)][mesh_.facet_of(b)] = a;
  };
  const auto find = [&](std::size_t i) {
    Side& s = sides_[i];
    for (Side& o : outline_)
      if (o.a == s.a && o.b == s.b && o.inside == kNone) {
        join(s.inside, o.outside);
        o.inside = s.inside;
        return true;
      }
    for (std::size_t j = i + 1; j < sides_.size(); ++j)
      if (sides_[j].a == s.b && sides_[j].b == s.a && sides_[j].outside == kNone) {
        join(s.inside, sides_[j].inside);
        sides_[j].outside = s.inside;
        return true;
      }
    return false;
  };
  for (std::size_t i = 0; i < sides_.size(); ++i)
    if (sides_[i].outside == kNone && !find(i)) return false;
  // What is left of the outline was closed up: two sides of it lie on each other now.
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    Side& s = outline_[i];
    if (s.inside != kNone || s.a == s.b) continue;
    bool found = false;
    for (std::size_t j = i + 1; j < outline_.size() && !found; ++j) {
      Side& o = outline_[j];
      if (o.inside != kNone || o.a != s.b || o.b != s.a) continue;
      if (s.outside < 0 && o.outside < 0) return false;
      if (s.outside >= 0) mesh_.twins[mesh_.cell_of(s.outside)][mesh_.facet_of(s.outside)] = o.outside;
      if (o.outside >= 0) mesh_.twins[mesh_.cell_of(o.outside)][mesh_.facet_of(o.outside)] = s.outside;
      o.inside = s.inside = 0;
      found = true;
    }
    if (!found) return false;
  }
  return true;
}

}  // namespace pillowmesh
