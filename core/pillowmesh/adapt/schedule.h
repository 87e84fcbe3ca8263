// The order of full adaptation in 2D after the layers: relaxation, passes hot and cold, polish.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "pillowmesh/adapt/local_search.h"
#include "pillowmesh/adapt/options.h"
#include "pillowmesh/adapt/recorder.h"
#include "pillowmesh/smooth/quad_descent.h"

namespace pillowmesh {

/// Improves a quad mesh that layers have refined, step by step. The mesh is valid between steps; it may hold dead cells
/// and unused vertices (mesh/compact.h).
class Schedule {
 public:
  /// All must outlive it. Cost: linear.
  Schedule(Mesh<2>& mesh, const MetricField<2>& field, const AdaptOptions& options, Recorder<2>& recorder,
           std::map<std::string, std::int64_t>& operations, int iteration);

  /// A few thousand vertex moves. \return false when all is done.
  bool step();
  /// Share of the work believed done, and what is being done.
  [[nodiscard]] double share() const;
  [[nodiscard]] std::string_view activity() const;

 private:
  enum class Stage { relax, pass, after_pass, polish, settle, done };

  void begin_sweep();
  bool continue_sweep();
  void end_sweep();
  bool descend(int most);
  void next_pass();
  void end_pass();
  void end_polish_round();
  [[nodiscard]] double temperature(int pass) const;
  void count();

  Mesh<2>& mesh_;
  const AdaptOptions& options_;
  Recorder<2>& recorder_;
  std::map<std::string, std::int64_t>& operations_;
  int iteration_;
  Background background_;
  Trial trial_;
  LocalSearch search_;
  QuadDescent descent_;

  Stage stage_ = Stage::relax;
  int hot_passes_ = 0, cold_passes_ = 0;
  int pass_ = 0;      ///< hot and cold
  int polish_ = 0;
  int sweeps_ = 0;    ///< in this stage
  bool sweeping_ = false;
  VertexId next_vertex_ = 0;
  double gain_ = 0.0;  ///< of the sweep
};

}  // namespace pillowmesh
