#include "pillowmesh/metric/field.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "pillowmesh/mesh/number.h"
#include "pillowmesh/metric/discrete.h"
#include "pillowmesh/metric/expression.h"
#include "pillowmesh/metric/size_octree.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

constexpr std::string_view kEntryNames[] = {"m11", "m12", "m22", "m13", "m23", "m33"};
constexpr std::string_view kSizeNames[] = {"h1", "h2", "h3"};

std::string forms(int dim) {
  return dim == 2 ? "h, or h1 and h2 (with theta), or m11, m12 and m22"
                  : "h, or h1, h2 and h3 (with theta, phi), or m11, m12, m22, m13, m23 and m33";
}

// Builds the nodes of the tensor's entries, in packing order, from what a formula assigns.
template <int Dim>
class TensorBuilder {
 public:
  explicit TensorBuilder(Formula& formula) : formula_(formula), graph_(formula.graph) {}

  Expected<std::vector<NodeId>> run() {
    const bool isotropic = formula_.find("h") != nullptr;
    const bool sizes = any(kSizeNames);
    const bool entries = any(kEntryNames);
    if (isotropic + sizes + entries > 1) return mixed();
    if (isotropic) return diagonal({metric_of("h"), metric_of("h"), metric_of("h")});
    if (sizes) return from_sizes();
    if (entries) return from_entries();
    return Status::usage("the formula assigns no metric; it must assign " + forms(Dim));
  }

 private:
  static constexpr int kSize = SymTensor<Dim>::size;

  [[nodiscard]] bool any(std::span<const std::string_view> names) const {
    return std::any_of(names.begin(), names.end(), [&](std::string_view n) { return formula_.find(n) != nullptr; });
  }

  [[nodiscard]] Status mixed() const {
    std::string found;
    const auto add = [&](std::string_view name) {
      if (formula_.find(name) != nullptr) found += (found.empty() ? "" : ", ") + std::string(name);
    };
    add("h");
    for (const std::string_view name : kSizeNames) add(name);
    for (const std::string_view name : kEntryNames) add(name);
    return Status::usage("the formula assigns " + found + ", which do not go together; it must assign only " +
                         forms(Dim));
  }

  // The names of a form must be assigned up to `wanted` and not beyond.
  [[nodiscard]] Status complete(std::span<const std::string_view> names, int wanted) const {
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
      const Formula::Assignment* a = formula_.find(names[i]);
      if (i >= wanted && a != nullptr) {
        return Status::usage("column " + std::to_string(a->column) + ": '" + a->name +
                             "' has no meaning in two dimensions; the formula must assign " + forms(Dim));
      }
      if (i < wanted && a == nullptr) {
        return Status::usage("the formula does not assign '" + std::string(names[i]) + "'; it must assign " +
                             forms(Dim));
      }
    }
    return {};
  }

  NodeId metric_of(std::string_view size) { return graph_.make(Op::size_to_metric, formula_.find(size)->value); }

  std::vector<NodeId> diagonal(const std::array<NodeId, 3>& values) {
    std::vector<NodeId> m(kSize, graph_.constant(0.0));
    for (int i = 0; i < Dim; ++i) m[SymTensor<Dim>::at(i, i)] = values[i];
    return m;
  }

  Expected<std::vector<NodeId>> from_entries() {
    if (Status s = complete(kEntryNames, kSize); !s.ok()) return s;
    std::vector<NodeId> m;
    for (int i = 0; i < kSize; ++i) m.push_back(formula_.find(kEntryNames[i])->value);
    return m;
  }

  // M = sum over the directions u_i, the columns of the rotation, of h_i^-2 u_i u_i'.
  Expected<std::vector<NodeId>> from_sizes() {
    if (Status s = complete(kSizeNames, Dim); !s.ok()) return s;
    std::array<NodeId, 3> d{};
    for (int i = 0; i < Dim; ++i) d[i] = metric_of(kSizeNames[i]);
    const Formula::Assignment* theta = formula_.find("theta");
    const Formula::Assignment* phi = Dim == 3 ? formula_.find("phi") : nullptr;
    if (theta == nullptr && phi == nullptr) return diagonal(d);

    const NodeId zero = graph_.constant(0.0);
    const NodeId one = graph_.constant(1.0);
    const NodeId ct = theta != nullptr ? graph_.make(Op::cosine, theta->value) : one;
    const NodeId st = theta != nullptr ? graph_.make(Op::sine, theta->value) : zero;
    const NodeId cp = phi != nullptr ? graph_.make(Op::cosine, phi->value) : one;
    const NodeId sp = phi != nullptr ? graph_.make(Op::sine, phi->value) : zero;
    // Columns of R_theta R_phi; in 2D phi = 0 and the third row and column fall away.
    const std::array<std::array<NodeId, 3>, 3> u{
        {{times(ct, cp), times(st, cp), minus(sp)}, {minus(st), ct, zero}, {times(ct, sp), times(st, sp), cp}}};
    if constexpr (Dim == 3)
      for (int k = 0; k < 3; ++k)
        if (d[(k + 1) % 3] == d[(k + 2) % 3]) return with_axis(u[k], d[k], d[(k + 1) % 3]);
    std::vector<NodeId> m(kSize);
    for (int j = 0; j < Dim; ++j) {
      for (int i = 0; i <= j; ++i) {
        NodeId sum = zero;
        for (int k = 0; k < Dim; ++k) sum = graph_.make(Op::add, sum, times(d[k], times(u[k][i], u[k][j])));
        m[SymTensor<Dim>::at(i, j)] = sum;
      }
    }
    return m;
  }

  // The same where two of the sizes are one: M = a u u' + b (I - u u') needs only the third direction. The diagonal of
  // I - u u' is summed from squares, which stay exact where b is far larger than a.
  std::vector<NodeId> with_axis(const std::array<NodeId, 3>& u, NodeId a, NodeId b) {
    std::vector<NodeId> m(kSize);
    const NodeId difference = graph_.make(Op::subtract, a, b);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const NodeId others = graph_.make(Op::add, times(u[j], u[j]), times(u[k], u[k]));
      m[SymTensor<3>::at(i, i)] = graph_.make(Op::add, times(a, times(u[i], u[i])), times(b, others));
      m[SymTensor<3>::at(std::min(i, j), std::max(i, j))] = times(difference, times(u[i], u[j]));
    }
    return m;
  }

  // Rotations are finite, so a factor of exactly zero may drop a term. A metric that is not a number still shows: each
  // h_i enters some diagonal entry with a factor that does not vanish.
  NodeId times(NodeId a, NodeId b) {
    if (graph_.is_constant(a, 0.0) || graph_.is_constant(b, 0.0)) return graph_.constant(0.0);
    return graph_.make(Op::multiply, a, b);
  }
  NodeId minus(NodeId a) { return graph_.is_constant(a, 0.0) ? a : graph_.make(Op::negate, a); }

  Formula& formula_;
  Graph& graph_;
};

// M becomes (M^-1 + size^2 I)^-1 = adj(adj M + s I) det M / det(adj M + s I) / det M, s = size^2 det M: no quotient of
// large numbers where sizes are small.
template <int Dim>
void keep_above(double size, int count, TensorLanes<Dim>& out) {
  const double squared = size * size;
  for (int i = 0; i < count; ++i) {
    SymTensor<Dim> M;
    for (int k = 0; k < SymTensor<Dim>::size; ++k) M.m[k] = out[k][i];
    const double det = determinant(M);
    SymTensor<Dim> inverse = adjugate(M);
    for (int d = 0; d < Dim; ++d) inverse.m[SymTensor<Dim>::at(d, d)] += squared * det;
    const double factor = det / determinant(inverse);
    const SymTensor<Dim> floored = adjugate(inverse);
    for (int k = 0; k < SymTensor<Dim>::size; ++k) out[k][i] = factor * floored.m[k];
  }
}

std::string list_numbers(std::span<const double> values) {
  std::string text;
  for (const double v : values) {
    text += (text.empty() ? "" : ", ") + (std::isfinite(v) ? number_text(v)
                                          : std::isnan(v)  ? "not a number"
                                                           : "infinite");
  }
  return text;
}

}  // namespace

template <int Dim>
Expected<MetricField<Dim>> MetricField<Dim>::from_formula(std::string_view text) {
  Expected<Formula> formula = parse_formula(text, Dim);
  if (!formula) return formula.status();
  Expected<std::vector<NodeId>> entries = TensorBuilder<Dim>(*formula).run();
  if (!entries) return entries.status();
  Expected<Program> program = Program::compile(formula->graph, *entries);
  if (!program) return program.status();
  MetricField field;
  field.program_ = std::make_shared<const Program>(std::move(*program));
  return field;
}

template <int Dim>
MetricField<Dim> MetricField<Dim>::uniform(const SymTensor<Dim>& tensor) {
  Graph graph;
  std::array<NodeId, SymTensor<Dim>::size> entries;
  for (int i = 0; i < SymTensor<Dim>::size; ++i) entries[i] = graph.constant(tensor.m[i]);
  MetricField field;
  field.program_ = std::make_shared<const Program>(std::move(*Program::compile(graph, entries)));
  return field;
}

template <int Dim>
MetricField<Dim> MetricField<Dim>::discrete(std::shared_ptr<const DiscreteMetric<Dim>> metric) {
  MetricField field;
  field.discrete_ = std::move(metric);
  if constexpr (Dim == 3) {
    const auto [low, high] = field.discrete_->box();
    field.octree_ = std::make_shared<const SizeOctree>(field, low, high);
  }
  return field;
}

template <int Dim>
MetricField<Dim> MetricField<Dim>::approximated() const {
  MetricField field = *this;
  field.approximate_ = octree_ != nullptr;
  return field;
}

template <int Dim>
MetricField<Dim> MetricField<Dim>::scaled(double factor) const {
  MetricField field = *this;
  field.scale_ = scale_ / (factor * factor);
  return field;
}

template <int Dim>
MetricField<Dim> MetricField<Dim>::floored(double size) const {
  MetricField field = *this;
  field.floor_ = size * std::sqrt(scale_);
  return field;
}

template <int Dim>
void MetricField<Dim>::look_up(const PointLanes<Dim>& points, int count, TensorLanes<Dim>& out) const {
  if constexpr (Dim == 3) {
    std::array<int, kLanes> missed;
    const int misses = octree_->look_up(points, count, out, missed);
    if (misses == 0) return;
    PointLanes<3> others;
    TensorLanes<3> found;
    for (int d = 0; d < 3; ++d)
      for (int k = 0; k < misses; ++k) others[d][k] = points[d][missed[k]];
    discrete_->evaluate(others, misses, found);
    for (int e = 0; e < 6; ++e)
      for (int k = 0; k < misses; ++k) out[e][missed[k]] = found[e][k];
  }
}

template <int Dim>
void MetricField<Dim>::evaluate(const PointLanes<Dim>& points, int count, TensorLanes<Dim>& out) const {
  if (approximate_)
    look_up(points, count, out);
  else if (discrete_)
    discrete_->evaluate(points, count, out);
  else
    program_->run(points.data(), count, out);
  if (floor_ > 0.0) keep_above<Dim>(floor_, count, out);
  const double scale = scale_;
  if (scale == 1.0) return;
  for (Lanes& entry : out) {
    for (int i = 0; i < count; ++i) entry[i] *= scale;
  }
}

template <int Dim>
void MetricField<Dim>::evaluate(std::span<const Point<Dim>> points, std::span<SymTensor<Dim>> out) const {
  PointLanes<Dim> lanes;
  TensorLanes<Dim> tensors;
  for (std::size_t start = 0; start < points.size(); start += kLanes) {
    const int count = static_cast<int>(std::min<std::size_t>(kLanes, points.size() - start));
    for (int i = 0; i < count; ++i) {
      for (int d = 0; d < Dim; ++d) lanes[d][i] = points[start + i][d];
    }
    evaluate(lanes, count, tensors);
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < SymTensor<Dim>::size; ++k) out[start + i].m[k] = tensors[k][i];
    }
  }
}

template <int Dim>
SymTensor<Dim> MetricField<Dim>::evaluate(const Point<Dim>& point) const {
  SymTensor<Dim> tensor;
  evaluate(std::span<const Point<Dim>>(&point, 1), std::span<SymTensor<Dim>>(&tensor, 1));
  return tensor;
}

template <int Dim>
Status MetricField<Dim>::check(std::span<const Point<Dim>> points) const {
  std::array<SymTensor<Dim>, kLanes> tensors;
  for (std::size_t start = 0; start < points.size(); start += kLanes) {
    const std::span<const Point<Dim>> batch =
        points.subspan(start, std::min<std::size_t>(kLanes, points.size() - start));
    evaluate(batch, tensors);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (positive_definite(tensors[i])) continue;
      return Status::bad_input("the metric is not finite and positive definite at (" +
                               list_numbers({batch[i].data(), Dim}) + "): its tensor is (" +
                               list_numbers(tensors[i].m) + "); sizes must be positive everywhere in the domain");
    }
  }
  return {};
}

template class MetricField<2>;
template class MetricField<3>;

}  // namespace pillowmesh
