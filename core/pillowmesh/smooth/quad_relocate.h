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
  /// What the report would say, from what is cached.
  struct Indicators {
    double spread = 0.0;        ///< cv of the metric lengths of edges
    double lack = 0.0;          ///< mean of 1 - eta
    double misalignment = 0.0;  ///< as above
  };
  [[nodiscard]] Indicators indicators() const;
  /// Cost: energies are added up again, lengths are not measured.
  void set_alignment(double alignment);
  /// Measures sizes at a vertex that is new or was put elsewhere.
  void measure_vertex(VertexId v);
  /// Measures a cell whose corners, or whose vertices, are new. \return its energy
  double measure_cell(CellId c);
  /// Cells with an eta, as `lack` has it, below this. Cost: linear.
  [[nodiscard]] std::vector<CellId> cells_below(double eta) const;
  /// The cell is dead: it has no energy. To be called for a change that took it away.
  void forget_cell(CellId c);
  /// While d is regularised by delta > 0, vertices may move to where corners are inverted. Energies of cells are those
  /// without delta only after `refresh`.
  void set_delta(double delta) { weights_.delta = delta; }
  /// The same holds for the weight of shapes.
  void set_shape(double weight) { weights_.shape = weight; }
  void refresh(CellId c);
  /// Of all cells that have changed since begin(). \return the largest energy among them
  double refresh_changed();
  /// The length of the longest edge of those cells.
  [[nodiscard]] double longest_changed() const;

  /// From here on everything can be taken back, the mesh's points included: those are undone by their owner.
  void begin();
  /// The same, but what follows, until the next begin(), cannot be taken back: no copies are kept.
  void begin_for_good();
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
  static constexpr int kMost = OrderedStar::most + 8;  ///< spokes; the first come again after the last
  using Row = std::array<double, kMost>;
  /// Sizes and their derivatives.
  template <int N>
  struct Jets {
    std::array<double, N> a, b, c, ax, bx, cx, ay, by, cy;
    void set(int k, const Jet& j) {
      a[k] = j.a, b[k] = j.b, c[k] = j.c;
      ax[k] = j.ax, bx[k] = j.bx, cx[k] = j.cx, ay[k] = j.ay, by[k] = j.by, cy[k] = j.cy;
    }
    [[nodiscard]] Jet get(int k) const { return {a[k], b[k], c[k], ax[k], bx[k], cx[k], ay[k], by[k], cy[k]}; }
    template <class R>
    [[nodiscard]] PILLOWMESH_LANES JetOf<R> lanes(int k) const {
      return {load<R>(&a[k]),  load<R>(&b[k]),  load<R>(&c[k]),  load<R>(&ax[k]), load<R>(&bx[k]),
              load<R>(&cx[k]), load<R>(&ay[k]), load<R>(&by[k]), load<R>(&cy[k])};
    }
  };
  /// The edges at the vertex, counterclockwise, each number in a row of its own.
  struct Spokes {
    std::array<VertexId, kMost> end;
    Row qx, qy;       ///< positions of the ends
    Jets<kMost> jet;  ///< sizes there
    std::array<Index, 2 * kMost> hints;  ///< where points on the spokes are looked for: where they were before
  };
  /// Edge terms, each number in a row of its own.
  template <int N>
  struct Terms {
    std::array<double, N> l, g11, g12, g22, s;
    void set(int k, const EdgeTerm& t) { l[k] = t.l, g11[k] = t.g11, g12[k] = t.g12, g22[k] = t.g22, s[k] = t.s; }
    [[nodiscard]] EdgeTerm get(int k) const { return {l[k], g11[k], g12[k], g22[k], s[k]}; }
    template <class R>
    [[nodiscard]] PILLOWMESH_LANES EdgeTermOf<R> lanes(int k) const {
      return {load<R>(&l[k]), load<R>(&g11[k]), load<R>(&g12[k]), load<R>(&g22[k]), load<R>(&s[k])};
    }
    template <class R>
    [[nodiscard]] PILLOWMESH_LANES EdgeTermOf<R> ends_from(int k) const {
      return {ends<R>(&l[k]), ends<R>(&g11[k]), ends<R>(&g12[k]), ends<R>(&g22[k]), ends<R>(&s[k])};
    }
    template <class R>
    PILLOWMESH_LANES void store_lanes(int k, const EdgeTermOf<R>& t) {
      store(&l[k], t.l), store(&g11[k], t.g11), store(&g12[k], t.g12), store(&g22[k], t.g22), store(&s[k], t.s);
    }
    void copy(int from, int to) { set(to, get(from)); }
  };
  /// The cells at the vertex. Its two sides away from the vertex, each as seen from the end of a spoke, that after the
  /// cell's first spoke and, turned around, that before its second: 2 k and 2 k + 1.
  struct Wedges {
    std::array<double, OrderedStar::most> ox, oy;  ///< the opposite vertex
    std::array<Jet, OrderedStar::most> jet;        ///< sizes there
    std::array<double, 2 * OrderedStar::most + 2> fx, fy;
    Terms<2 * OrderedStar::most + 2> far;
    std::array<double, OrderedStar::most> across;  ///< from spoke to spoke, where shapes count
    std::array<double, OrderedStar::most + 1> energy;  ///< of the three corners that change, where the vertex was tried last
  };
  /// The vertices and sides of a cell, counterclockwise twice.
  struct Sides {
    std::array<double, 8> px, py, ex, ey;
    Jets<8> jet;
    Terms<8> term;
  };

  bool collect(VertexId v);
  [[nodiscard]] bool shaped() const { return weights_.shape > 0.0; }
  [[nodiscard]] double least_squared_shape(CellId c) const;
  bool folds_at(VertexId v, const Point<2>& x, Index anchor);
  [[nodiscard]] double length(const Point<2>& p, const Jet& P, const Point<2>& q, const Jet& Q) const;
  /// The spoke that comes again as number k.
  [[nodiscard]] int again(int k) const { return k < spoke_count_ ? k : (star_.closed ? k % spoke_count_ : spoke_count_ - 1); }
  /// Spokes that are there for four lanes from any fourth on, and one more.
  [[nodiscard]] int padded() const { return ((spoke_count_ + 3) & ~3) + 1; }
  /// Of the spokes from k on.
  [[nodiscard]] EdgeLookup look_up(int k) { return {background_, &spokes_.hints[2 * k], spoke_count_ - k}; }
  [[nodiscard]] double try_at(const Point<2>& x, double limit);
  template <class R>
  [[nodiscard]] PILLOWMESH_LANES double sum_of_corners(const Point<2>& x, const Row& ex, const Row& ey, double limit);
  template <class R>
  PILLOWMESH_LANES void add_corners(VertexId v, const Point<2>& x, Derivatives& sum);
  template <class R>
  PILLOWMESH_LANES void measure_sides(Index leaf);
  template <class R>
  [[nodiscard]] PILLOWMESH_LANES double sum_of_cell() const;
#if defined(PILLOWMESH_WIDE)
  void wide_measure_sides(Index leaf);
  [[nodiscard]] double wide_sum_of_cell() const;
  [[nodiscard]] double wide_sum_of_corners(const Point<2>& x, const Row& ex, const Row& ey, double limit);
  void wide_add_corners(VertexId v, const Point<2>& x, Derivatives& sum);
#endif
  void keep(VertexId v, const Point<2>& x);
  void add_shapes(const Point<2>& x, const Jet& here, Derivatives& sum);
  void touch_cell(CellId c);
  void touch_vertex(VertexId v);
  void place_sides(CellId c);
  [[nodiscard]] double add_up(CellId c) const;

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
  Sides sides_;
  int spoke_count_ = 0;
  Jet size_at_{};
  Index leaf_at_ = kNone;

  bool for_good_ = false;
  Index stamp_ = 0;
  std::vector<Index> cell_stamp_, vertex_stamp_;
  std::vector<CellId> old_cells_;
  std::vector<std::array<EdgeTerm, 4>> old_edges_;
  std::vector<double> old_energy_;
  std::vector<VertexId> old_vertices_;
  std::vector<Jet> old_sizes_;
};

}  // namespace pillowmesh
