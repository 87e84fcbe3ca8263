#include "pillowmesh/adapt/halving.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pillowmesh/mesh/jacobian.h"
#include "pillowmesh/mesh/overlap.h"
#include "pillowmesh/mesh/slide.h"
#include "pillowmesh/refine/dice.h"

namespace pillowmesh {
namespace {

/// Where an edge is divided in halves of the same length, when a short piece of it at its ends and in the middle is a, b and m
/// times as long as its share: the quadratic through these integrated, by Newton's method from the middle.
double metric_middle(double a, double m, double b) {
  const double linear = 4.0 * m - 3.0 * a - b, square = 2.0 * (a + b) - 4.0 * m;
  const double half = 0.5 * (a + 4.0 * m + b) / 6.0;
  double t = 0.5;
  for (int i = 0; i < 3; ++i) {
    const double density = a + t * (linear + t * square);
    const double length = t * (a + t * (0.5 * linear + t * square / 3.0));
    t = std::clamp(t - (length - half) / std::max(density, 0.1 * std::min(a, std::min(m, b))), 0.1, 0.9);
  }
  return t;
}

/// The vertices that dicing a cell made: corner k of the cell is corner k of its k-th piece.
///
///      2---[1]---3
///      |    |    |      In brackets where an edge comes in `middle`.
///     [2]---+---[3]
///      |    |    |
///      0---[0]---1
struct Pieces {
  std::array<VertexId, 4> corner, middle;
  VertexId center;
  Pieces(const Mesh<2>& mesh, CellId c) {
    for (int k = 0; k < 4; ++k) corner[k] = mesh.cells[4 * c + k][k];
    middle = {mesh.cells[4 * c][1], mesh.cells[4 * c + 3][2], mesh.cells[4 * c][2], mesh.cells[4 * c + 3][1]};
    center = mesh.cells[4 * c][3];
  }
  /// Ends of an edge, from the lower side of its axis.
  [[nodiscard]] std::array<VertexId, 2> ends(int edge) const {
    const int axis = edge >> 1, side = edge & 1, from = side << (1 - axis);
    return {corner[from], corner[from | (1 << axis)]};
  }
};

bool valid(const Mesh<2>& mesh, CellId c) {
  for (int piece = 0; piece < 4; ++piece)
    if (!(min_scaled_jacobian(mesh, 4 * c + piece) > 0.0)) return false;
  const Pieces p(mesh, c);
  const auto folded = [&](VertexId v) { return mesh.support[v].dim < 2 && folded_at(mesh, v); };
  return std::none_of(p.corner.begin(), p.corner.end(), folded) && std::none_of(p.middle.begin(), p.middle.end(), folded);
}

}  // namespace

Status halve_sizes(Mesh<2>& mesh, const MetricField<2>& field) {
  const CellId old_cells = mesh.cell_count();
  const VertexId old_vertices = mesh.vertex_count();
  if (Status s = dice(mesh, 2); !s.ok()) return s;
  const VertexId count = mesh.vertex_count();

  // How far along its edge each new vertex goes; of a cell's middle, along both axes.
  std::vector<SymTensor<2>> metric(count);
  field.evaluate(mesh.points, metric);
  const std::vector<Point<2>> even(mesh.points.begin() + old_vertices, mesh.points.end());
  const std::vector<Index> even_anchor(mesh.anchor.begin() + old_vertices, mesh.anchor.end());
  std::vector<double> along(count - old_vertices, -1.0);  // of an edge as the first cell there sees it
  const auto reset = [&](VertexId v) {
    mesh.points[v] = even[v - old_vertices];
    mesh.anchor[v] = even_anchor[v - old_vertices];
  };
  for (CellId c = 0; c < old_cells; ++c) {
    const Pieces p(mesh, c);
    std::array<double, 4> t;
    for (int edge = 0; edge < 4; ++edge) {
      const auto [a, b] = p.ends(edge);
      const VertexId m = p.middle[edge];
      const Point<2> e = mesh.points[b] - mesh.points[a];
      const auto density = [&](VertexId v) { return std::sqrt(dot(metric[v], e, e)); };
      t[edge] = metric_middle(density(a), density(m), density(b));
      if (along[m - old_vertices] >= 0.0 || mesh.support[m].dim == 0) continue;
      along[m - old_vertices] = t[edge];
      const Point<2> x = mesh.points[m] + (t[edge] - 0.5) * e;
      mesh.points[m] = mesh.support[m].dim == 1 ? slide(*mesh.geometry, mesh.support[m], mesh.anchor[m], x) : x;
    }
    const double u = 0.5 * (t[0] + t[1]), v = 0.5 * (t[2] + t[3]);
    mesh.points[p.center] = (1 - v) * ((1 - u) * mesh.points[p.corner[0]] + u * mesh.points[p.corner[1]]) +
                            v * ((1 - u) * mesh.points[p.corner[2]] + u * mesh.points[p.corner[3]]);
  }

  // Cells that this turned inside out, or laid over others, are divided evenly, and so their neighbours in part.
  for (bool again = true; again;) {
    again = false;
    for (CellId c = 0; c < old_cells; ++c) {
      if (valid(mesh, c)) continue;
      const Pieces p(mesh, c);
      again = again || mesh.points[p.center] != even[p.center - old_vertices];
      reset(p.center);
      for (const VertexId m : p.middle) {
        again = again || mesh.points[m] != even[m - old_vertices];
        reset(m);
      }
    }
  }
  return {};
}

}  // namespace pillowmesh
