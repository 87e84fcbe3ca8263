#include "pillowmesh/metric/hessian.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "pillowmesh/mesh/number.h"
#include "pillowmesh/mesh/portable_math.h"
#include "pillowmesh/metric/derivative.h"
#include "pillowmesh/metric/expression.h"
#include "pillowmesh/metric/sample.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

/// An assignment, not a comparison.
bool has_statement(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ';') return true;
    if (text[i] != '=') continue;
    const bool compares = (i > 0 && (text[i - 1] == '<' || text[i - 1] == '>' || text[i - 1] == '!')) ||
                          (i + 1 < text.size() && text[i + 1] == '=');
    if (!compares) return true;
    if (i + 1 < text.size() && text[i + 1] == '=') ++i;
  }
  return false;
}

/// |H| with eigenvalues of at least `least`.
template <int Dim>
SymTensor<Dim> absolute(const SymTensor<Dim>& H, double least) {
  return map_eigenvalues(H, [least](double v) { return std::max(std::fabs(v), least); });
}

template <int Dim>
double largest_curvature(std::span<const SymTensor<Dim>> hessians) {
  double most = 0.0;
  for (const SymTensor<Dim>& H : hessians) {
    if (!std::all_of(H.m.begin(), H.m.end(), [](double v) { return std::isfinite(v); })) continue;
    const Spectrum<Dim> s = spectrum(H);
    most = std::max({most, -s.value[0], s.value[Dim - 1]});
  }
  return most;
}

Status no_curvature() {
  return Status::bad_input(
      "the function has no curvature that is finite and not zero: any mesh interpolates it alike, so there is no "
      "metric");
}

}  // namespace

template <int Dim>
Expected<FormulaHessian<Dim>> FormulaHessian<Dim>::from_formula(std::string_view text) {
  const bool statements = has_statement(text);
  // "f=" is not what the user typed: columns are counted from behind it.
  Expected<Formula> formula = parse_formula(statements ? std::string(text) : "f=" + std::string(text), Dim);
  if (!formula) {
    std::string message = formula.status().message;
    const std::string_view head = "column ";
    if (!statements && message.starts_with(head)) {
      const std::size_t end = message.find(':');
      std::int64_t column = 0;
      parse_integer(std::string_view(message).substr(head.size(), end - head.size()), column);
      message = std::string(head) + std::to_string(std::max<std::int64_t>(1, column - 2)) + message.substr(end);
    }
    return Status::usage(message);
  }
  const Formula::Assignment* f = formula->find("f");
  if (f == nullptr) return Status::usage("the statements do not assign 'f', the function whose Hessian is asked for");
  std::vector<NodeId> outputs;
  for (int j = 0; j < Dim; ++j)
    for (int i = 0; i <= j; ++i)
      outputs.push_back(differentiate(formula->graph, differentiate(formula->graph, f->value, i), j));
  Expected<Program> program = Program::compile(formula->graph, outputs);
  if (!program) return program.status();
  return FormulaHessian(std::move(*program));
}

template <int Dim>
void FormulaHessian<Dim>::evaluate(std::span<const Point<Dim>> points, std::span<SymTensor<Dim>> out) const {
  PointLanes<Dim> lanes;
  TensorLanes<Dim> tensors;
  for (std::size_t start = 0; start < points.size(); start += kLanes) {
    const int count = static_cast<int>(std::min<std::size_t>(kLanes, points.size() - start));
    for (int i = 0; i < count; ++i)
      for (int d = 0; d < Dim; ++d) lanes[d][i] = points[start + i][d];
    program_.run(lanes.data(), count, tensors);
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < SymTensor<Dim>::size; ++k) out[start + i].m[k] = tensors[k][i];
  }
}

template <int Dim>
Expected<NodalMetric<Dim>> hessian_metric(const FormulaHessian<Dim>& hessian, const Point<Dim>& low,
                                          const Point<Dim>& high, const HessianOptions& options) {
  // The floor has to be known before sampling: from a grid, fine enough to meet every feature that a mesh could follow.
  std::array<int, Dim> n;
  n.fill(Dim == 2 ? 256 : 40);
  NodalMetric<Dim> probe = nodal_grid<Dim>(n, low, high);
  hessian.evaluate(probe.points, probe.tensors);
  const double least = options.floor * largest_curvature<Dim>(probe.tensors);
  if (!(least > 0.0)) return no_curvature();
  const Evaluate<Dim> bounded = [&](std::span<const Point<Dim>> points, std::span<SymTensor<Dim>> out) {
    hessian.evaluate(points, out);
    for (SymTensor<Dim>& H : out) H = absolute(H, least);
  };
  // Metric lengths mean nothing yet: |H| is divided until it is smooth, or as fine as the number of points allows.
  double diagonal = 0.0;
  for (int d = 0; d < Dim; ++d) diagonal += (high[d] - low[d]) * (high[d] - low[d]);
  SampleOptions sampling;
  sampling.tolerance = 0.1;
  sampling.shortest = 2e-3 * std::sqrt(diagonal * least / options.floor);
  sampling.max_points = 60'000;
  NodalMetric<Dim> metric = sample<Dim>(bounded, low, high, sampling);
  if (Status s = multiscale_metric(metric, options); !s.ok()) return s;
  return metric;
}

template <int Dim>
Status multiscale_metric(NodalMetric<Dim>& hessians, const HessianOptions& options) {
  const double most = largest_curvature<Dim>(hessians.tensors);
  if (!(most > 0.0) || !std::isfinite(most)) return no_curvature();
  const bool maximum = options.norm >= 1e100;
  const double exponent = maximum ? 0.0 : 1.0 / (2.0 * options.norm + Dim);
  std::vector<double> density(hessians.tensors.size());
  for (std::size_t i = 0; i < density.size(); ++i) {
    SymTensor<Dim>& M = hessians.tensors[i];
    if (!std::all_of(M.m.begin(), M.m.end(), [](double v) { return std::isfinite(v); })) M = {};
    M = absolute(M, options.floor * most);
    const double det = determinant(M);
    density[i] = maximum ? 0.0 : portable::pow(det, options.norm * exponent);
    M = portable::pow(det, -exponent) * M;
  }
  if (options.error > 0.0) {
    double integral = 0.0;
    for (const Simplex<Dim>& s : hessians.simplices) {
      double mean = 0.0;
      for (const VertexId v : s) mean += density[v] / (Dim + 1);
      integral += mean * std::fabs(simplex_determinant<Dim>(hessians.points, s)) / (Dim == 2 ? 2.0 : 6.0);
    }
    const double k = Dim / (8.0 * options.error) * (maximum ? 1.0 : portable::pow(integral, 1.0 / options.norm));
    for (SymTensor<Dim>& M : hessians.tensors) M = k * M;
  }
  return {};
}

#define PILLOWMESH_INSTANTIATE(D)                                                                                 \
  template class FormulaHessian<D>;                                                                               \
  template Expected<NodalMetric<D>> hessian_metric<D>(const FormulaHessian<D>&, const Point<D>&, const Point<D>&, \
                                                      const HessianOptions&);                                     \
  template Status multiscale_metric<D>(NodalMetric<D>&, const HessianOptions&);
PILLOWMESH_INSTANTIATE(2)
PILLOWMESH_INSTANTIATE(3)
#undef PILLOWMESH_INSTANTIATE

}  // namespace pillowmesh
