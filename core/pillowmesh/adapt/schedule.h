// The order of full adaptation in 2D after the layers: relaxation, passes hot and cold, polish.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "pillowmesh/adapt/balance.h"
#include "pillowmesh/adapt/local_search.h"
#include "pillowmesh/adapt/options.h"
#include "pillowmesh/adapt/recorder.h"
#include "pillowmesh/smooth/quad_descent.h"

namespace pillowmesh {

/// How much is spent. Temperatures fall geometrically.
struct Budget {
  int sweeps = 0, relax_sweeps = 0;  ///< at the beginning: of single vertices; of all at once
  int hot_passes = 0;
  double hot = 0.0, cool = 0.0;
  /// For each cell the hot passes may move so many vertices: where sizes turn and kink, passes are longer, and fewer.
  double hot_moves = std::numeric_limits<double>::infinity();
  int cold_passes = 0;
  double cold_above = 0.0;  ///< energy of the cells that cold passes are for; 0: all
  int rows_every = 1;       ///< so many hot passes whole rows are removed and doubled; after cold ones always
  double row_gain = 0.02;   ///< energy that a row is expected to gain, for each of its cells, to be tried
  CellId rows_up_to = std::numeric_limits<CellId>::max();  ///< cells that the mesh may have for rows
  int polish_rounds = 0;
  int warm_rounds = 0;       ///< of those: from `cool` to a third of it
  int settle_sweeps = 0;     ///< at the end, of all vertices at once
  double least_shape = 0.0;  ///< below it eta is raised at the end, where there is no polish
};

/// Improves a quad mesh that layers have refined, step by step. The mesh is valid between steps; it may hold dead cells
/// and unused vertices (mesh/compact.h).
class Schedule {
 public:
  /// All must outlive it. Cost: linear.
  /// \param diced the mesh was made by dicing an adapted one  \param halvings how often it will be diced afterwards
  /// \param mended vertices that layers have touched since the mesh came out of another schedule: effort fast improves
  /// nothing else. Empty: all
  Schedule(Mesh<2>& mesh, Background& background, const AdaptOptions& options, bool diced, int halvings,
           std::span<const VertexId> mended, Recorder<2>& recorder, std::map<std::string, std::int64_t>& operations,
           int iteration);

  /// A few thousand vertex moves. \return false when all is done.
  bool step();
  /// Share of the work believed done, and what is being done.
  [[nodiscard]] double share() const;
  [[nodiscard]] std::string_view activity() const;
  /// Per vertex whether it may have moved; empty: each may have.
  [[nodiscard]] std::vector<unsigned char> touched() const;

 private:
  enum class Stage { relax, pass, after_pass, polish, settle, done };

  void begin_sweep();
  bool continue_sweep();
  void end_sweep();
  bool descend(int most);
  void next_pass();
  void balance_alignment();
  void end_pass();
  void end_polish_round();
  void adjust_balance();
  bool settle();
  void finish();
  [[nodiscard]] double live_cells() const;
  [[nodiscard]] double cooled() const;
  [[nodiscard]] double temperature() const;
  [[nodiscard]] double polish_temperature(int round) const;
  void count();
  void count(const std::string& name, std::int64_t total);

  Mesh<2>& mesh_;
  const AdaptOptions& options_;
  Recorder<2>& recorder_;
  std::map<std::string, std::int64_t>& operations_;
  int iteration_;
  bool partial_;  ///< for some vertices only
  Budget budget_;
  Balance balance_;
  Trial trial_;
  LocalSearch search_;
  QuadDescent descent_;

  Stage stage_ = Stage::relax;
  int pass_ = 0;      ///< hot and cold
  std::int64_t moves_before_ = 0;  ///< the hot passes
  double hot_moves_ = 1.0;         ///< in them at most
  int polish_ = 0;
  std::map<std::string, std::int64_t> counted_;  ///< of the operations
  int sweeps_ = 0;    ///< in this stage
  bool sweeping_ = false;
  CellId next_cell_ = 0;
  double gain_ = 0.0;  ///< of the sweep
};

}  // namespace pillowmesh
