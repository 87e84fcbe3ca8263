#include "pillowmesh/adapt/tagging.h"

#include <algorithm>

#include "pillowmesh/mesh/frozen.h"
#include "pillowmesh/metric/length.h"

namespace pillowmesh {
namespace {

/// Sorts the cells that are marked: by looking at all marks, where that is quicker.
void sort_marked(std::vector<CellId>& cells, const std::vector<std::uint8_t>& marks) {
  if (cells.size() < marks.size() / 16) {
    std::sort(cells.begin(), cells.end());
    return;
  }
  cells.clear();
  for (std::size_t c = 0; c < marks.size(); ++c)
    if (marks[c]) cells.push_back(static_cast<CellId>(c));
}

}  // namespace

template <int Dim>
Tagging<Dim>::Tagging(const Mesh<Dim>& mesh, double threshold)
    : threshold_(threshold), panel_(default_panel<Dim>(mesh.points)) {
  look_at_all(mesh);
}

template <int Dim>
void Tagging<Dim>::look_again(CellId c) {
  if (static_cast<std::size_t>(c) >= changed_.size()) changed_.resize(c + 1 + c / 2, 0);
  if (changed_[c]) return;
  changed_[c] = 1;
  list_.push_back(c);
}

template <int Dim>
void Tagging<Dim>::look_again_later(CellId c) {
  constexpr int free_tries = 2, longest_wait = 8;  // 2^6 calls
  if (static_cast<std::size_t>(c) >= refusals_.size()) refusals_.resize(c + 1 + c / 2, 0);
  waiting_.push_back({c, calls_ + (1 << std::max(refusals_[c] - free_tries, 0))});
  if (refusals_[c] < longest_wait) ++refusals_[c];
}

template <int Dim>
bool Tagging<Dim>::wake() {
  const bool any = waiting();
  for (const Refused& refused : waiting_) look_again(refused.cell);
  waiting_.clear();
  return any;
}

template <int Dim>
void Tagging<Dim>::look_at_all(const Mesh<Dim>& mesh) {
  waiting_.clear();
  for (CellId c = 0; c < mesh.cell_count(); ++c)
    if (mesh.alive(c)) look_again(c);
}

template <int Dim>
void Tagging<Dim>::look_at(const Mesh<Dim>& mesh, std::span<const std::array<VertexId, 2>> edges) {
  for (const CellId c : list_) changed_[c] = 0;
  list_.clear();
  waiting_.clear();
  std::vector<std::uint8_t> is_end(mesh.points.size(), 0);
  for (const auto& [a, b] : edges) is_end[a] = is_end[b] = 1;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    int ends = 0;
    for (const VertexId v : mesh.cells[c]) ends += mesh.alive(c) && is_end[v] ? 1 : 0;
    if (ends > 1) look_again(c);
  }
}

template <int Dim>
std::vector<CellId> Tagging<Dim>::tag_long_edges(const Mesh<Dim>& mesh, const MetricField<Dim>& field,
                                                 EdgeTags<Dim>& tags) {
  using C = Cell<Dim>;
  tags.mask.resize(mesh.cells.size(), 0);
  measured_.assign(mesh.cells.size(), 0);
  ++calls_;
  std::erase_if(waiting_, [&](const Refused& refused) {
    if (refused.until > calls_) return false;
    look_again(refused.cell);
    return true;
  });
  sort_marked(list_, changed_);
  constexpr std::size_t batch = 2048;
  std::vector<std::array<VertexId, 2>> edges;
  std::vector<CellEdge> places;
  std::vector<unsigned char> tagged(batch + C::edges);
  std::vector<CellId> found;
  std::vector<std::uint8_t> is_found(mesh.cells.size(), 0);
  const auto flush = [&] {
    pillowmesh::tag_long_edges<Dim>(field, mesh.points, edges, threshold_, panel_,
                                    std::span(tagged).first(edges.size()));
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (tagged[i])
        for_each_cell_at_edge(mesh, places[i], [&](CellId c, int e) {
          if (tags.mask[c] == 0) {
            found.push_back(c);
            is_found[c] = 1;
          }
          tags.mask[c] |= typename EdgeTags<Dim>::Mask(1u << e);
        });
    edges.clear();
    places.clear();
  };
  for (const CellId c : list_) {
    if (!mesh.alive(c)) continue;
    for (int e = 0; e < C::edges; ++e) {
      if ((measured_[c] >> e) & 1) continue;
      for_each_cell_at_edge(mesh, {c, e}, [&](CellId n, int f) {
        measured_[n] |= static_cast<typename EdgeTags<Dim>::Mask>(1u << f);
      });
      places.push_back({c, e});
      edges.push_back({mesh.cells[c][C::edge_from(e)], mesh.cells[c][C::edge_to(e)]});
    }
    if (edges.size() >= batch) flush();
  }
  flush();
  for (const CellId c : list_) changed_[c] = 0;
  list_.clear();
  sort_marked(found, is_found);
  return found;
}

template <int Dim>
void Tagging<Dim>::collect_tagged_cells(const Mesh<Dim>& mesh, const EdgeTags<Dim>& tags,
                                        std::vector<CellId>& cells) const {
  std::vector<std::uint8_t> seen(mesh.cells.size(), 0);
  for (const CellId c : cells) seen[c] = 1;
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (int e = 0; e < Cell<Dim>::edges; ++e)
      if (tags.has(cells[i], e))
        for_each_cell_at_edge(mesh, {cells[i], e}, [&](CellId n, int) {
          if (seen[n]) return;
          seen[n] = 1;
          cells.push_back(n);
        });
  sort_marked(cells, seen);
}

template <int Dim>
void drop_frozen_tags(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, std::vector<CellId>& cells) {
  if (!mesh.frozen) return;
  for (const CellId c : cells)
    for (int e = 0; e < Cell<Dim>::edges; ++e)
      if (tags.has(c, e) && is_frozen_edge(mesh, {c, e})) clear_tag(mesh, tags, {c, e});
  std::erase_if(cells, [&](CellId c) { return tags.mask[c] == 0; });
}

template void drop_frozen_tags(const Mesh<2>&, EdgeTags<2>&, std::vector<CellId>&);
template void drop_frozen_tags(const Mesh<3>&, EdgeTags<3>&, std::vector<CellId>&);
template class Tagging<2>;
template class Tagging<3>;

}  // namespace pillowmesh
