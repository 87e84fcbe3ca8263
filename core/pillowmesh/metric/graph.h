// A formula as a graph of operations: every value computed once, constants folded.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace pillowmesh {

/// The operations of formulas. The last group is made by rewriting, never written by users.
enum class Op : std::uint8_t {
  constant,
  variable,
  add,
  subtract,
  multiply,
  divide,
  negate,
  power,
  square_root,
  exponential,
  logarithm,
  sine,
  cosine,
  tangent,
  arc_sine,
  arc_cosine,
  arc_tangent,
  arc_tangent_2,
  hyperbolic_tangent,
  absolute,
  minimum,
  maximum,
  floor,
  less,  ///< 1 or 0; false when an operand is not a number
  less_or_equal,
  equal,
  not_equal,
  select,          ///< a != 0 ? b : c
  cosine_of_arc,   ///< a / b, and 1 where b is 0: with b = sqrt(a^2 + c^2), cos(atan2(c, a))
  sine_of_arc,     ///< a / b, and 0 where b is 0: sin(atan2(a, c)), likewise
  size_to_metric,  ///< 1 / a^2, and not a number unless a > 0
  skip_if_none,    ///< programs only: jumps when no lane of a is true
  skip_if_all,     ///< programs only: jumps when all lanes of a are true
};

/// A value in a Graph.
using NodeId = int;
inline constexpr NodeId kNoNode = -1;

struct Node {
  Op op = Op::constant;
  std::array<NodeId, 3> operands{kNoNode, kNoNode, kNoNode};
  double value = 0.0;  ///< of a constant; the axis of a variable
};

/// Operands precede their users. Equal operations on equal operands are one node.
class Graph {
 public:
  NodeId constant(double value);
  NodeId variable(int axis);
  /// The node of this operation after folding and simplification. What is rewritten: constant operands; x^2, x^3, x^4,
  /// x^-1, x^-2, x^.5 become products, quotients, roots; c^x becomes exp(x log c); cos and sin of atan2 (also shifted
  /// by a quarter turn) become quotients.
  NodeId make(Op op, NodeId a, NodeId b = kNoNode, NodeId c = kNoNode);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] bool is_constant(NodeId id) const { return nodes_[id].op == Op::constant; }
  [[nodiscard]] bool is_constant(NodeId id, double value) const { return is_constant(id) && nodes_[id].value == value; }

 private:
  NodeId insert(const Node& node);
  NodeId simplify(Op op, NodeId a, NodeId b, NodeId c);
  NodeId simplify_power(NodeId base, NodeId exponent);
  NodeId simplify_circular(Op op, NodeId angle);

  std::vector<Node> nodes_;
  std::map<std::array<std::uint64_t, 3>, NodeId> known_;
};

/// Number of operands of `op`.
int operand_count(Op op);
/// The operation on plain numbers; programs compute the same bits lane by lane.
double apply(Op op, double a, double b, double c);

}  // namespace pillowmesh
