// The hexahedra at one vertex, as the smoother sees them: their energy (energy.h) and its derivatives with respect to
// the position of the vertex.
//
// Everything is said by Gram matrices G = A' M A of the corners: with the lengths and angles of the edges in the
// metric, f = tr G + tr G^-1, where tr G^-1 = (sum of the principal 2 x 2 minors of G) / det G and det G = det M d^2.
// Of a corner at the far end of an edge only that edge e moves; then T = tr G and the sum N of the minors are quadratic
// in e and d is linear, with coefficients that are found once per visit.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "pillowmesh/mesh/topology.h"
#include "pillowmesh/metric/field.h"
#include "pillowmesh/smooth/energy.h"
#include "pillowmesh/smooth/star_table.h"

namespace pillowmesh {

/// The star of one vertex at a time.
class HexStar {
 public:
  /// \param field scaled to the target length. The mesh must outlive this; its topology must not change meanwhile.
  HexStar(const Mesh<3>& mesh, const MetricField<3>& field);

  /// Takes up vertex v.
  void visit(VertexId v);
  /// Looks at the vertex as if it were at `position`: what follows is about that place. One batch of metric
  /// evaluations.
  void look_at(const Point<3>& position);
  /// Energy of all corners whose edges depend on the vertex; infinite where one is degenerate or inside out.
  [[nodiscard]] double energy();
  /// The same with its gradient and Hessian. The gradient includes what the change of the metric from place to place
  /// does to lengths and angles, as far as the metrics found in the middles of the edges tell. The Hessian is that of
  /// the metric held fixed.
  [[nodiscard]] Derivatives<3> derivatives();
  /// True if some scaled Jacobian is below `floor` at the place for which energy() was asked last.
  [[nodiscard]] bool below(double floor) const;
  /// The smallest scaled Jacobian there.
  [[nodiscard]] double lowest_scaled_jacobian() const;
  /// The metric there.
  [[nodiscard]] const SymTensor<3>& metric() const { return here_.M; }
  /// The vertex has been moved there.
  void settle() { metric_[vertex_] = here_; }

  /// Squared length of the shortest edge there.
  [[nodiscard]] double shortest2() const;
  /// Calls f(w) for the vertices whose energy depends on where this one is.
  template <class F>
  void for_each_dependent(F&& f) const {
    f(vertex_);
    for (const VertexId w : spoke_vertices_) f(w);
    for (const StarFacet& q : facets_) f(q.diagonal);
  }

 private:
  using Vector = std::array<double, 3>;
  struct VertexMetric {
    SymTensor<3> M;
    double root;     ///< of det M
    double inverse;  ///< 1 / det M
  };
  static VertexMetric vertex_metric(const SymTensor<3>& M);
  /// A symmetric matrix in the packing of SymTensor.
  struct Symmetric {
    std::array<double, 6> m{};
    /// += s a a'
    void add_square(double s, const Vector& a) {
      const double x = s * a[0], y = s * a[1], z = s * a[2];
      m[0] += x * a[0];
      m[1] += x * a[1];
      m[2] += y * a[1];
      m[3] += x * a[2];
      m[4] += y * a[2];
      m[5] += z * a[2];
    }
    /// += a b' + b a'
    void add_product(const Vector& a, const Vector& b) {
      m[0] += 2.0 * a[0] * b[0];
      m[1] += a[0] * b[1] + a[1] * b[0];
      m[2] += 2.0 * a[1] * b[1];
      m[3] += a[0] * b[2] + a[2] * b[0];
      m[4] += a[1] * b[2] + a[2] * b[1];
      m[5] += 2.0 * a[2] * b[2];
    }
    void add(double s, const std::array<double, 6>& other) {
      for (int i = 0; i < 6; ++i) m[i] += s * other[i];
    }
  };
  /// What the derivatives of the corners at a spoke add up to.
  struct Sums {
    Vector far{};         ///< gradient of the far corners with respect to the edge
    Symmetric rest;       ///< their Hessian but for
    double metric = 0.0;  ///< this times the metric there
    double near = 0.0;    ///< gradient of the near corners: this times near_m
    double length = 0.0;  ///< derivative of the near corners by the logarithm of the length
    double angle = 0.0;   ///< what the near corners' angles change by the squared length in the metric here
  };

  /// An edge at the vertex, and what its length was found to be.
  struct Spoke {
    Vector u;                    ///< from the vertex
    double length;               ///< integrated
    double here, middle, there;  ///< lengths in the metric at the vertex, in the middle, at the other end
    bool varies;                 ///< these differ a lot: then also at the quarters
    std::array<double, 2> quarter;
    std::array<Vector, 2> quarter_m;  ///< the metric there times u; in the middle:
    Vector middle_m;
    double near2, far2;   ///< squared Euclidean lengths of near and far
    Vector near, near_m;  ///< u scaled to the length as seen from here, and M times it
    Vector far, far_m;    ///< -u scaled to the length as seen from there, and the metric there times it
    Sums sum;
  };
  /// An edge from the end of a spoke across a facet, scaled to its length as seen from there.
  struct OuterEdge {
    Vector e, m;     ///< m: the metric times e
    double length2;  ///< in the metric
    double euclid2;
  };
  /// A corner at the end of a spoke.
  struct FarCorner {
    Vector c;         ///< d = c . e
    double t, minor;  ///< T = t + e.e, N = minor + t e.e - (e.m0)^2 - (e.m1)^2 in the metric
    std::int16_t spoke, outer0, outer1;
    double d, p0, p1, N;  ///< at the place looked at
  };

  void hold();
  void add_change_of_metric(Vector& gradient);

  const Mesh<3>& mesh_;
  MetricField<3> field_;  ///< approximated
  StarTable table_;
  std::vector<VertexMetric> metric_;  ///< per vertex
  VertexId vertex_ = kNone;
  VertexMetric here_;
  std::span<const VertexId> spoke_vertices_;
  std::span<const StarFacet> facets_;
  std::span<const StarCorner> corners_;
  std::vector<Spoke> spokes_;
  std::vector<OuterEdge> outer_;
  std::vector<FarCorner> far_;
  std::vector<double> products_;  ///< e_a M e_b of each facet, then d of each corner
  /// Of each facet: the factor of its part of the Hessian, and the derivative by its product.
  std::vector<std::array<double, 2>> facet_sums_;
  std::vector<Point<3>> sample_points_;
  std::vector<SymTensor<3>> samples_, middle_;
};

}  // namespace pillowmesh
