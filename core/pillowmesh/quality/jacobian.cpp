#include "pillowmesh/quality/jacobian.h"

#include <cmath>

#include "pillowmesh/mesh/jacobian.h"

namespace pillowmesh {

template <int Dim>
double scaled_jacobian(const Mesh<Dim>& mesh, CellId c) {
  const auto position = [&](int k) -> const Point<Dim>& { return mesh.points[mesh.cells[c][k]]; };
  double least = 1.0;
  for (int k = 0; k < Cell<Dim>::corners; ++k) {
    double lengths = 1.0;
    for (int d = 0; d < Dim; ++d) {
      double square = 0.0;
      for (int i = 0; i < Dim; ++i) {
        const double e = position(k ^ (1 << d))[i] - position(k)[i];
        square += e * e;
      }
      lengths *= std::sqrt(square);
    }
    const double scaled = lengths > 0.0 ? corner_jacobian<Dim>(k, position) / lengths : 0.0;
    if (!(scaled >= least)) least = scaled;
  }
  return least;
}

template double scaled_jacobian<2>(const Mesh<2>&, CellId);
template double scaled_jacobian<3>(const Mesh<3>&, CellId);

}  // namespace pillowmesh
