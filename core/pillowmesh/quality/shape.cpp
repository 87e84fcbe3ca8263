#include "pillowmesh/quality/shape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "pillowmesh/mesh/portable_math.h"
#include "pillowmesh/metric/quad_area.h"
#include "pillowmesh/quality/corner_simplex.h"

namespace pillowmesh {
namespace {

// Metric lengths of all edges of all corner simplices of a chunk of cells. Neighbouring cells and corners share most
// of them: each is integrated once.
template <int Dim>
class SimplexEdges {
 public:
  static constexpr SimplexPairs<Dim> kPairs{};
  static constexpr int kPerCell = SimplexPairs<Dim>::count;

  void measure(const Mesh<Dim>& mesh, const MetricField<Dim>& field, std::span<const CellId> cells,
               const LengthOptions& options, const KnownLengths& known) {
    keys_.clear();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (int j = 0; j < kPerCell; ++j) keys_.push_back({key(mesh.cells[cells[i]], j), i * kPerCell + j});
    }
    std::sort(keys_.begin(), keys_.end());
    pairs_.clear();
    unknown_.clear();
    unique_.clear();
    auto next = known.edges.begin();
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      if (i > 0 && keys_[i][0] == keys_[i - 1][0]) continue;
      const std::array<VertexId, 2> pair{static_cast<VertexId>(keys_[i][0] >> 32),
                                         static_cast<VertexId>(keys_[i][0] & 0xffffffffu)};
      const bool diagonal = !kPairs.is_edge(static_cast<int>(keys_[i][1] % kPerCell));
      if (!diagonal) next = std::lower_bound(next, known.edges.end(), pair);
      if (!diagonal && next != known.edges.end() && *next == pair) {
        unique_.push_back(known.lengths[next - known.edges.begin()]);
        continue;
      }
      unknown_.push_back(unique_.size());
      unique_.push_back(0.0);
      pairs_.push_back(pair);
    }
    found_.resize(pairs_.size());
    edge_lengths<Dim>(field, mesh.points, pairs_, found_, options);
    for (std::size_t k = 0; k < unknown_.size(); ++k) unique_[unknown_[k]] = found_[k];
    lengths_.resize(keys_.size());
    std::size_t at = 0;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      if (i > 0 && keys_[i][0] != keys_[i - 1][0]) ++at;
      lengths_[keys_[i][1]] = unique_[at];
    }
  }

  /// Of simplex k of the i-th cell.
  [[nodiscard]] SimplexLengths<Dim> simplex(std::size_t i, int k) const {
    SimplexLengths<Dim> l;
    for (std::size_t e = 0; e < l.size(); ++e) l[e] = lengths_[i * kPerCell + kPairs.place[k][e]];
    return l;
  }

 private:
  static std::uint64_t key(const Corners<Dim>& corners, int j) {
    const auto [low, high] = std::minmax(corners[kPairs.pair[j][0]], corners[kPairs.pair[j][1]]);
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
  }

  std::vector<std::array<std::uint64_t, 2>> keys_;  // vertex pair, place in lengths_
  std::vector<std::array<VertexId, 2>> pairs_;  // to be integrated
  std::vector<std::size_t> unknown_;            // their places in unique_
  std::vector<double> found_, unique_, lengths_;
};

// Volume of the flat simplex from the Gram matrix of the edges out of the corner; 0 if the matrix is not positive
// definite, that is, if there is no such simplex.
double flat_volume(const SimplexLengths<2>& l) {
  const double a = l[0] * l[0];
  const double b = l[1] * l[1];
  const double g = 0.5 * (a + b - l[2] * l[2]);
  const double det = a * b - g * g;
  return det > 0.0 ? 0.5 * std::sqrt(det) : 0.0;
}

double flat_volume(const SimplexLengths<3>& l) {
  const double a = l[0] * l[0];
  const double b = l[1] * l[1];
  const double c = l[2] * l[2];
  const double ab = 0.5 * (a + b - l[3] * l[3]);
  const double ac = 0.5 * (a + c - l[4] * l[4]);
  const double bc = 0.5 * (b + c - l[5] * l[5]);
  const double minor = a * b - ab * ab;
  const double det = c * minor - a * bc * bc - b * ac * ac + 2.0 * ab * ac * bc;
  return minor > 0.0 && det > 0.0 ? std::sqrt(det) / 6.0 : 0.0;
}

// Metric volumes of all corner simplices of a chunk of cells.
template <int Dim>
class SimplexVolumes;

template <>
class SimplexVolumes<2> {
 public:
  SimplexVolumes(const MetricField<2>& field, double panel) : field_(field), options_(VolumeOptions::for_panel(2, panel, 1e-3)) {}

  void measure(const Mesh<2>& mesh, std::span<const CellId> cells) {
    quads_.resize(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (int k = 0; k < 4; ++k) quads_[i][k] = mesh.points[mesh.cells[cells[i]][k]];
    areas_.resize(cells.size());
    quad_areas(field_, quads_, areas_, options_);
  }
  [[nodiscard]] double simplex(std::size_t i, int k) const { return areas_[i][k]; }
  /// Those at two opposite corners make the cell, as do the other two.
  [[nodiscard]] double cell(std::size_t i) const { return areas_[i][0] + areas_[i][3]; }

 private:
  const MetricField<2>& field_;
  VolumeOptions options_;
  std::vector<CornerPoints<2>> quads_;
  std::vector<CornerAreas> areas_;
};

template <>
class SimplexVolumes<3> {
 public:
  SimplexVolumes(const MetricField<3>& field, double panel) : field_(field), options_(VolumeOptions::for_panel(3, panel, 5e-3)) {}

  void measure(const Mesh<3>& mesh, std::span<const CellId> cells) {
    simplices_.clear();
    for (const CellId c : cells)
      for (int k = 0; k < 8; ++k) simplices_.push_back(corner_simplex<3>(mesh, c, k));
    volumes_.resize(simplices_.size());
    simplex_volumes(field_, simplices_, volumes_, options_);
  }
  [[nodiscard]] double simplex(std::size_t i, int k) const { return volumes_[8 * i + k]; }

 private:
  const MetricField<3>& field_;
  VolumeOptions options_;
  std::vector<SimplexPoints<3>> simplices_;
  std::vector<double> volumes_;
};

template <int Dim>
double least(const std::array<double, Cell<Dim>::corners>& values) {
  return *std::min_element(values.begin(), values.end());
}

}  // namespace

template <int Dim>
double simplex_shape(const SimplexLengths<Dim>& lengths, double volume) {
  double squares = 0.0;
  for (const double l : lengths) squares += l * l;
  if (!(volume > 0.0) || !(squares > 0.0)) return 0.0;
  if constexpr (Dim == 2) {
    return 8.0 * volume / squares;
  } else {
    return 9.0 * portable::pow(6.0 * volume, 2.0 / 3.0) / squares;
  }
}

template <int Dim>
double simplex_shape(const SimplexLengths<Dim>& lengths) {
  return simplex_shape<Dim>(lengths, flat_volume(lengths));
}

template <int Dim>
void cell_shapes(const Mesh<Dim>& mesh, const MetricField<Dim>& field, std::span<const CellId> cells,
                 std::span<double> flat, std::span<double> integral, const LengthOptions& options,
                 const KnownLengths& known, double* area) {
  constexpr std::size_t kChunk = 1024;
  constexpr int kCorners = Cell<Dim>::corners;
  SimplexEdges<Dim> edges;
  SimplexVolumes<Dim> volumes(field, options.panel);
  for (std::size_t start = 0; start < cells.size(); start += kChunk) {
    const std::span<const CellId> chunk = cells.subspan(start, std::min(kChunk, cells.size() - start));
    edges.measure(mesh, field, chunk, options, known);
    if (!integral.empty()) volumes.measure(mesh, chunk);
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      std::array<double, kCorners> eta;
      std::array<double, kCorners> eta_integral{};
      for (int k = 0; k < kCorners; ++k) {
        const SimplexLengths<Dim> l = edges.simplex(i, k);
        eta[k] = simplex_shape<Dim>(l);
        if (!integral.empty()) eta_integral[k] = simplex_shape<Dim>(l, volumes.simplex(i, k));
      }
      flat[start + i] = least<Dim>(eta);
      if (!integral.empty()) integral[start + i] = least<Dim>(eta_integral);
      if constexpr (Dim == 2) {
        if (area != nullptr) *area += volumes.cell(i);
      }
    }
  }
}

#define PILLOWMESH_INSTANTIATE(D)                                                                                 \
  template double simplex_shape<D>(const SimplexLengths<D>&);                                                     \
  template double simplex_shape<D>(const SimplexLengths<D>&, double);                                             \
  template void cell_shapes<D>(const Mesh<D>&, const MetricField<D>&, std::span<const CellId>, std::span<double>, \
                               std::span<double>, const LengthOptions&, const KnownLengths&, double*);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
