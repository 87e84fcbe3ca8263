// What full adaptation in 2D does besides layers: coarse meshes first, each searched, then diced in four and mended.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pillowmesh/adapt/schedule.h"
#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// Says, and does, what follows when no layer is left to insert. Searches coarse meshes first, where that costs least: one
/// whose edges are about as long as those of the input, then finer ones, made by dicing, that only have to be mended.
class FullAdaptation {
 public:
  /// What the driver is to do now.
  enum class Next {
    step,    ///< another step
    finer,   ///< the same, for edges of length `coarser()`
    layers,  ///< insert layers for edges of that length, then go on
    done,    ///< nothing; see `outcome`
  };

  /// `mesh` and `field` as they come; the others must outlive it. Cost: linear.
  FullAdaptation(const Mesh<2>& mesh, const MetricField<2>& field, const AdaptOptions& options, Recorder<2>& recorder,
                 std::map<std::string, std::int64_t>& operations);

  /// How many times as long as they are to become edges are meant to be for now.
  [[nodiscard]] int coarser() const { return 1 << halvings_; }

  /// Whether a coarse mesh has about as many cells as it is to have, and needs no more layers than it was given.
  [[nodiscard]] bool has_enough(const Mesh<2>& mesh) const;

  /// All layers are there, for the first time or once more: what follows is as long as they were many.
  void begin(const Mesh<2>& mesh);

  /// A few thousand vertex moves, or the dicing. \param target `field` for edges of length `coarser()`; must live until
  /// something other than `step` is returned.
  Next step(Mesh<2>& mesh, const MetricField<2>& field, const MetricField<2>& target, int iteration);

  /// With `layers`: the edges that are too long. Empty: all have to be looked at.
  [[nodiscard]] const std::vector<std::array<VertexId, 2>>& too_long() const { return too_long_; }

  /// limit_not_met where edges have stayed too long.
  [[nodiscard]] const Status& outcome() const { return outcome_; }
  /// Share of the work believed done, and what is being done.
  [[nodiscard]] double share() const;
  [[nodiscard]] std::string_view activity() const { return activity_; }

 private:
  Next halve(Mesh<2>& mesh, const MetricField<2>& field, int iteration);
  Next insert_layers(const Mesh<2>& mesh, std::vector<std::array<VertexId, 2>> too_long);
  Background& look_up(const Mesh<2>& mesh, const MetricField<2>& target);

  const AdaptOptions& options_;
  Recorder<2>& recorder_;
  std::map<std::string, std::int64_t>& operations_;
  double ideal_cells_;  ///< of the finest mesh; 0 where coarse ones do not come into question
  int halvings_ = 0;    ///< how often the mesh is still to be diced in four
  bool diced_ = false;  ///< the mesh was made from one that had been adapted: it only has to be mended
  CellId cells_before_layers_ = 0;
  std::vector<std::array<VertexId, 2>> too_long_;
  std::vector<Point<2>> points_before_layers_;  ///< effort fast
  std::vector<VertexId> mended_vertices_;       ///< effort fast: that layers of a mended mesh have touched
  int mended_ = 0;  ///< how often edges of this mesh had become too long in the end
  std::unique_ptr<Background> background_;
  int background_coarser_ = 1;  ///< whose sizes it has
  std::unique_ptr<Schedule> schedule_;
  std::string_view activity_;
  Status outcome_;
};

}  // namespace pillowmesh
