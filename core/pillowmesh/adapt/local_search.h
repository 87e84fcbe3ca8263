// Full adaptation in 2D: changes of topology are tried one by one, relaxed, and kept when the energy falls.
#pragma once

#include <array>
#include <vector>

#include "pillowmesh/adapt/random.h"
#include "pillowmesh/mesh/cavity.h"
#include "pillowmesh/mesh/chord.h"
#include "pillowmesh/smooth/quad_relocate.h"

namespace pillowmesh {

enum class Operator : std::uint8_t { rotate, collapse, open, chord_collapse, chord_split };
inline constexpr int kOperators = 5;

class LocalSearch {
 public:
  struct Options {
    double alignment = 0.0;
    std::uint64_t seed = 1;
  };
  LocalSearch(Mesh<2>& mesh, Background& background, const Options& options);

  /// One pass over all candidates; temperature in units of one ideal cell. \return the changes made.
  std::int64_t pass(double temperature);
  /// Changes of whole chords. \return the changes made.
  std::int64_t chord_pass();
  /// Relocates every vertex once. \return by how much the energy fell.
  double sweep();

  /// Every candidate is news again.
  void forget() { ++clock_; changed_.assign(mesh_.points.size(), clock_); }
  [[nodiscard]] double energy() const { return relocator_.total_energy(); }
  QuadRelocator& relocator() { return relocator_; }

  struct Count {
    std::int64_t planned = 0, tried = 0, early = 0, tangled = 0, done = 0;
  };
  std::array<Count, kOperators> counts{};
  std::int64_t moves = 0, chords_seen = 0, chords_crossing = 0; double chord_low = .97, chord_high = 1.03;
  int sweeps_near = 4, sweeps_far = 2;
  double potential = 0.0, hope_open = 2.0;
  double chance2 = 1.0, chance0 = 1.0, hope_near = 2.0, hope_far = 1.0;

 private:
  bool attempt(Operator op, double threshold);
  bool legal();
  bool remove_doublets();
  bool untangle();
  void collect_near();
  void grow(const std::vector<VertexId>& from, std::vector<VertexId>& to);
  double relax(const std::vector<VertexId>& vertices);
  [[nodiscard]] int valence(VertexId v);
  [[nodiscard]] int ideal(VertexId v) const { return ideal_[v]; }
  [[nodiscard]] int excess(VertexId v, int change);
  [[nodiscard]] bool interesting(CellId c);

  Mesh<2>& mesh_;
  Options options_;
  QuadRelocator relocator_;
  Journal journal_;
  Random random_;
  Cavity cavity_, doublet_;
  std::vector<CellId> new_ids_, doublet_ids_;
  std::vector<VertexId> near_, far_;
  std::vector<Index> stamp_;
  Index stamp_now_ = 0;
  std::vector<std::int8_t> ideal_;
  std::vector<Index> changed_;   ///< per vertex: when its surroundings last changed
  std::vector<Index> looked_;    ///< per cell: when its candidates were last tried without success
  Index clock_ = 1;
  std::vector<std::uint8_t> marks_;
  Chord chord_;
  QuadStar star_;
};

}  // namespace pillowmesh
