// Relocation under the energy of quad_energy.h: caches of what edges and cells cost, and Newton steps at one vertex.
#pragma once

#include <vector>

#include "pillowmesh/mesh/boundary.h"
#include "pillowmesh/mesh/cavity.h"
#include "pillowmesh/mesh/ordered_star.h"
#include "pillowmesh/smooth/quad_derivatives.h"

namespace pillowmesh {

/// Unit vector along the curve at a boundary vertex. \pre mesh.support[v].dim == 1
Point<2> curve_direction(const Mesh<2>& mesh, VertexId v);

/// The energy of every cell of a quad mesh, kept up to date where vertices move, and taken back with them.
class QuadRelocator {
 public:
  using Weights = EnergyWeights;

  /// Mesh and background must outlive it. Cost: linear.
  QuadRelocator(Mesh<2>& mesh, Background& background, const Weights& weights);

  [[nodiscard]] double energy(CellId c) const { return energy_[c]; }
  [[nodiscard]] const EdgeTerm& edge(CellId c, int side) const { return edges_[c][side & 3]; }
  [[nodiscard]] double total_energy() const;

  /// Moves the vertex to lower the energy around it; never to where a corner would be inverted.
  /// \return by how much the energy fell.
  double relocate(VertexId v);

  using Derivatives = QuadDerivatives;
  /// Of the corners that a vertex takes part in, but for those opposite to it.
  /// \return false where the vertex cannot be moved because too many cells meet there.
  bool derivatives(VertexId v, Derivatives& out);

  /// Measures everything again, with these weights.
  void measure_all(const Weights& weights);
  [[nodiscard]] const Weights& weights() const { return weights_; }
  /// Mean of sin^2(2 phi) over the sides of cells where the metric is stretched 2 : 1 or more, phi as in the report; 0 where
  /// there are none.
  [[nodiscard]] double misalignment() const;
  /// Cost: energies are added up again, lengths are not measured.
  void set_alignment(double alignment);
  /// Measures sizes at a vertex that is new or was put elsewhere.
  void measure_vertex(VertexId v);
  /// Measures a cell whose corners, or whose vertices, are new. \return its energy
  double measure_cell(CellId c);
  /// The cell is dead: it has no energy. To be called for a change that took it away.
  void forget_cell(CellId c);
  /// While d is regularised by delta > 0, vertices may move to where corners are inverted. Energies of cells are those
  /// without delta only after `refresh`.
  void set_delta(double delta) { weights_.delta = delta; }
  void refresh(CellId c);

  /// From here on everything can be taken back, the mesh's points included: those are undone by their owner.
  void begin();
  void undo();
  /// By how much the energy has grown since begin().
  [[nodiscard]] double change() const;
  /// Told of every vertex before it moves; may be null.
  Journal* journal = nullptr;
  /// Newton steps are lengthened by this.
  double relaxation = 1.0;
  /// A vertex stays where it is when it would gain less than about half of this.
  double rest = 1e-6;

 private:
  using Jet = JetOf<double>;
  static constexpr int kMost = OrderedStar::most + 3;  ///< spokes; the first two come again after the last
  /// The edges at the vertex, counterclockwise, each number in a row of its own.
  struct Spokes {
    std::array<VertexId, kMost> end;
    std::array<double, kMost> qx, qy;     ///< positions of the ends
    std::array<JetOf<double>, kMost> jet;  ///< sizes there
  };
  /// Edge terms, each number in a row of its own.
  template <int N>
  struct Terms {
    std::array<double, N> l, g11, g12, g22, s;
    void set(int k, const EdgeTerm& t) { l[k] = t.l, g11[k] = t.g11, g12[k] = t.g12, g22[k] = t.g22, s[k] = t.s; }
    [[nodiscard]] EdgeTerm get(int k) const { return {l[k], g11[k], g12[k], g22[k], s[k]}; }
    [[nodiscard]] EdgeTermOf<Pair> pair(int k) const {
      return {load(&l[k]), load(&g11[k]), load(&g12[k]), load(&g22[k]), load(&s[k])};
    }
    void store_pair(int k, const EdgeTermOf<Pair>& t) {
      store(&l[k], t.l), store(&g11[k], t.g11), store(&g12[k], t.g12), store(&g22[k], t.g22), store(&s[k], t.s);
    }
    void copy(int from, int to) { set(to, get(from)); }
  };
  /// The cells at the vertex. Its two sides away from the vertex, each as seen from the end of a spoke, that after the
  /// cell's first spoke and, turned around, that before its second: 2 k and 2 k + 1.
  struct Wedges {
    std::array<double, OrderedStar::most> ox, oy;  ///< the opposite vertex
    std::array<Jet, OrderedStar::most> jet;        ///< sizes there
    std::array<double, 2 * OrderedStar::most> fx, fy;
    Terms<2 * OrderedStar::most> far;
    std::array<double, OrderedStar::most> across;  ///< from spoke to spoke, where shapes count
    std::array<double, OrderedStar::most + 1> energy;  ///< of the three corners that change, where the vertex was tried last
  };

  bool collect(VertexId v);
  [[nodiscard]] bool shaped() const { return weights_.shape > 0.0; }
  [[nodiscard]] double length(const Point<2>& p, const Jet& P, const Point<2>& q, const Jet& Q);
  [[nodiscard]] JetOf<Pair> jets(int k) const;
  [[nodiscard]] double try_at(const Point<2>& x, double limit);
  void keep(VertexId v, const Point<2>& x);
  void add_shapes(const Point<2>& x, const Jet& here, Derivatives& sum);
  void touch_cell(CellId c);
  void touch_vertex(VertexId v);
  void add_up(CellId c);

  Mesh<2>& mesh_;
  Background& background_;
  Weights weights_;
  std::vector<Jet> size_;                       ///< per vertex
  std::vector<Index> leaf_;                     ///< of the background, where a vertex was looked up last
  std::vector<std::array<EdgeTerm, 4>> edges_;  ///< per cell and side
  std::vector<double> energy_;                  ///< per cell

  OrderedStar star_;
  Spokes spokes_;
  Terms<kMost> now_, next_;  ///< of the spokes
  Wedges wedges_;
  int spoke_count_ = 0;
  Jet size_at_{};
  Index leaf_at_ = kNone;

  Index stamp_ = 0;
  std::vector<Index> cell_stamp_, vertex_stamp_;
  std::vector<CellId> old_cells_;
  std::vector<std::array<EdgeTerm, 4>> old_edges_;
  std::vector<double> old_energy_;
  std::vector<VertexId> old_vertices_;
  std::vector<Jet> old_sizes_;
};

}  // namespace pillowmesh
