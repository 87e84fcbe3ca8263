#include "pillowmesh/metric/graph.h"

#include <cstring>
#include <numbers>

#include "pillowmesh/metric/branchless.h"
#include "pillowmesh/metric/operations.h"

namespace pillowmesh {
namespace {

bool is_sum_of_squares(const Graph& graph, NodeId a) {
  const Node& node = graph.nodes()[a];
  const auto& [u, v, none] = node.operands;
  return (node.op == Op::multiply && u == v) ||
         (node.op == Op::add && is_sum_of_squares(graph, u) && is_sum_of_squares(graph, v));
}

/// The root of x^2 + y^2, squared, is not computed again: so atan2(z, sqrt(x^2 + y^2)) leads to the r that all use.
NodeId square_of(Graph& graph, NodeId a) {
  const Node node = graph.nodes()[a];
  const bool root = node.op == Op::square_root && is_sum_of_squares(graph, node.operands[0]);
  return root ? node.operands[0] : graph.make(Op::multiply, a, a);
}

}  // namespace

int operand_count(Op op) {
  switch (op) {
    case Op::constant:
    case Op::variable:
      return 0;
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::power:
    case Op::arc_tangent_2:
    case Op::minimum:
    case Op::maximum:
    case Op::less:
    case Op::less_or_equal:
    case Op::equal:
    case Op::not_equal:
    case Op::cosine_of_arc:
    case Op::sine_of_arc:
      return 2;
    case Op::select:
      return 3;
    default:
      return 1;
  }
}

double apply(Op op, double a, double b, double c) {
  using namespace operations;
  switch (op) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a / b;
    case Op::negate:
      return -a;
    case Op::power:
      return portable::pow(a, b);
    case Op::square_root:
      return std::sqrt(a);
    case Op::exponential:
      return portable::exp(a);
    case Op::logarithm:
      return branchless::log(a);
    case Op::sine:
      return portable::sin(a);
    case Op::cosine:
      return portable::cos(a);
    case Op::tangent:
      return portable::tan(a);
    case Op::arc_sine:
      return portable::asin(a);
    case Op::arc_cosine:
      return portable::acos(a);
    case Op::arc_tangent:
      return portable::atan(a);
    case Op::arc_tangent_2:
      return portable::atan2(a, b);
    case Op::hyperbolic_tangent:
      return branchless::tanh(a);
    case Op::absolute:
      return std::fabs(a);
    case Op::minimum:
      return minimum(a, b);
    case Op::maximum:
      return maximum(a, b);
    case Op::floor:
      return portable::floor(a);
    case Op::less:
      return truth(a < b);
    case Op::less_or_equal:
      return truth(a <= b);
    case Op::equal:
      return truth(a == b);
    case Op::not_equal:
      return truth(a != b);
    case Op::select:
      return a != 0.0 ? b : c;
    case Op::cosine_of_arc:
      return operations::cosine_of_arc(a, b);
    case Op::sine_of_arc:
      return operations::sine_of_arc(a, b);
    case Op::size_to_metric:
      return operations::size_to_metric(a);
    default:
      return 0.0;
  }
}

NodeId Graph::insert(const Node& node) {
  const auto& o = node.operands;
  std::uint64_t value_bits = 0;  // by memcpy: std::bit_cast is missing from Emscripten 3.1.6
  std::memcpy(&value_bits, &node.value, sizeof value_bits);
  const std::array<std::uint64_t, 3> key{
      static_cast<std::uint64_t>(node.op) << 32 | static_cast<std::uint32_t>(o[2]),
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(o[0])) << 32 | static_cast<std::uint32_t>(o[1]),
      value_bits};
  const auto [entry, is_new] = known_.try_emplace(key, static_cast<NodeId>(nodes_.size()));
  if (is_new) nodes_.push_back(node);
  return entry->second;
}

NodeId Graph::constant(double value) { return insert({Op::constant, {kNoNode, kNoNode, kNoNode}, value}); }

NodeId Graph::variable(int axis) {
  return insert({Op::variable, {kNoNode, kNoNode, kNoNode}, static_cast<double>(axis)});
}

NodeId Graph::make(Op op, NodeId a, NodeId b, NodeId c) {
  const NodeId operands[] = {a, b, c};
  double values[3] = {};
  bool all_constant = true;
  for (int i = 0; i < operand_count(op); ++i) {
    all_constant = all_constant && is_constant(operands[i]);
    values[i] = nodes_[operands[i]].value;
  }
  if (all_constant) return constant(apply(op, values[0], values[1], values[2]));
  const NodeId simpler = simplify(op, a, b, c);
  return simpler != kNoNode ? simpler : insert({op, {a, b, c}, 0.0});
}

// Only rewrites that keep the value for every finite argument: 0 * x stays, for x may be infinite.
NodeId Graph::simplify(Op op, NodeId a, NodeId b, NodeId c) {
  switch (op) {
    case Op::add:
      if (is_constant(a, 0.0)) return b;
      if (is_constant(b, 0.0)) return a;
      if (nodes_[b].op == Op::negate) return make(Op::subtract, a, nodes_[b].operands[0]);
      return a > b ? make(Op::add, b, a) : kNoNode;
    case Op::subtract:
      if (is_constant(b, 0.0)) return a;
      if (nodes_[b].op == Op::negate) return make(Op::add, a, nodes_[b].operands[0]);
      return kNoNode;
    case Op::multiply:
      if (is_constant(a, 1.0)) return b;
      if (is_constant(b, 1.0)) return a;
      return a > b ? make(Op::multiply, b, a) : kNoNode;
    case Op::divide:
      return is_constant(b, 1.0) ? a : kNoNode;
    case Op::negate:
      return nodes_[a].op == Op::negate ? nodes_[a].operands[0] : kNoNode;
    case Op::absolute:
      return nodes_[a].op == Op::negate ? make(Op::absolute, nodes_[a].operands[0]) : kNoNode;
    case Op::power:
      return simplify_power(a, b);
    case Op::cosine:
    case Op::sine:
      return simplify_circular(op, a);
    case Op::select:
      if (is_constant(a)) return nodes_[a].value != 0.0 ? b : c;
      return b == c ? b : kNoNode;
    default:
      return kNoNode;
  }
}

NodeId Graph::simplify_power(NodeId base, NodeId exponent) {
  if (is_constant(base) && nodes_[base].value > 0.0) {
    const double log_base = portable::log(nodes_[base].value);
    return make(Op::exponential, make(Op::multiply, exponent, constant(log_base)));
  }
  if (!is_constant(exponent)) return kNoNode;
  const double e = nodes_[exponent].value;
  if (e == 0.0) return constant(1.0);
  if (e == 1.0) return base;
  if (e == 0.5) return make(Op::square_root, base);
  if (e == -1.0) return make(Op::divide, constant(1.0), base);
  if (e == 2.0 || e == 3.0 || e == 4.0 || e == -2.0) {
    const NodeId square = make(Op::multiply, base, base);
    if (e == 2.0) return square;
    if (e == 3.0) return make(Op::multiply, square, base);
    if (e == 4.0) return make(Op::multiply, square, square);
    return make(Op::divide, constant(1.0), square);
  }
  return kNoNode;
}

NodeId Graph::simplify_circular(Op op, NodeId angle) {
  const bool cosine = op == Op::cosine;
  const Node node = nodes_[angle];
  if (node.op == Op::arc_tangent_2) {
    const auto [y, x, none] = node.operands;
    const NodeId square = make(Op::add, square_of(*this, x), square_of(*this, y));
    return make(cosine ? Op::cosine_of_arc : Op::sine_of_arc, cosine ? x : y, make(Op::square_root, square));
  }
  if (node.op == Op::negate) {
    const NodeId positive = make(op, node.operands[0]);
    return cosine ? positive : make(Op::negate, positive);
  }
  if (node.op != Op::add && node.op != Op::subtract) return kNoNode;

  // A quarter turn: cos(u + q) = -sin u, sin(u + q) = cos u; cos(u - q) = sin u, sin(u - q) = -cos u.
  constexpr double kQuarter = std::numbers::pi / 2;
  const bool add = node.op == Op::add;
  for (int i = add ? 0 : 1; i < 2; ++i) {
    const NodeId other = node.operands[1 - i];
    const bool plus = is_constant(node.operands[i], add ? kQuarter : -kQuarter);
    const bool minus = is_constant(node.operands[i], add ? -kQuarter : kQuarter);
    if (!plus && !minus) continue;
    const NodeId turned = make(cosine ? Op::sine : Op::cosine, other);
    return cosine == plus ? make(Op::negate, turned) : turned;
  }
  if (!add && is_constant(node.operands[0], kQuarter)) return make(cosine ? Op::sine : Op::cosine, node.operands[1]);
  return kNoNode;
}

}  // namespace pillowmesh
