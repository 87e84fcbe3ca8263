// One change of topology, tried: planned by an operator, done, relaxed, and kept or taken back by what it does to the
// energy.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "pillowmesh/mesh/cavity.h"
#include "pillowmesh/smooth/quad_relocate.h"

namespace pillowmesh {

enum class Operator : std::uint8_t {
  rotate,
  collapse,
  open,
  chord_collapse,
  chord_split,
  boundary_collapse,
  boundary_open,
  partial_chord_collapse,
  partial_chord_split,
};
inline constexpr int kOperators = 9;

class Trial {
 public:
  /// The mesh and the background must outlive it. Cost: linear.
  Trial(Mesh<2>& mesh, Background& background, const QuadRelocator::Weights& weights);

  /// Does what `cavity` plans, removes doublets that it leaves, untangles, relocates the vertices around, and keeps the
  /// result when the energy has grown by less than `threshold` (which may be negative). Else the mesh is bit for bit
  /// what it was. Changes without hope are given up early. Cost: the cells touched.
  bool attempt(Operator op, double threshold);

  /// The same for a change that the whole mesh has to make room for: all vertices are relocated at once, a few times.
  /// Cost: the size of the mesh.
  bool attempt_at_large(Operator op, double threshold);

  /// The next sweep is over all vertices again.
  void begin_sweep();
  /// Relocates the touched vertices of cells first to last - 1, those that this sweep has not come to yet, once.
  /// \return by how much the energy fell.
  double sweep(CellId first, CellId last);

  /// Relocates the vertices of touched cells with an eta below this a few times, for their shapes. Cost: linear, without
  /// what moves.
  void mend_shapes(double eta);

  /// Cells that a vertex should have: 4 inside, 2 on a curve, at a corner as many as fill it with right angles.
  [[nodiscard]] int ideal(VertexId v) const { return ideal_[v]; }
  /// When the surroundings of v last changed, in terms of `clock`.
  [[nodiscard]] Index changed(VertexId v) const { return changed_[v]; }
  Index tick() { return ++clock_; }
  void touch_all();
  /// From here on sweeps and `mend_shapes` are for these vertices alone, for those of changes that are kept, and for those
  /// that are mended with them.
  void touch_only(std::span<const VertexId> vertices);
  /// Whether they are for v, too.
  [[nodiscard]] bool touched(VertexId v) const { return !partial_ || changed_[v] != kUntouched; }
  /// No change comes any more, sweeps alone: gives back what only changes need.
  void release();

  /// No cell that `attempt` or `mend_shapes` changes may have a longer edge afterwards, whatever it had before.
  double longest_allowed = std::numeric_limits<double>::infinity();

  /// A change is relaxed so often before it may be kept, unless there is nothing left to gain. Once: sooner, and sweeps
  /// that come later have more to do.
  int least_sweeps = 2;

  Cavity cavity;
  QuadRelocator relocator;
  /// Told of every change that was kept, while the journal still knows the mesh before it.
  std::function<void(Operator, const Journal&)> kept;

  struct Count {
    std::int64_t tried = 0, hopeless = 0, tangled = 0, kept = 0;
  };
  std::array<Count, kOperators> counts{};
  /// By how much the change that `attempt` refused last would have raised the energy at least: infinite where it could not be
  /// untangled, -infinite where it was illegal, and nothing is known.
  double refused_growth = 0.0;
  std::int64_t moves = 0;  ///< vertices that relocation was tried at

 private:
  [[nodiscard]] int valence(VertexId v) { return find_star(mesh_, v, star_) ? star_.count : 0; }
  bool change_topology();
  bool remove_doublets();
  bool valences_allow();
  bool measure();
  bool untangle();
  [[nodiscard]] bool folded(const std::vector<VertexId>& vertices) const;
  void collect_near();
  void collect_far(int rings);
  double relax(const std::vector<VertexId>& vertices);
  void keep(Operator op, const std::vector<VertexId>& changed);

  Mesh<2>& mesh_;
  Journal journal_;
  Cavity doublet_;
  std::vector<CellId> new_ids_, doublet_ids_;
  std::vector<VertexId> near_, far_;  ///< the vertices of the change; those, and some rings around them
  std::vector<Index> stamp_;
  Index stamp_now_ = 0;
  std::vector<Index> swept_;
  Index sweep_ = 0;
  std::vector<std::int8_t> ideal_;
  static constexpr Index kUntouched = -2;  // no time, and not what stands for none
  std::vector<Index> changed_;
  bool partial_ = false;  ///< some are kUntouched
  Index clock_ = 1;
  OrderedStar star_;
};

}  // namespace pillowmesh
