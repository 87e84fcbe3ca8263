#include "pillowmesh/metric/expression.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "pillowmesh/mesh/number.h"

namespace pillowmesh {
namespace {

struct Function {
  std::string_view name;
  Op op;
  int arguments;  // the fewest; min and max take more
};

constexpr Function kFunctions[] = {
    {"if", Op::select, 3},        {"sqrt", Op::square_root, 1},
    {"exp", Op::exponential, 1},  {"log", Op::logarithm, 1},
    {"sin", Op::sine, 1},         {"cos", Op::cosine, 1},
    {"tan", Op::tangent, 1},      {"atan2", Op::arc_tangent_2, 2},
    {"atan", Op::arc_tangent, 1}, {"asin", Op::arc_sine, 1},
    {"acos", Op::arc_cosine, 1},  {"tanh", Op::hyperbolic_tangent, 1},
    {"abs", Op::absolute, 1},     {"min", Op::minimum, 2},
    {"max", Op::maximum, 2},      {"pow", Op::power, 2},
    {"floor", Op::floor, 1},
};

const Function* find_function(std::string_view name) {
  for (const Function& f : kFunctions) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string quoted(std::string_view text) { return std::string(1, '\'').append(text).append(1, '\''); }

// Recursive descent. A failed production returns kNoNode and leaves the first error in error_.
class Parser {
 public:
  Parser(std::string_view text, int dim) : text_(text), dim_(dim) {}

  Expected<Formula> run() {
    while (!error_) {
      skip_space();
      if (at_end()) break;
      statement();
    }
    if (!error_ && formula_.assignments.empty()) fail(0, "the formula is empty; write for example 'h = 0.1 + 0.2*x'");
    if (error_) return *error_;
    return std::move(formula_);
  }

 private:
  // The recursion's stack use stays far below that of the smallest thread.
  static constexpr int kMaxDepth = 200;
  static constexpr std::size_t kMaxLength = 20'000;

  void statement() {
    if (text_.size() > kMaxLength) return fail(kMaxLength, "the formula is longer than 20000 characters");
    const std::size_t start = position_;
    const std::string_view name = read_name();
    if (name.empty()) return fail(start, "expected a name to assign to, found " + here());
    skip_space();
    if (!take('=') || peek() == '=') {
      return fail(std::min(position_, text_.size()), "expected '=' after " + quoted(name) + ", found " + here());
    }
    if (name == "x" || name == "y" || name == "z" || name == "pi") {
      return fail(start, quoted(name) + " is given and cannot be assigned");
    }
    if (find_function(name) != nullptr) return fail(start, quoted(name) + " is a function and cannot be assigned");
    const NodeId value = expression();
    if (value == kNoNode) return;
    skip_space();
    if (!at_end() && !take(';')) return fail(position_, "expected an operator or ';', found " + here());
    formula_.assignments.push_back({std::string(name), value, column(start)});
  }

  NodeId expression() {
    const NodeId left = sum();
    if (left == kNoNode) return kNoNode;
    std::string_view comparison = take_comparison();
    if (comparison.empty()) return left;
    const NodeId right = sum();
    if (right == kNoNode) return kNoNode;
    const std::size_t next = position_;
    if (!take_comparison().empty()) {
      return fail_node(next, "comparisons cannot be chained; write (a < b)*(b < c)");
    }
    if (comparison == "<") return make(Op::less, left, right);
    if (comparison == "<=") return make(Op::less_or_equal, left, right);
    if (comparison == ">") return make(Op::less, right, left);
    if (comparison == ">=") return make(Op::less_or_equal, right, left);
    return make(comparison == "==" ? Op::equal : Op::not_equal, left, right);
  }

  NodeId sum() {
    NodeId left = term();
    while (left != kNoNode) {
      const Op op = take('+') ? Op::add : take('-') ? Op::subtract : Op::constant;
      if (op == Op::constant) break;
      const NodeId right = term();
      left = right == kNoNode ? kNoNode : make(op, left, right);
    }
    return left;
  }

  NodeId term() {
    NodeId left = factor();
    while (left != kNoNode) {
      const Op op = take('*') ? Op::multiply : take('/') ? Op::divide : Op::constant;
      if (op == Op::constant) break;
      const NodeId right = factor();
      left = right == kNoNode ? kNoNode : make(op, left, right);
    }
    return left;
  }

  NodeId factor() {
    skip_space();
    if (depth_ >= kMaxDepth) return fail_node(position_, "nested too deeply");
    ++depth_;
    NodeId value = kNoNode;
    if (take('-')) {
      value = factor();
      if (value != kNoNode) value = make(Op::negate, value);
    } else if (take('+')) {
      value = factor();
    } else {
      value = primary();
      if (value != kNoNode && take('^')) {
        const NodeId exponent = factor();
        value = exponent == kNoNode ? kNoNode : make(Op::power, value, exponent);
      }
    }
    --depth_;
    return value;
  }

  NodeId primary() {
    skip_space();
    const std::size_t start = position_;
    double number = 0.0;
    if (const std::size_t length = read_number(text_.substr(position_), number); length > 0) {
      position_ += length;
      return formula_.graph.constant(number);
    }
    if (take('(')) {
      const NodeId value = expression();
      if (value == kNoNode) return kNoNode;
      return take(')') ? value : fail_node(position_, "expected ')', found " + here());
    }
    const std::string_view name = read_name();
    if (name.empty()) return fail_node(start, "expected a number, a name or '(', found " + here());
    skip_space();
    if (peek() == '(') return call(name, start);
    return look_up(name, start);
  }

  NodeId call(std::string_view name, std::size_t start) {
    const Function* function = find_function(name);
    if (function == nullptr) {
      std::string known;
      for (const Function& f : kFunctions) known += (known.empty() ? "" : ", ") + std::string(f.name);
      return fail_node(start, "unknown function " + quoted(name) + "; known: " + known);
    }
    take('(');
    std::vector<NodeId> arguments;
    do {
      const NodeId argument = expression();
      if (argument == kNoNode) return kNoNode;
      arguments.push_back(argument);
    } while (take(','));
    if (!take(')')) return fail_node(position_, "expected ',' or ')', found " + here());

    const auto given = static_cast<int>(arguments.size());
    const bool open = function->op == Op::minimum || function->op == Op::maximum;
    if (open ? given < function->arguments : given != function->arguments) {
      return fail_node(start, quoted(name) + " takes " + std::to_string(function->arguments) +
                                  (open ? " or more" : "") + (function->arguments == 1 ? " argument" : " arguments") +
                                  ", not " + std::to_string(given));
    }
    if (open) {
      NodeId value = arguments[0];
      for (int i = 1; i < given; ++i) value = make(function->op, value, arguments[i]);
      return value;
    }
    return make(function->op, arguments[0], given > 1 ? arguments[1] : kNoNode, given > 2 ? arguments[2] : kNoNode);
  }

  NodeId look_up(std::string_view name, std::size_t start) {
    // Assigned names first: a formula may define its own r.
    if (const Formula::Assignment* earlier = formula_.find(name)) return earlier->value;
    Graph& graph = formula_.graph;
    if (name == "x") return graph.variable(0);
    if (name == "y") return graph.variable(1);
    if (name == "z" && dim_ == 3) return graph.variable(2);
    if (name == "z") return fail_node(start, "'z' is not available: the mesh is two-dimensional");
    if (name == "pi") return graph.constant(std::numbers::pi);
    if (name == "r") return radius();
    if (find_function(name) != nullptr)
      return fail_node(start, quoted(name) + " is a function: write " + std::string(name) + "(...)");

    std::string known = dim_ == 3 ? "x, y, z, r, pi" : "x, y, r, pi";
    for (const Formula::Assignment& a : formula_.assignments) {
      if (formula_.find(a.name) == &a) known.append(", ").append(a.name);
    }
    return fail_node(start, "unknown name " + quoted(name) + "; known: " + known);
  }

  NodeId radius() {
    Graph& graph = formula_.graph;
    NodeId square = kNoNode;
    for (int axis = 0; axis < dim_; ++axis) {
      const NodeId coordinate = graph.variable(axis);
      const NodeId term = make(Op::multiply, coordinate, coordinate);
      square = axis == 0 ? term : make(Op::add, square, term);
    }
    return make(Op::square_root, square);
  }

  NodeId make(Op op, NodeId a, NodeId b = kNoNode, NodeId c = kNoNode) { return formula_.graph.make(op, a, b, c); }

  [[nodiscard]] bool at_end() const { return position_ >= text_.size(); }
  [[nodiscard]] char peek() const { return at_end() ? '\0' : text_[position_]; }
  void skip_space() {
    while (!at_end() && is_space(text_[position_])) ++position_;
  }
  bool take(char c) {
    skip_space();
    if (at_end() || text_[position_] != c) return false;
    ++position_;
    return true;
  }
  std::string_view take_comparison() {
    skip_space();
    for (const std::string_view symbol : {"<=", ">=", "==", "!=", "<", ">"}) {
      if (text_.substr(position_, symbol.size()) == symbol) {
        position_ += symbol.size();
        return symbol;
      }
    }
    return {};
  }
  std::string_view read_name() {
    const std::size_t start = position_;
    if (!is_letter(peek())) return {};
    while (is_letter(peek()) || is_digit(peek())) ++position_;
    return text_.substr(start, position_ - start);
  }

  // Bytes that continue a UTF-8 character do not count.
  [[nodiscard]] int column(std::size_t position) const {
    int column = 1;
    for (std::size_t i = 0; i < position; ++i) column += (static_cast<unsigned char>(text_[i]) & 0xc0) == 0x80 ? 0 : 1;
    return column;
  }
  [[nodiscard]] std::string here() const {
    if (at_end()) return "the end of the formula";
    std::size_t length = 1;
    while (position_ + length < text_.size() && (static_cast<unsigned char>(text_[position_ + length]) & 0xc0) == 0x80)
      ++length;
    return quoted(text_.substr(position_, length));
  }
  void fail(std::size_t position, const std::string& reason) {
    if (!error_) error_ = Status::usage("column " + std::to_string(column(position)) + ": " + reason);
  }
  NodeId fail_node(std::size_t position, const std::string& reason) {
    fail(position, reason);
    return kNoNode;
  }

  std::string_view text_;
  int dim_;
  std::size_t position_ = 0;
  int depth_ = 0;
  Formula formula_;
  std::optional<Status> error_;
};

}  // namespace

const Formula::Assignment* Formula::find(std::string_view name) const {
  for (auto a = assignments.rbegin(); a != assignments.rend(); ++a) {
    if (a->name == name) return &*a;
  }
  return nullptr;
}

Expected<Formula> parse_formula(std::string_view text, int dim) { return Parser(text, dim).run(); }

}  // namespace pillowmesh
