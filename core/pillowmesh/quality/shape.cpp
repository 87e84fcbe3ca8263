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

/// Metric length. Where all edges of a cell are shorter its diagonals are, too, and have no need of panels.
constexpr double kShortEdge = 2.0;

template <int Dim>
Line<Dim> line_between(const Mesh<Dim>& mesh, const std::vector<SymTensor<Dim>>& at_vertices, VertexId a, VertexId b) {
  return {mesh.points[a], mesh.points[b], &at_vertices[a], &at_vertices[b]};
}

// The metric at the vertices of cells.
template <int Dim>
std::vector<SymTensor<Dim>> metric_at_vertices(const Mesh<Dim>& mesh, const MetricField<Dim>& field,
                                               std::span<const CellId> cells) {
  std::vector<SymTensor<Dim>> tensors(mesh.points.size());
  std::vector<unsigned char> seen(mesh.points.size(), 0);
  std::vector<VertexId> vertices;
  for (const CellId c : cells)
    for (const VertexId v : mesh.cells[c])
      if (seen[v] == 0) {
        seen[v] = 1;
        vertices.push_back(v);
      }
  PointLanes<Dim> points{};
  TensorLanes<Dim> found{};
  for (std::size_t start = 0; start < vertices.size(); start += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, vertices.size() - start);
    for (std::size_t i = 0; i < count; ++i)
      for (int d = 0; d < Dim; ++d) points[d][i] = mesh.points[vertices[start + i]][d];
    field.evaluate(points, static_cast<int>(count), found);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < found.size(); ++k) tensors[vertices[start + i]].m[k] = found[k][i];
  }
  return tensors;
}

// Integrals along all edges of all corner simplices of a chunk of cells: those of the cells are known, diagonals are new.
template <int Dim>
class SimplexEdges {
 public:
  static constexpr SimplexPairs<Dim> kPairs{};

  explicit SimplexEdges(const EdgeIntegrals<Dim>& known) : known_(known) {}

  void measure(const Mesh<Dim>& mesh, const MetricField<Dim>& field, std::span<const CellId> cells,
               const LineOptions& options) {
    place_.resize(cells.size() * kPerCell);
    keys_.clear();
    lines_.clear();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t first = lines_.size();
      double longest = 0.0;  // edge of the cell
      for (int j = 0; j < kPerCell; ++j) {
        const VertexId a = mesh.cells[cells[i]][kPairs.pair[j][0]], b = mesh.cells[cells[i]][kPairs.pair[j][1]];
        Index& place = place_[i * kPerCell + j];
        if (kPairs.is_edge(j)) {
          place = known_.edges.find(a, b);
          longest = std::max(longest, known_.along[place].length);
        } else if constexpr (Dim == 2) {
          place = static_cast<Index>(lines_.size());
          lines_.push_back(line_between(mesh, known_.at_vertices, a, b));
        } else {
          keys_.push_back({key(a, b), i * kPerCell + j});
        }
      }
      for (std::size_t d = first; d < lines_.size(); ++d) lines_[d].single_panel = longest < kShortEdge;
    }
    if constexpr (Dim == 3) {
      // Neighbouring cells and corners share diagonals: each is integrated once.
      std::sort(keys_.begin(), keys_.end());
      for (std::size_t i = 0; i < keys_.size(); ++i) {
        if (i == 0 || keys_[i][0] != keys_[i - 1][0])
          lines_.push_back(line_between(mesh, known_.at_vertices, static_cast<VertexId>(keys_[i][0] >> 32),
                                        static_cast<VertexId>(keys_[i][0] & 0xffffffffu)));
        place_[keys_[i][1]] = static_cast<Index>(lines_.size()) - 1;
      }
    }
    diagonals_.resize(lines_.size());
    // Features as narrow as a panel are found by the edges.
    LineOptions coarser = options;
    coarser.panel *= Dim == 2 ? 2.0 : 4.0;
    line_integrals<Dim>(field, lines_, diagonals_, coarser);
  }

  /// Pair j of the i-th cell (SimplexPairs).
  [[nodiscard]] const LineIntegral& line(std::size_t i, int j) const {
    const Index place = place_[i * kPerCell + j];
    return kPairs.is_edge(j) ? known_.along[place] : diagonals_[place];
  }

  /// Of simplex k of the i-th cell.
  [[nodiscard]] SimplexLengths<Dim> simplex(std::size_t i, int k) const {
    SimplexLengths<Dim> l;
    for (std::size_t e = 0; e < l.size(); ++e) l[e] = line(i, kPairs.place[k][e]).length;
    return l;
  }

 private:
  static constexpr int kPerCell = SimplexPairs<Dim>::count;

  static std::uint64_t key(VertexId a, VertexId b) {
    const auto [low, high] = std::minmax(a, b);
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
  }

  const EdgeIntegrals<Dim>& known_;
  std::vector<Index> place_;                        // of each pair of each cell, among the edges or the diagonals
  std::vector<std::array<std::uint64_t, 2>> keys_;  // vertex pair, place in place_
  std::vector<Line<Dim>> lines_;                    // diagonals
  std::vector<LineIntegral> diagonals_;
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
  SimplexVolumes(const MetricField<2>& field, double panel) : field_(field), options_(VolumeOptions::for_panel(2, panel, 3e-3)) {}

  void measure(const Mesh<2>& mesh, std::span<const CellId> cells, const SimplexEdges<2>& edges) {
    quads_.resize(cells.size());
    lines_.resize(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (int k = 0; k < 4; ++k) quads_[i][k] = mesh.points[mesh.cells[cells[i]][k]];
      const auto line = [&](int a, int b) -> const LineIntegral& { return edges.line(i, SimplexEdges<2>::kPairs.find(a, b)); };
      lines_[i] = {line(0, 1), line(0, 2), line(1, 3), line(2, 3), line(0, 3), line(1, 2)};
    }
    areas_.resize(cells.size());
    quad_areas(field_, quads_, lines_, areas_, options_);
  }
  [[nodiscard]] double simplex(std::size_t i, int k) const { return areas_[i][k]; }
  /// Those at two opposite corners make the cell, as do the other two.
  [[nodiscard]] double cell(std::size_t i) const {
    const CornerAreas& a = areas_[i];
    return 0.5 * ((a[0] + a[3]) + (a[1] + a[2]));
  }

 private:
  const MetricField<2>& field_;
  VolumeOptions options_;
  std::vector<CornerPoints<2>> quads_;
  std::vector<QuadLines> lines_;
  std::vector<CornerAreas> areas_;
};

template <>
class SimplexVolumes<3> {
 public:
  SimplexVolumes(const MetricField<3>& field, double panel) : field_(field), options_(VolumeOptions::for_panel(3, panel, 5e-3)) {}

  void measure(const Mesh<3>& mesh, std::span<const CellId> cells, const SimplexEdges<3>&) {
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
EdgeIntegrals<Dim> edge_integrals(const Mesh<Dim>& mesh, const MetricField<Dim>& field, std::span<const CellId> cells,
                             const LineOptions& options) {
  constexpr Index chunk = 1024;
  EdgeIntegrals<Dim> known{EdgeTable(mesh, cells), {}, metric_at_vertices(mesh, field, cells)};
  const Index count = known.edges.size();
  known.along.resize(count);
  std::vector<Line<Dim>> lines;
  for (Index start = 0; start < count; start += chunk) {
    lines.clear();
    for (Index e = start; e < std::min(count, start + chunk); ++e)
      lines.push_back(line_between(mesh, known.at_vertices, known.edges[e][0], known.edges[e][1]));
    line_integrals<Dim>(field, lines, std::span(known.along).subspan(start, lines.size()), options);
  }
  return known;
}

template <int Dim>
void cell_shapes(const Mesh<Dim>& mesh, const MetricField<Dim>& field, std::span<const CellId> cells,
                 std::span<double> flat, std::span<double> integral, const LineOptions& options,
                 const EdgeIntegrals<Dim>* known, double* area) {
  EdgeIntegrals<Dim> own;
  if (known == nullptr) {
    own = edge_integrals(mesh, field, cells, options);
    known = &own;
  }
  constexpr std::size_t kChunk = 1024;
  constexpr int kCorners = Cell<Dim>::corners;
  SimplexEdges<Dim> edges(*known);
  SimplexVolumes<Dim> volumes(field, options.panel);
  for (std::size_t start = 0; start < cells.size(); start += kChunk) {
    const std::span<const CellId> chunk = cells.subspan(start, std::min(kChunk, cells.size() - start));
    edges.measure(mesh, field, chunk, options);
    if (!integral.empty()) volumes.measure(mesh, chunk, edges);
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
                               std::span<double>, const LineOptions&, const EdgeIntegrals<D>*, double*);                       \
  template EdgeIntegrals<D> edge_integrals<D>(const Mesh<D>&, const MetricField<D>&, std::span<const CellId>,        \
                                           const LineOptions&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
