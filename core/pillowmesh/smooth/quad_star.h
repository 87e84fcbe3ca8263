// The quadrilaterals at one vertex, as the smoother sees them: their energy (energy.h) and its derivatives with respect
// to the position of the vertex.
#pragma once

#include <vector>

#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/field.h"
#include "pillowmesh/smooth/energy.h"

namespace pillowmesh {

/// The star of one vertex at a time.
class QuadStar {
 public:
  /// \param field scaled to the target length. The mesh must outlive this; its topology must not change meanwhile.
  QuadStar(const Mesh<2>& mesh, const MetricField<2>& field);

  /// Takes up vertex v.
  void visit(VertexId v);
  /// Looks at the vertex as if it were at `position`: what follows is about that place.
  void look_at(const Point<2>& position);
  /// Energy of all corners whose edges depend on the vertex; infinite where one is degenerate or inside out.
  [[nodiscard]] double energy() const;
  [[nodiscard]] Derivatives<2> derivatives() const;
  /// The metric there.
  [[nodiscard]] const SymTensor<2>& metric() const { return here_.M; }
  /// The vertex has been moved there.
  void settle() { metric_[vertex_] = here_; }

  /// Squared length of the shortest edge there.
  [[nodiscard]] double shortest2() const;
  /// Calls f(w) for the vertices whose energy depends on where this one is.
  template <class F>
  void for_each_dependent(F&& f) const {
    for (const auto& [c, corner] : star_)
      for (const VertexId w : mesh_.cells[c]) f(w);
  }

 private:
  /// An edge at the vertex.
  struct Spoke {
    VertexId end;
    double length;  ///< integrated
    double here;    ///< length in the metric at the vertex
    double middle;  ///< length in the metric in its middle
    double there;   ///< length in the metric at its other end
    bool varies;    ///< these differ a lot
  };
  /// A corner at the vertex.
  struct Corner {
    std::array<std::int8_t, 2> spoke;  ///< position in spokes_ of each edge
    std::int8_t sign;
  };
  /// A corner at the far end of a spoke; only its edge to the vertex moves.
  struct FarCorner {
    VertexId origin;
    std::array<VertexId, 2> ends;
    std::int8_t sign, end, spoke;
    HeldCorner<2> held;
  };

  int spoke_to(VertexId w);
  void hold_far_corners();

  const Mesh<2>& mesh_;
  MetricField<2> field_;
  std::vector<CornerMetric<2>> metric_;  ///< per vertex
  VertexId vertex_ = kNone;
  Point<2> position_;
  CornerMetric<2> here_;
  std::vector<CellCorner> star_;
  std::vector<Corner> corners_;
  std::vector<FarCorner> far_corners_;
  std::vector<Spoke> spokes_;
  std::vector<Point<2>> sample_points_;
  std::vector<SymTensor<2>> samples_;
};

}  // namespace pillowmesh
