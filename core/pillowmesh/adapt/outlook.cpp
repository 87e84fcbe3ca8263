#include "pillowmesh/adapt/outlook.h"

#include <algorithm>
#include <cmath>

namespace pillowmesh {
namespace {

/// Of cells that cost more than this nothing more is known.
double known(double energy) { return std::min(energy, 4.0); }

/// Length of a diagonal of cells, whose edges are added first.
struct Diagonal {
  double g11 = 0.0, g12 = 0.0, g22 = 0.0, scale = 0.0;
  void add(const Mesh<2>& mesh, const QuadRelocator& relocator, CellId c) {
    for (int i = 0; i < 4; ++i) {
      const EdgeTerm& t = relocator.edge(c, i);
      const Point<2> e = mesh.points[around(mesh, c, i + 1)] - mesh.points[around(mesh, c, i)];
      g11 += t.g11, g12 += t.g12, g22 += t.g22;
      scale += t.l * t.l / (t.g11 * e[0] * e[0] + 2.0 * t.g12 * e[0] * e[1] + t.g22 * e[1] * e[1]);
    }
  }
  [[nodiscard]] double length(const Point<2>& e, int cells) const {
    const double q = g11 * e[0] * e[0] + 2.0 * g12 * e[0] * e[1] + g22 * e[1] * e[1];
    return std::sqrt(scale * q) / (4 * cells);
  }
  /// As of an edge (smooth/quad_energy.h).
  [[nodiscard]] double misalignment(const Point<2>& e) const {
    const double t = g11 + g22, det = g11 * g22 - g12 * g12;
    const double r = e.squaredNorm() * det / (g11 * e[0] * e[0] + 2.0 * g12 * e[0] * e[1] + g22 * e[1] * e[1]);
    return 4.0 * (r * (t - r) - det) / (t * t);
  }
};

}  // namespace

const Outlook::Fan& Outlook::fan(VertexId v) {
  if (v >= static_cast<VertexId>(fans_.size())) fans_.resize(mesh_.points.size());
  Fan& f = fans_[v];
  if (f.seen == trial_.changed(v)) return f;
  f = {trial_.changed(v), 0, 0, 0.0};
  if (!find_star(mesh_, v, star_)) return f;
  f.cells = static_cast<std::uint8_t>(star_.count);
  f.spokes = static_cast<std::uint8_t>(star_.count + (star_.closed ? 0 : 1));
  for (int k = 0; k < star_.count; ++k) f.sum += trial_.relocator.edge(star_.cell[k], star_.place[k]).l;
  if (!star_.closed) f.sum += trial_.relocator.edge(star_.cell[star_.count - 1], star_.place[star_.count - 1] + 3).l;
  return f;
}

double Outlook::beyond(VertexId v, int inside, double sum) {
  const Fan& f = fan(v);
  return f.spokes > inside ? (f.sum - sum) / (f.spokes - inside) : 1.0;
}

double Outlook::rotation(CellId c, int i, CellId n, int j, int way, int excess, double allowed) {
  const QuadRelocator& r = trial_.relocator;
  // The outline, counterclockwise from a, and its sides; way 0 joins the second vertex with the fifth.
  std::array<VertexId, 6> v{around(mesh_, n, j + 1), around(mesh_, n, j + 2), around(mesh_, n, j + 3),
                            around(mesh_, c, i + 1), around(mesh_, c, i + 2), around(mesh_, c, i + 3)};
  std::array<double, 6> l{r.edge(n, j + 1).l, r.edge(n, j + 2).l, r.edge(n, j + 3).l,
                          r.edge(c, i + 1).l, r.edge(c, i + 2).l, r.edge(c, i + 3).l};
  const double old = r.edge(c, i).l;
  const int from = way == 0 ? 1 : 2;
  Diagonal diagonal;
  diagonal.add(mesh_, r, c);
  diagonal.add(mesh_, r, n);
  const Point<2> e = mesh_.points[v[from + 3]] - mesh_.points[v[from]];
  const double fresh = diagonal.length(e, 2), turned = r.weights().alignment * (diagonal.misalignment(e) - r.edge(c, i).s);
  const double near = way == 0 ? 0.5 * (l[0] + l[3]) : 0.5 * (l[2] + l[5]);
  const double far = way == 0 ? 0.5 * (l[2] + l[5]) : 0.5 * (l[0] + l[3]);
  const double along = 0.5 * (l[1] + l[4]);
  const double lost = 0.5 * (beyond(v[0], 3, old + l[0] + l[5]) + beyond(v[3], 3, old + l[2] + l[3]));
  const double won = 0.5 * (beyond(v[from], 2, l[from - 1] + l[from]) + beyond(v[from + 3], 2, l[from + 2] + l[(from + 3) % 6]));
  return -3.3 + 2.1 * known(r.energy(c) + r.energy(n)) + 4.7 * allowed - 0.72 * excess - 7.5 * turned + 1.5 * old - 5.4 * near +
         7.1 * along + 2.2 * far - 7.2 * fresh + 14.4 * lost - 8.3 * won;
}

double Outlook::collapse(CellId c, int i, int excess, double allowed) {
  const QuadRelocator& r = trial_.relocator;
  std::array<VertexId, 4> v;
  std::array<double, 4> l, out;
  for (int k = 0; k < 4; ++k) v[k] = around(mesh_, c, i + k), l[k] = r.edge(c, i + k).l;
  for (int k = 0; k < 4; ++k) out[k] = beyond(v[k], 2, l[k] + l[(k + 3) & 3]);
  Diagonal diagonal;
  diagonal.add(mesh_, r, c);
  const Point<2> e = mesh_.points[v[2]] - mesh_.points[v[0]];
  const double closed = diagonal.length(e, 1), turned = r.weights().alignment * diagonal.misalignment(e);
  const double sides = 0.25 * (l[0] + l[1] + l[2] + l[3]), joined = 0.5 * (out[0] + out[2]), across = 0.5 * (out[1] + out[3]);
  return 15.8 + 3.0 * known(r.energy(c)) + 6.0 * allowed - 0.51 * excess - 5.4 * turned + 4.0 * sides - 22.4 * joined +
         12.4 * across - 14.7 * closed;
}

double Outlook::opening(const OrderedStar& star, int first, int last, int excess, double allowed) {
  double along = 0.0, across = 0.0;
  for (int k = 0; k < star.count; ++k) {
    const double l = trial_.relocator.edge(star.cell[k], star.place[k]).l;
    (k == first || k == last % star.count ? along : across) += l;
  }
  along *= 0.5;
  across /= star.count - 2;
  return -25.5 + 7.7 * allowed - 0.55 * excess - 18.9 * along + 24.1 * across + 2.2 * star.count;
}

double Outlook::partial_collapse(int cells, int excess, double allowed, double rungs, double sides) {
  return 6.6 + 0.56 * cells - 0.77 * excess + 2.1 * allowed - (7.7 + 1.2 * (cells - 2)) * rungs - 4.1 * sides;
}

double Outlook::partial_split(int edges, int excess, double allowed, double across, double along) {
  return 22.5 - 17.5 * edges - 0.47 * excess + 5.6 * allowed + (21.9 + 12.5 * (edges - 2)) * across - 19.4 * along;
}

}  // namespace pillowmesh
