#include "pillowmesh/reconnect/partial_chord_split.h"

#include <algorithm>

#include "pillowmesh/mesh/ordered_star.h"

namespace pillowmesh {

bool plan_partial_chord_split(const Mesh<2>& mesh, const std::vector<VertexId>& path, int way, Cavity& cavity) {
  const int edges = static_cast<int>(path.size()) - 1;
  if (edges < 2) return false;
  cavity.clear();
  for (std::size_t i = 0; i < path.size(); ++i)
    if (std::find(path.begin(), path.begin() + i, path[i]) != path.begin() + i) return false;
  OrderedStar star;
  for (int i = 1; i < edges; ++i) {
    const VertexId v = path[i];
    if (mesh.support[v].dim != 2 || !find_star(mesh, v, star) || !star.closed) return false;
    const auto spoke = [&](int k) { return around(mesh, star.cell[k % star.count], star.place[k % star.count] + 1); };
    int first = 0, last = 0;
    while (first < star.count && spoke(first) != path[i - 1]) ++first;
    while (last < star.count && spoke(last) != path[i + 1]) ++last;
    if (first == star.count || last == star.count) return false;
    if (last < first) last += star.count;
    // Counterclockwise from the edge that comes to the one that leaves is the right side. A rung ends at all copies but one
    // at each end.
    const int right = last - first, left = star.count - right;
    const int begins = i == 1 ? 1 : 0, ends = i == edges - 1 ? 1 : 0;
    if (right + 2 - (way == 0 ? begins : ends) < 3 || left + 2 - (way == 0 ? ends : begins) < 3) return false;
    // Both copies leave v toward the spokes that are theirs, or away from those of the other.
    const Point<2>& x = mesh.points[v];
    Point<2> to_right = Point<2>::Zero(), to_left = Point<2>::Zero();
    for (int k = first + 1; k < last; ++k) to_right += (mesh.points[spoke(k)] - x) / (right - 1);
    for (int k = last + 1; k < first + star.count; ++k) to_left += (mesh.points[spoke(k)] - x) / (left - 1);
    if (right == 1) to_right = -0.5 * to_left;
    if (left == 1) to_left = -0.5 * to_right;
    const VertexId w = Cavity::new_vertex(i - 1);
    cavity.new_vertices.push_back({x + 0.25 * to_right, mesh.support[v], kNone});
    cavity.moved.push_back(v);
    cavity.moved_to.push_back(x + 0.25 * to_left);
    for (int k = 0; k < star.count; ++k) {
      const CellId c = star.cell[k];
      auto at = std::find(cavity.old_cells.begin(), cavity.old_cells.end(), c);
      if (at == cavity.old_cells.end()) {
        cavity.new_cells.push_back(mesh.cells[c]);
        at = cavity.old_cells.insert(at, c);
      }
      if (mesh.region[c] != mesh.region[cavity.old_cells[0]]) return false;
      if (k < right + first - star.count || (k >= first && k < last))
        cavity.new_cells[at - cavity.old_cells.begin()][kAround[star.place[k]]] = w;
    }
  }
  const auto left = [&](int i) { return path[i]; };
  const auto right = [&](int i) { return i == 0 || i == edges ? path[i] : Cavity::new_vertex(i - 1); };
  for (int i = 0; i + 1 < edges; ++i)
    cavity.new_cells.push_back(way == 0 ? quad(left(i), right(i + 1), right(i + 2), left(i + 1))
                                        : quad(left(i + 1), right(i), right(i + 1), left(i + 2)));
  cavity.around = path;
  return true;
}

}  // namespace pillowmesh
