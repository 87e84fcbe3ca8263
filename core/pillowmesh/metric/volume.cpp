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

// A part of a cell's unit cube.
template <int Dim>
struct Box {
  Index cell;
  double width;
  std::array<double, Dim> low;
};

template <int Dim>
class VolumeIntegrator {
 public:
  static constexpr int kChunk = 64;

  VolumeIntegrator(const MetricField<Dim>& field, const VolumeOptions& options) : field_(field), options_(options) {}

  void run(std::span<const CornerPoints<Dim>> cells, std::span<double> volumes) {
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
  static constexpr std::size_t kBatch = kLanes / (kCoarse + kFine);

  void divide(Index c) {
    constexpr double kMost = Dim == 2 ? 16.0 : 2.0;
    const CornerPoints<Dim>& p = cells_[c];
    double longest = 0.0;
    for (int k = 1; options_.panel > 0.0 && k < Cell<Dim>::corners; ++k) {
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
      field_.evaluate(points_, used_, tensors_);
      densities();
      const double* f = density_.data();
      for (std::size_t i = start; i < end; ++i) {
        double coarse = 0.0;
        double fine = 0.0;
        for (int k = 0; k < kCoarse; ++k) coarse += *f++;
        for (int k = 0; k < kFine; ++k) {
          double weight = 1.0;
          for (int d = 0, rest = k; d < Dim; ++d, rest /= 3) weight *= kWeight3[rest % 3];
          fine += weight * *f++;
        }
        double volume = 1.0;
        for (int d = 0; d < Dim; ++d) volume *= boxes_[i].width;
        coarse_[i] = volume * coarse / kCoarse;
        fine_[i] = volume * fine;
      }
    }
  }

  // Adds the n^Dim points of a tensor-product rule.
  void sample(const Box<Dim>& box, const double* nodes, int n) {
    for (int k = 0; k < power(n, Dim); ++k, ++used_) {
      std::array<double, Dim> u;
      for (int d = 0, rest = k; d < Dim; ++d, rest /= n) u[d] = box.low[d] + box.width * nodes[rest % n];
      map(cells_[box.cell], u);
    }
  }

  // The point that u is mapped to, and the Jacobian determinant there: collapses one axis after the other, carrying the
  // derivatives along.
  void map(const CornerPoints<Dim>& p, const std::array<double, Dim>& u) {
    std::array<std::array<double, Dim>, Dim> derivative;
    for (int i = 0; i < Dim; ++i) {
      std::array<double, Cell<Dim>::corners> value;
      for (int k = 0; k < Cell<Dim>::corners; ++k) value[k] = p[k][i];
      for (int d = Dim - 1; d >= 0; --d) {
        const int half = 1 << d;
        for (int k = 0; k < half; ++k) {
          const double difference = value[k + half] - value[k];
          value[k] += u[d] * difference;
          value[k + half] = difference;
        }
        // value[half .. 2 half) now holds d/du_d over the axes below d; collapse it to a number.
        std::array<double, Cell<Dim>::corners> slope;
        for (int k = 0; k < half; ++k) slope[k] = value[half + k];
        for (int e = d - 1; e >= 0; --e) {
          for (int k = 0; k < (1 << e); ++k) slope[k] += u[e] * (slope[k + (1 << e)] - slope[k]);
        }
        derivative[d][i] = slope[0];
      }
      points_[i][used_] = value[0];
    }
    const auto& a = derivative;
    if constexpr (Dim == 2) {
      jacobian_[used_] = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    } else {
      jacobian_[used_] = a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) +
                         a[0][1] * (a[1][2] * a[2][0] - a[1][0] * a[2][2]) +
                         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
    }
  }

  void densities() {
    for (int i = 0; i < used_; ++i) {
      SymTensor<Dim> M;
      for (int k = 0; k < SymTensor<Dim>::size; ++k) M.m[k] = tensors_[k][i];
      const double det = determinant(M);
      density_[i] = jacobian_[i] * std::sqrt(det < 0.0 ? 0.0 : det);
    }
  }

  const MetricField<Dim>& field_;
  VolumeOptions options_;
  std::span<const CornerPoints<Dim>> cells_;
  std::vector<Box<Dim>> boxes_, next_;
  std::vector<double> coarse_, fine_;
  int used_ = 0;
  PointLanes<Dim> points_;
  TensorLanes<Dim> tensors_;
  Lanes jacobian_, density_;
};

}  // namespace

template <int Dim>
CornerPoints<Dim> collapsed_simplex(const std::array<Point<Dim>, Dim + 1>& p) {
  if constexpr (Dim == 2) {
    return {p[0], p[1], p[0], p[2]};
  } else {
    return {p[0], p[1], p[0], p[2], p[0], p[1], p[0], p[3]};
  }
}

template <int Dim>
void metric_volumes(const MetricField<Dim>& field, std::span<const CornerPoints<Dim>> cells, std::span<double> volumes,
                    const VolumeOptions& options) {
  constexpr std::size_t kChunk = VolumeIntegrator<Dim>::kChunk;
  VolumeIntegrator<Dim> integrator(field, options);
  for (std::size_t start = 0; start < cells.size(); start += kChunk) {
    const std::size_t count = std::min(kChunk, cells.size() - start);
    integrator.run(cells.subspan(start, count), volumes.subspan(start, count));
  }
}

template <int Dim>
double complexity(const Mesh<Dim>& mesh, const MetricField<Dim>& field, const VolumeOptions& options) {
  constexpr int kChunk = VolumeIntegrator<Dim>::kChunk;
  VolumeIntegrator<Dim> integrator(field, options);
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
  template CornerPoints<D> collapsed_simplex<D>(const std::array<Point<D>, D + 1>&);                          \
  template void metric_volumes<D>(const MetricField<D>&, std::span<const CornerPoints<D>>, std::span<double>, \
                                  const VolumeOptions&);                                                      \
  template double complexity<D>(const Mesh<D>&, const MetricField<D>&, const VolumeOptions&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
