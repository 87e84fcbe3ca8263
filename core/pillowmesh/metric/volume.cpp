#include "pillowmesh/metric/volume.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pillowmesh {
namespace {

// Gauss's rules on [0, 1].
constexpr double kNode2[2] = {0.2113248654051871177454256, 0.7886751345948128822545744};
constexpr double kNode3[3] = {0.1127016653792583114820735, 0.5, 0.8872983346207416885179265};
constexpr double kWeight3[3] = {0.2777777777777777777777778, 0.4444444444444444444444444, 0.2777777777777777777777778};

constexpr int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

// Weights of the 3^Dim points, axis 0 running fastest.
template <int Dim>
constexpr std::array<double, power(3, Dim)> product_weights() {
  std::array<double, power(3, Dim)> weights{};
  for (int k = 0; k < power(3, Dim); ++k) {
    weights[k] = 1.0;
    for (int d = 0, rest = k; d < Dim; ++d, rest /= 3) weights[k] *= kWeight3[rest % 3];
  }
  return weights;
}

template <int Dim>
Point<Dim> between(const Point<Dim>& a, const Point<Dim>& b, double t) {
  Point<Dim> p;
  for (int i = 0; i < Dim; ++i) p[i] = a[i] + t * (b[i] - a[i]);
  return p;
}

// The maps of the unit square or cube: calls visit(point, Jacobian determinant) at the n^Dim points whose local coordinates
// along axis d are among t[d], axis 0 running fastest. What an axis has in common is computed once.
template <class Visit>
void map_grid(const CornerPoints<2>& p, int n, const double (*t)[3], Visit&& visit) {
  const Point<2> low1 = p[2] - p[0], high1 = p[3] - p[1];
  for (int j = 0; j < n; ++j) {
    const Point<2> low = between<2>(p[0], p[2], t[1][j]), high = between<2>(p[1], p[3], t[1][j]), d0 = high - low;
    for (int i = 0; i < n; ++i) {
      const Point<2> d1 = between<2>(low1, high1, t[0][i]);
      visit(between<2>(low, high, t[0][i]), d0[0] * d1[1] - d0[1] * d1[0]);
    }
  }
}
template <class Visit>
void map_grid(const CornerPoints<3>& p, int n, const double (*t)[3], Visit&& visit) {
  std::array<Point<3>, 4> along2, plane;
  for (int k = 0; k < 4; ++k) along2[k] = p[k + 4] - p[k];
  for (int l = 0; l < n; ++l) {
    for (int k = 0; k < 4; ++k) plane[k] = between<3>(p[k], p[k + 4], t[2][l]);
    const Point<3> low1 = plane[2] - plane[0], high1 = plane[3] - plane[1];
    for (int j = 0; j < n; ++j) {
      const double v = t[1][j];
      const Point<3> low = between<3>(plane[0], plane[2], v), high = between<3>(plane[1], plane[3], v), a = high - low;
      const Point<3> low2 = between<3>(along2[0], along2[2], v), high2 = between<3>(along2[1], along2[3], v);
      for (int i = 0; i < n; ++i) {
        const double u = t[0][i];
        const Point<3> b = between<3>(low1, high1, u), c = between<3>(low2, high2, u);
        const double jacobian = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                                a[2] * (b[0] * c[1] - b[1] * c[0]);
        visit(between<3>(low, high, u), jacobian);
      }
    }
  }
}

// Duffy's map onto a simplex: p0 + u ((1 - v) e1 + v ((1 - w) e2 + w e3)), whose determinant is u^2 v that of the edges.
template <class Visit>
void map_grid(const SimplexPoints<3>& p, int n, const double (*t)[3], Visit&& visit) {
  const Point<3> e1 = p[1] - p[0], e2 = p[2] - p[0], e3 = p[3] - p[0];
  const double volume = e1[0] * (e2[1] * e3[2] - e2[2] * e3[1]) + e1[1] * (e2[2] * e3[0] - e2[0] * e3[2]) +
                        e1[2] * (e2[0] * e3[1] - e2[1] * e3[0]);
  for (int l = 0; l < n; ++l) {
    const Point<3> far = between<3>(e2, e3, t[2][l]);
    for (int j = 0; j < n; ++j) {
      const Point<3> q = between<3>(e1, far, t[1][j]);
      for (int i = 0; i < n; ++i) visit(Point<3>(p[0] + t[0][i] * q), t[0][i] * t[0][i] * t[1][j] * volume);
    }
  }
}

// A part of a cell's unit cube.
template <int Dim>
struct Box {
  Index cell;
  double width;
  std::array<double, Dim> low;
};

// Shape: CornerPoints or SimplexPoints.
template <int Dim, class Shape>
class VolumeIntegrator {
 public:
  static constexpr int kChunk = 64;

  VolumeIntegrator(const MetricField<Dim>& field, const VolumeOptions& options) : field_(field), options_(options) {}

  void run(std::span<const Shape> cells, std::span<double> volumes) {
    cells_ = cells;
    boxes_.clear();
    for (Index c = 0; c < static_cast<Index>(cells.size()); ++c) divide(c);
    std::fill(volumes.begin(), volumes.end(), 0.0);
    std::array<double, kChunk> reference{};
    // Deep enough for a kink; a jump of the metric ends here.
    constexpr int kMaxDepth = Dim == 2 ? 10 : 6;
    for (int depth = 0; !boxes_.empty(); ++depth) {
      estimate();
      if (depth == 0) {
        for (std::size_t i = 0; i < boxes_.size(); ++i) reference[boxes_[i].cell] += std::fabs(fine_[i]);
      }
      next_.clear();
      for (std::size_t i = 0; i < boxes_.size(); ++i) {
        // Between a share of the error per box and a share per volume: boxes along a kink are many but their errors
        // partly cancel.
        const Box<Dim>& box = boxes_[i];
        const double allowed = options_.tolerance * std::sqrt(std::fabs(fine_[i]) * reference[box.cell]);
        if (depth < kMaxDepth && std::fabs(fine_[i] - coarse_[i]) > allowed) {
          halve(box);
        } else {
          volumes[box.cell] += fine_[i];
        }
      }
      boxes_.swap(next_);
    }
  }

 private:
  static constexpr int kCoarse = power(2, Dim);
  static constexpr int kFine = power(3, Dim);
  static constexpr std::size_t kBatch = 16;  // boxes at a time
  static constexpr std::array<double, kFine> kWeights = product_weights<Dim>();

  void divide(Index c) {
    constexpr double kMost = Dim == 2 ? 16.0 : 2.0;
    const Shape& p = cells_[c];
    double longest = 0.0;
    for (std::size_t k = 1; options_.panel > 0.0 && k < p.size(); ++k) {
      double square = 0.0;
      for (int d = 0; d < Dim; ++d) square += (p[k][d] - p[0][d]) * (p[k][d] - p[0][d]);
      longest = std::max(longest, std::sqrt(square));
    }
    const int n = longest > options_.panel && options_.panel > 0.0
                      ? static_cast<int>(std::min(kMost, std::ceil(longest / options_.panel)))
                      : 1;
    const double width = 1.0 / n;
    for (int k = 0; k < power(n, Dim); ++k) {
      Box<Dim> box{c, width, {}};
      for (int d = 0, rest = k; d < Dim; ++d, rest /= n) box.low[d] = (rest % n) * width;
      boxes_.push_back(box);
    }
  }

  void halve(const Box<Dim>& box) {
    const double width = 0.5 * box.width;
    for (int k = 0; k < Cell<Dim>::corners; ++k) {
      Box<Dim> child{box.cell, width, box.low};
      for (int d = 0; d < Dim; ++d) child.low[d] += ((k >> d) & 1) * width;
      next_.push_back(child);
    }
  }

  // Both rules on every box.
  void estimate() {
    coarse_.resize(boxes_.size());
    fine_.resize(boxes_.size());
    for (std::size_t start = 0; start < boxes_.size(); start += kBatch) {
      const std::size_t end = std::min(boxes_.size(), start + kBatch);
      used_ = 0;
      for (std::size_t i = start; i < end; ++i) {
        sample(boxes_[i], kNode2, 2);
        sample(boxes_[i], kNode3, 3);
      }
      densities();
      const double* f = density_.data();
      for (std::size_t i = start; i < end; ++i) {
        double coarse = 0.0;
        double fine = 0.0;
        for (int k = 0; k < kCoarse; ++k) coarse += *f++;
        for (int k = 0; k < kFine; ++k) fine += kWeights[k] * *f++;
        double volume = 1.0;
        for (int d = 0; d < Dim; ++d) volume *= boxes_[i].width;
        coarse_[i] = volume * coarse / kCoarse;
        fine_[i] = volume * fine;
      }
    }
  }

  // Adds the n^Dim points of a tensor-product rule.
  void sample(const Box<Dim>& box, const double* nodes, int n) {
    double t[Dim][3];
    for (int d = 0; d < Dim; ++d) {
      for (int k = 0; k < n; ++k) t[d][k] = box.low[d] + box.width * nodes[k];
    }
    map_grid(cells_[box.cell], n, t, [&](const Point<Dim>& point, double jacobian) {
      for (int d = 0; d < Dim; ++d) coordinates_[d][used_] = point[d];
      density_[used_++] = jacobian;
    });
  }

  // Multiplies the Jacobian determinants by sqrt(det M).
  void densities() {
    for (int start = 0; start < used_; start += kLanes) {
      const int count = std::min(kLanes, used_ - start);
      for (int d = 0; d < Dim; ++d) std::copy_n(coordinates_[d].data() + start, count, points_[d].data());
      field_.evaluate(points_, count, tensors_);
      const auto& m = tensors_;
      double* density = density_.data() + start;
      for (int i = 0; i < count; ++i) {
        double det = 0.0;
        if constexpr (Dim == 2) {
          det = m[0][i] * m[2][i] - m[1][i] * m[1][i];
        } else {
          det = m[0][i] * (m[2][i] * m[5][i] - m[4][i] * m[4][i]) - m[1][i] * (m[1][i] * m[5][i] - m[4][i] * m[3][i]) +
                m[3][i] * (m[1][i] * m[4][i] - m[2][i] * m[3][i]);
        }
        density[i] *= std::sqrt(det < 0.0 ? 0.0 : det);
      }
    }
  }

  const MetricField<Dim>& field_;
  VolumeOptions options_;
  std::span<const Shape> cells_;
  std::vector<Box<Dim>> boxes_, next_;
  std::vector<double> coarse_, fine_;
  int used_ = 0;
  PointLanes<Dim> points_;
  TensorLanes<Dim> tensors_;
  std::array<std::array<double, kBatch*(kCoarse + kFine)>, Dim> coordinates_;
  std::array<double, kBatch*(kCoarse + kFine)> density_;
};

template <int Dim, class Shape>
void integrate_chunks(const MetricField<Dim>& field, std::span<const Shape> cells, std::span<double> volumes,
                      const VolumeOptions& options) {
  constexpr std::size_t kChunk = VolumeIntegrator<Dim, Shape>::kChunk;
  VolumeIntegrator<Dim, Shape> integrator(field, options);
  for (std::size_t start = 0; start < cells.size(); start += kChunk) {
    const std::size_t count = std::min(kChunk, cells.size() - start);
    integrator.run(cells.subspan(start, count), volumes.subspan(start, count));
  }
}

}  // namespace

template <int Dim>
CornerPoints<Dim> collapsed_simplex(const SimplexPoints<Dim>& p) {
  if constexpr (Dim == 2) {
    return {p[0], p[1], p[0], p[2]};
  } else {
    return {p[0], p[1], p[0], p[2], p[0], p[1], p[0], p[3]};
  }
}

template <int Dim>
void metric_volumes(const MetricField<Dim>& field, std::span<const CornerPoints<Dim>> cells, std::span<double> volumes,
                    const VolumeOptions& options) {
  integrate_chunks<Dim>(field, cells, volumes, options);
}

void simplex_volumes(const MetricField<3>& field, std::span<const SimplexPoints<3>> simplices, std::span<double> volumes,
                     const VolumeOptions& options) {
  integrate_chunks<3>(field, simplices, volumes, options);
}

template <int Dim>
double complexity(const Mesh<Dim>& mesh, const MetricField<Dim>& field, const VolumeOptions& options) {
  constexpr int kChunk = VolumeIntegrator<Dim, CornerPoints<Dim>>::kChunk;
  VolumeIntegrator<Dim, CornerPoints<Dim>> integrator(field, options);
  std::array<CornerPoints<Dim>, kChunk> cells;
  std::array<double, kChunk> volumes;
  double total = 0.0;
  for (CellId c = 0; c < mesh.cell_count();) {
    std::size_t count = 0;
    for (; c < mesh.cell_count() && count < kChunk; ++c) {
      if (!mesh.alive(c)) continue;
      for (int k = 0; k < Cell<Dim>::corners; ++k) cells[count][k] = mesh.points[mesh.cells[c][k]];
      ++count;
    }
    integrator.run({cells.data(), count}, {volumes.data(), count});
    for (std::size_t i = 0; i < count; ++i) total += volumes[i];
  }
  return total;
}

#define PILLOWMESH_INSTANTIATE(D)                                                                             \
  template CornerPoints<D> collapsed_simplex<D>(const SimplexPoints<D>&);                                     \
  template void metric_volumes<D>(const MetricField<D>&, std::span<const CornerPoints<D>>, std::span<double>, \
                                  const VolumeOptions&);                                                      \
  template double complexity<D>(const Mesh<D>&, const MetricField<D>&, const VolumeOptions&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
