#include "pillowmesh/metric/program.h"

#include <algorithm>

namespace pillowmesh {
namespace {

// Where a node is needed: always, or only where the condition of some `if` is true (or false). Places form a tree.
struct Place {
  int parent;
  int depth;
  NodeId select;
  bool when_true;
};

int common_place(const std::vector<Place>& places, int a, int b) {
  while (a != b) {
    if (places[a].depth >= places[b].depth) {
      a = places[a].parent;
    } else {
      b = places[b].parent;
    }
  }
  return a;
}

// In units of one addition.
int cost(Op op) {
  switch (op) {
    case Op::constant:
    case Op::variable:
      return 0;
    case Op::divide:
    case Op::square_root:
    case Op::size_to_metric:
    case Op::cosine_of_arc:
    case Op::sine_of_arc:
      return 4;
    case Op::floor:
      return 8;
    case Op::power:
    case Op::exponential:
    case Op::logarithm:
    case Op::sine:
    case Op::cosine:
    case Op::tangent:
    case Op::arc_sine:
    case Op::arc_cosine:
    case Op::arc_tangent:
    case Op::arc_tangent_2:
    case Op::hyperbolic_tangent:
      return 25;
    default:
      return 1;
  }
}

bool is_arithmetic(Op op) { return op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide; }

// A side of an `if` cheaper than this is computed without asking whether any point needs it.
constexpr int kWorthSkipping = 6;

}  // namespace

class ProgramBuilder {
 public:
  ProgramBuilder(const Graph& graph, std::span<const NodeId> outputs, bool pairs)
      : nodes_(graph.nodes()), outputs_(outputs), pairs_(pairs), first_(nodes_.size(), kNoNode), in_pair_(nodes_.size(), false) {}

  Expected<Program> run() {
    find_places();
    if (pairs_) find_pairs();
    members_.resize(places_.size());
    for (NodeId id = 0; id < node_count(); ++id) {
      if (place_[id] != kUnused && cost(nodes_[id].op) > 0 && !in_pair_[id]) members_[place_[id]].push_back(id);
    }
    schedule(0);
    return assign_registers();
  }

 private:
  static constexpr int kUnused = -1;

  // A line of the schedule: a node to compute, or a jump over `length` lines.
  struct Line {
    NodeId node;
    Op jump = Op::constant;
    int length = 0;
  };

  [[nodiscard]] int node_count() const { return static_cast<int>(nodes_.size()); }

  // Users come after their operands, so one sweep backwards sees all users of a node before the node.
  void find_places() {
    places_.push_back({-1, 0, kNoNode, false});
    place_.assign(nodes_.size(), kUnused);
    side_.assign(nodes_.size(), {kUnused, kUnused});
    const auto need = [&](NodeId id, int place) {
      place_[id] = place_[id] == kUnused ? place : common_place(places_, place_[id], place);
    };
    for (const NodeId id : outputs_) need(id, 0);
    for (NodeId id = node_count() - 1; id >= 0; --id) {
      const int here = place_[id];
      if (here == kUnused) continue;
      const Node& node = nodes_[id];
      if (node.op == Op::select) {
        need(node.operands[0], here);
        for (int k = 0; k < 2; ++k) {
          side_[id][k] = static_cast<int>(places_.size());
          places_.push_back({here, places_[here].depth + 1, id, k == 0});
          need(node.operands[1 + k], side_[id][k]);
        }
      } else {
        for (int i = 0; i < operand_count(node.op); ++i) need(node.operands[i], here);
      }
    }
  }

  // Operations whose result nobody needs but the next one, at the same place.
  void find_pairs() {
    std::vector<int> uses(nodes_.size(), 0);
    for (const NodeId id : outputs_) ++uses[id];
    for (NodeId id = 0; id < node_count(); ++id)
      for (int i = 0; place_[id] != kUnused && i < operand_count(nodes_[id].op); ++i) ++uses[nodes_[id].operands[i]];
    for (NodeId id = 0; id < node_count(); ++id) {
      if (place_[id] == kUnused || !is_arithmetic(nodes_[id].op)) continue;
      for (int i = 0; i < 2 && first_[id] == kNoNode; ++i) {
        const NodeId operand = nodes_[id].operands[i];
        if (!is_arithmetic(nodes_[operand].op) || uses[operand] != 1 || place_[operand] != place_[id] || first_[operand] != kNoNode)
          continue;
        first_[id] = operand;
        in_pair_[operand] = true;
      }
    }
  }

  // What a line reads.
  struct Operands {
    std::array<NodeId, 3> ids{kNoNode, kNoNode, kNoNode};
    int count = 0;
  };
  [[nodiscard]] Operands operands_of(const Line& line) const {
    const Node& node = nodes_[line.node];
    if (line.jump != Op::constant) return {{line.node}, 1};
    const NodeId first = first_[line.node];
    if (first == kNoNode) return {node.operands, operand_count(node.op)};
    return {{nodes_[first].operands[0], nodes_[first].operands[1], node.operands[node.operands[0] == first ? 1 : 0]}, 3};
  }

  // The nodes of a place in order; the sides of an `if` just before the `if` itself, by when all that they use from
  // outside is there.
  void schedule(int place) {
    for (const NodeId id : members_[place]) {
      if (nodes_[id].op == Op::select) {
        for (int k = 0; k < 2; ++k) {
          const std::size_t jump = lines_.size();
          lines_.push_back({nodes_[id].operands[0], k == 0 ? Op::skip_if_none : Op::skip_if_all});
          schedule(side_[id][k]);
          int work = 0;
          for (std::size_t i = jump + 1; i < lines_.size(); ++i) {
            const NodeId node = lines_[i].node;
            if (lines_[i].jump != Op::constant) continue;
            work += cost(nodes_[node].op) + (first_[node] != kNoNode ? cost(nodes_[first_[node]].op) : 0);
          }
          if (work >= kWorthSkipping) {
            lines_[jump].length = static_cast<int>(lines_.size() - jump - 1);
          } else {
            lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(jump));
          }
        }
      }
      lines_.push_back({id});
    }
  }

  // Linear scan over the schedule. Jumps lead forward only and over values that nobody else reads, so the order of
  // lines is enough to tell when a register is free.
  Expected<Program> assign_registers() {
    constexpr int kForever = 1 << 30;
    std::vector<int> last_use(nodes_.size(), -1);
    for (int i = 0; i < static_cast<int>(lines_.size()); ++i) {
      const Operands operands = operands_of(lines_[i]);
      for (int k = 0; k < operands.count; ++k) last_use[operands.ids[k]] = i;
    }
    for (const NodeId id : outputs_) last_use[id] = kForever;

    Program program;
    for (NodeId id = 0; id < node_count(); ++id) {
      if (place_[id] != kUnused && nodes_[id].op == Op::variable) {
        program.axes_ = std::max(program.axes_, static_cast<int>(nodes_[id].value) + 1);
      }
    }
    register_.assign(nodes_.size(), 0);
    std::vector<std::int16_t> free;
    program.registers_ = program.axes_;
    for (NodeId id = 0; id < node_count(); ++id) {
      if (place_[id] == kUnused) continue;
      if (nodes_[id].op == Op::variable) register_[id] = static_cast<std::int16_t>(nodes_[id].value);
      if (nodes_[id].op != Op::constant) continue;
      register_[id] = static_cast<std::int16_t>(~static_cast<int>(program.constants_.size()));
      program.constants_.emplace_back().fill(nodes_[id].value);
    }
    if (program.constants_.size() > 30'000 || lines_.size() > 30'000) return too_complex();

    for (int i = 0; i < static_cast<int>(lines_.size()); ++i) {
      const Line& line = lines_[i];
      const Node& node = nodes_[line.node];
      Program::Instruction instruction;
      if (line.jump != Op::constant) {
        instruction.op = line.jump;
        instruction.a = register_[line.node];
        instruction.c = static_cast<std::int16_t>(line.length);
      } else {
        // The result never shares a register with an operand: the loops of run() may assume no aliasing.
        if (free.empty()) free.push_back(static_cast<std::int16_t>(program.registers_++));
        if (program.registers_ > Program::kMaxRegisters) return too_complex();
        instruction.op = node.op;
        if (const NodeId first = first_[line.node]; first != kNoNode) {
          instruction.op = nodes_[first].op;
          instruction.then = node.op;
          instruction.second = node.operands[0] != first;
        }
        instruction.out = register_[line.node] = free.back();
        free.pop_back();
        std::int16_t* const fields[] = {&instruction.a, &instruction.b, &instruction.c};
        const Operands operands = operands_of(line);
        for (int k = 0; k < operands.count; ++k) *fields[k] = register_[operands.ids[k]];
      }
      program.code_.push_back(instruction);
      release(line, i, last_use, free, program.axes_);
    }
    for (const NodeId id : outputs_) program.outputs_.push_back(register_[id]);
    return program;
  }

  void release(const Line& line, int now, std::vector<int>& last_use, std::vector<std::int16_t>& free, int axes) {
    const auto end = [&](NodeId id) {
      if (last_use[id] != now) return;
      last_use[id] = -1;
      if (register_[id] >= axes) free.push_back(register_[id]);
    };
    const Operands operands = operands_of(line);
    for (int k = 0; k < operands.count; ++k) end(operands.ids[k]);
  }

  static Status too_complex() { return Status::usage("the formula keeps too many values at once; simplify it"); }

  const std::vector<Node>& nodes_;
  std::span<const NodeId> outputs_;
  bool pairs_;
  std::vector<Place> places_;
  std::vector<int> place_;                    // of each node
  std::vector<std::array<int, 2>> side_;      // of each select
  std::vector<std::vector<NodeId>> members_;  // of each place, in order
  std::vector<Line> lines_;
  std::vector<NodeId> first_;           // of a pair, of each node that is the second of one
  std::vector<bool> in_pair_;           // the first of one
  std::vector<std::int16_t> register_;  // of each node
};

Expected<Program> Program::compile(const Graph& graph, std::span<const NodeId> outputs) {
  // Two operations of arithmetic in one instruction: most of what one takes is to load and to store. Their operands live longer than
  // the result of the first would.
  if (auto program = ProgramBuilder(graph, outputs, true).run()) return program;
  return ProgramBuilder(graph, outputs, false).run();
}

}  // namespace pillowmesh
