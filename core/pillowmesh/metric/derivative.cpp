#include "pillowmesh/metric/derivative.h"

#include <vector>

namespace pillowmesh {
namespace {

class Differentiation {
 public:
  Differentiation(Graph& graph, int axis) : g_(graph), axis_(axis) {}

  NodeId run(NodeId value) {
    // Operands precede their users: all derivatives that are needed, in order. The graph grows behind `value`.
    std::vector<char> needed(static_cast<std::size_t>(value) + 1, 0);
    needed[value] = 1;
    for (NodeId id = value; id >= 0; --id) {
      if (!needed[id]) continue;
      const Node node = g_.nodes()[id];
      for (int k = 0; k < operand_count(node.op); ++k) needed[node.operands[k]] = 1;
    }
    derivative_.assign(needed.size(), kNoNode);
    for (NodeId id = 0; id <= value; ++id)
      if (needed[id]) derivative_[id] = of(id);
    return derivative_[value];
  }

 private:
  NodeId number(double v) { return g_.constant(v); }
  bool zero(NodeId n) const { return g_.is_constant(n, 0.0); }
  // A factor of 0 stands for "does not depend on the coordinate": what it multiplies does not matter, even if infinite.
  NodeId times(NodeId a, NodeId b) { return zero(a) || zero(b) ? number(0.0) : g_.make(Op::multiply, a, b); }
  NodeId over(NodeId a, NodeId b) { return zero(a) ? a : g_.make(Op::divide, a, b); }
  NodeId plus(NodeId a, NodeId b) { return g_.make(Op::add, a, b); }
  NodeId minus(NodeId a, NodeId b) { return zero(b) ? a : g_.make(Op::subtract, a, b); }
  NodeId square(NodeId a) { return g_.make(Op::multiply, a, a); }
  NodeId root(NodeId a) { return g_.make(Op::square_root, a); }

  NodeId of(NodeId id) {
    const Node n = g_.nodes()[id];
    const NodeId a = n.operands[0], b = n.operands[1], c = n.operands[2];
    const auto d = [&](NodeId operand) { return derivative_[operand]; };
    switch (n.op) {
      case Op::variable:
        return number(static_cast<int>(n.value) == axis_ ? 1.0 : 0.0);
      case Op::add:
        return plus(d(a), d(b));
      case Op::subtract:
        return minus(d(a), d(b));
      case Op::multiply:
        return plus(times(d(a), b), times(a, d(b)));
      case Op::divide:
      case Op::cosine_of_arc:
      case Op::sine_of_arc:
        return minus(over(d(a), b), times(over(id, b), d(b)));
      case Op::negate:
        return minus(number(0.0), d(a));
      case Op::power:
        if (zero(d(b)))  // a^b: b a^(b-1) a'
          return times(times(b, g_.make(Op::power, a, minus(b, number(1.0)))), d(a));
        return times(id, plus(times(d(b), g_.make(Op::logarithm, a)), times(b, over(d(a), a))));
      case Op::square_root:
        return over(times(number(0.5), d(a)), id);
      case Op::exponential:
        return times(id, d(a));
      case Op::logarithm:
        return over(d(a), a);
      case Op::sine:
        return times(g_.make(Op::cosine, a), d(a));
      case Op::cosine:
        return minus(number(0.0), times(g_.make(Op::sine, a), d(a)));
      case Op::tangent:
        return times(plus(number(1.0), square(id)), d(a));
      case Op::arc_sine:
        return over(d(a), root(minus(number(1.0), square(a))));
      case Op::arc_cosine:
        return minus(number(0.0), over(d(a), root(minus(number(1.0), square(a)))));
      case Op::arc_tangent:
        return over(d(a), plus(number(1.0), square(a)));
      case Op::arc_tangent_2:  // atan2(a, b)
        return over(minus(times(b, d(a)), times(a, d(b))), plus(square(a), square(b)));
      case Op::hyperbolic_tangent:
        return times(minus(number(1.0), square(id)), d(a));
      case Op::absolute:
        return choose(g_.make(Op::less, a, number(0.0)), minus(number(0.0), d(a)), d(a));
      case Op::minimum:
        return choose(g_.make(Op::less, a, b), d(a), d(b));
      case Op::maximum:
        return choose(g_.make(Op::less, b, a), d(a), d(b));
      case Op::select:
        return choose(a, d(b), d(c));
      case Op::size_to_metric:  // a^-2
        return times(number(-2.0), over(times(id, d(a)), a));
      default:  // constants; floor, comparisons: flat between their jumps
        return number(0.0);
    }
  }
  NodeId choose(NodeId condition, NodeId yes, NodeId no) {
    return yes == no ? yes : g_.make(Op::select, condition, yes, no);
  }

  Graph& g_;
  int axis_;
  std::vector<NodeId> derivative_;
};

}  // namespace

NodeId differentiate(Graph& graph, NodeId value, int axis) { return Differentiation(graph, axis).run(value); }

}  // namespace pillowmesh
