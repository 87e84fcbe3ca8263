// Which edges are too long: looks again only where something changed.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pillowmesh/metric/field.h"
#include "pillowmesh/refine/edge_tags.h"

namespace pillowmesh {

/// Keeps the cells whose edges have changed since they were last measured.
template <int Dim>
class Tagging {
 public:
  /// Every cell is looked at first. `threshold`: metric length above which an edge is tagged.
  Tagging(const Mesh<Dim>& mesh, double threshold);

  /// The edges of this cell are to be measured again.
  void look_again(CellId c);
  void look_at_all(const Mesh<Dim>& mesh);
  /// Only cells with two ends of these edges are to be measured. Cost: linear in the mesh.
  void look_at(const Mesh<Dim>& mesh, std::span<const std::array<VertexId, 2>> edges);

  /// No layer could be inserted at this cell: its edges are measured again in the next call, after a fourth refusal in the
  /// second one from now, then in the fourth and so on; sooner where they change.
  void look_again_later(CellId c);
  /// Those that wait are looked at in the next call. \return whether there were any.
  bool wake();
  [[nodiscard]] bool waiting() const { return !waiting_.empty(); }

  /// Tags the edges that are too long among those that changed. \return the cells that now carry tags, in ascending
  /// order. Cost: the edges of the cells that changed.
  std::vector<CellId> tag_long_edges(const Mesh<Dim>& mesh, const MetricField<Dim>& field, EdgeTags<Dim>& tags);

  /// Replaces `cells` by all cells with tags that are connected to them through tagged edges (after balancing), ascending.
  void collect_tagged_cells(const Mesh<Dim>& mesh, const EdgeTags<Dim>& tags, std::vector<CellId>& cells) const;

 private:
  double threshold_;
  double panel_;
  std::vector<std::uint8_t> changed_;  ///< per cell
  std::vector<CellId> list_;
  struct Refused {
    CellId cell;
    int until;
  };
  std::vector<Refused> waiting_;
  std::vector<std::uint8_t> refusals_;  ///< per cell
  int calls_ = 0;
  std::vector<typename EdgeTags<Dim>::Mask> measured_;  ///< edges that this call has seen
};

/// Takes the tags off frozen edges, which cannot be refined, and off the list the cells that are left without.
template <int Dim>
void drop_frozen_tags(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, std::vector<CellId>& cells);

}  // namespace pillowmesh
