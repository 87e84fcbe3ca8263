// Turns what operators do into events for replay. Does nothing unless switched on.
#pragma once

#include "pillowmesh/adapt/trace.h"
#include "pillowmesh/adapt/trial.h"
#include "pillowmesh/refine/buffer_layer.h"
#include "pillowmesh/refine/layer.h"

namespace pillowmesh {

template <int Dim>
class Recorder {
 public:
  explicit Recorder(bool on) : on_(on) {}

  void tags(const Mesh<Dim>& mesh, const EdgeTags<Dim>& tags, int iteration, double longest_edge);
  /// Before the insertion. `hull` is used as a workspace.
  void layer(const Mesh<Dim>& mesh, const Layer& layer, Hull<Dim>& hull, int iteration);
  /// The last layer was refused: forget it.
  void drop_last();
  /// After the insertion: the shrink and connect events.
  void buffer_layer(const Mesh<Dim>& mesh, const BufferLayer<Dim>& layer, int iteration);
  void iteration(const Mesh<Dim>& mesh, int iteration, double longest_edge);
  void before_relocation(const Mesh<Dim>& mesh);
  void relocation(const Mesh<Dim>& mesh, int iteration, double energy);
  void before_dice(const Mesh<Dim>& mesh);
  void dice(const Mesh<Dim>& mesh, int iteration);

  /// A change of topology by full adaptation, with the relocation around it; 2D only.
  void change(Operator op, const Mesh<Dim>& mesh, const Journal& journal, const Cavity& cavity, int iteration);

  std::vector<Event<Dim>> take();

 private:
  Event<Dim>& add(EventKind kind, const Mesh<Dim>& mesh, int iteration);

  bool on_;
  std::vector<Event<Dim>> events_;
  std::vector<Point<Dim>> old_points_;
  std::vector<Corners<Dim>> old_cells_;
};

}  // namespace pillowmesh
