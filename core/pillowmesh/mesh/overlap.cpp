#include "pillowmesh/mesh/overlap.h"

#include "pillowmesh/mesh/slide.h"

namespace pillowmesh {
namespace {

/// From v to the vertex that comes `places` after it in the k-th cell of its star.
Point<2> spoke(const Mesh<2>& mesh, VertexId v, const OrderedStar& star, int k, int places) {
  return mesh.points[around(mesh, star.cell[k], star.place[k] + places)] - mesh.points[v];
}

}  // namespace

bool overlaps(const Mesh<2>& mesh, VertexId v, const OrderedStar& star) {
  const Point<2> first = spoke(mesh, v, star, 0, 1);
  bool beyond = false;  // half of a turn
  for (int k = 1; k <= star.count; ++k) {
    if (k == star.count && star.closed) break;
    const Point<2> e = k < star.count ? spoke(mesh, v, star, k, 1) : spoke(mesh, v, star, k - 1, 3);
    const double turned = first[0] * e[1] - first[1] * e[0];
    if (beyond && !(turned < 0)) return true;
    beyond = turned < 0;
  }
  return false;
}

bool goes_back(const Mesh<2>& mesh, VertexId v, const OrderedStar& star) {
  if (star.closed || mesh.support[v].dim != 1) return false;
  // The facets of the geometry have the order of their cells' corners; with the domain on the left it is that of the sign.
  const Point<2> along = mesh.geometry->sign[mesh.anchor[v]] * tangents(mesh, v)[0];
  const Point<2> next = spoke(mesh, v, star, 0, 1), last = spoke(mesh, v, star, star.count - 1, 3);
  return !(along.dot(next) > 0 && along.dot(last) < 0);
}

bool folded_at(const Mesh<2>& mesh, VertexId v) {
  OrderedStar star;
  return find_star(mesh, v, star) && (overlaps(mesh, v, star) || goes_back(mesh, v, star));
}

}  // namespace pillowmesh
