// The method's loop, resumable: [Paper] section 4.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pillowmesh/adapt/options.h"
#include "pillowmesh/adapt/trace.h"
#include "pillowmesh/mesh/mesh.h"
#include "pillowmesh/metric/field.h"

namespace pillowmesh {

/// Adapts a mesh to a metric, step by step. The mesh is valid between steps.
template <int Dim>
class Adapter {
 public:
  Adapter(Mesh<Dim> mesh, MetricField<Dim> field, AdaptOptions options, Context context = {});
  ~Adapter();
  Adapter(Adapter&&) noexcept;
  Adapter& operator=(Adapter&&) noexcept;

  /// Does the next piece of work: finds the tags, inserts one layer, relocates once over the mesh, ...
  /// \return false when the run is over (see `outcome`).
  bool step();
  /// Steps until the run is over. \return outcome()
  Status run();

  /// ok; limit_not_met when edges longer than the threshold remain (and why); cancelled; bad_input when the metric is
  /// not usable somewhere. Meaningful when step() has returned false.
  [[nodiscard]] const Status& outcome() const;
  [[nodiscard]] const Mesh<Dim>& mesh() const;
  [[nodiscard]] const MetricField<Dim>& field() const;
  /// Events since the start or the last take_events(); empty unless options.record.
  std::vector<Event<Dim>> take_events();
  /// For the report: wall seconds by stage, and how often each operator ran.
  [[nodiscard]] const std::map<std::string, double>& seconds() const;
  [[nodiscard]] const std::map<std::string, std::int64_t>& operations() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pillowmesh
