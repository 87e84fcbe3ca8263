// A metric in space that is dear to ask, such as one from a large background mesh, approximated by an octree of trilinear
// pieces.
//
// As in metric/background.h what is kept is the size tensor H = M^(-1/2): where sizes grow linearly one piece does.
// Where a piece as small as the sizes in it does not do (a kink, a jump) there is none.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pillowmesh/metric/field.h"

namespace pillowmesh {

struct SizeOctreeOptions {
  /// A piece is used where, between its corners, H is no further than this from the metric's own, relative to H:
  /// |H^-1/2 (interpolated - H) H^-1/2| in the Frobenius norm. About the relative error of a length.
  double tolerance = 2e-3;
  /// A piece is divided while it is wider than this share of the smallest size in it.
  double smallest = 1.0;
  /// Divisions at the most, each of 67 evaluations of the metric; coarse before fine.
  std::size_t divisions = 4000;
};

/// Immutable once made, safe to read from several threads.
class SizeOctree {
 public:
  /// \param low, high the box that it is for
  SizeOctree(const MetricField<3>& field, const Point<3>& low, const Point<3>& high,
             const SizeOctreeOptions& options = {});

  /// Tensors at those of the lanes 0 .. count - 1 where there is a piece; the numbers of the others in `missed`. What is
  /// found depends on the position alone. Does not allocate. Cost: about 20 ns a point. \return the number of the others
  int look_up(const PointLanes<3>& points, int count, TensorLanes<3>& out, std::array<int, kLanes>& missed) const;

  [[nodiscard]] std::size_t pieces() const { return leaves_.size(); }

 private:
  /// The six entries of H: coefficients of u^i v^j w^k at [i + 2 j + 4 k], u, v and w from -1 to 1.
  struct Leaf {
    std::array<std::array<double, 6>, 8> k;
    Point<3> middle, per_length;  ///< u = (p[0] - middle[0]) per_length[0]
  };
  /// A cube: child >= 0: the first of eight nodes; kNone: no piece; else leaf ~child - 1.
  struct Node {
    Index child;
  };
  struct Open {
    Index node;
    Point<3> middle, half;
  };

  void divide(const MetricField<3>& field, const Open& open, double smallest, double tolerance, std::vector<Open>& next);
  [[nodiscard]] Index find(const Point<3>& p) const;

  Point<3> low_, per_cell_;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

/// H = M^(-1/2).
SymTensor<3> size_tensor(const SymTensor<3>& M);

}  // namespace pillowmesh
