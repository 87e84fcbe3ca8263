// A formula's graph compiled for evaluation over batches of points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/graph.h"

namespace pillowmesh {

/// Points evaluated at once: enough to hide the cost of interpretation, few enough to stay in the first-level cache.
inline constexpr int kLanes = 64;

/// One coordinate or one result of a batch.
using Lanes = std::array<double, kLanes>;

/// Straight-line code over registers of kLanes numbers. Both sides of an `if` are code; a side that no point of the
/// batch needs is jumped over when it is worth a jump. An instruction is one operation, or two of arithmetic. Immutable,
/// safe to run from several threads.
class Program {
 public:
  /// Code for the values `outputs` of `graph`, and for nothing else.
  /// \return usage when more values than registers are alive at once.
  static Expected<Program> compile(const Graph& graph, std::span<const NodeId> outputs);

  /// Evaluates lanes 0 .. count - 1. `coordinates` holds one Lanes per axis used. Does not allocate; uses at most 70 kB
  /// of stack. \pre 1 <= count <= kLanes, results.size() == outputs. What stands in further lanes is unspecified.
  void run(const Lanes* coordinates, int count, std::span<Lanes> results) const;

  struct Instruction {
    Op op = Op::constant;
    Op then = Op::constant;  ///< what is done with a op b and c; constant: nothing
    bool second = false;     ///< a op b is the second operand of that
    /// Registers; ~i names constant i. `c` of a skip is the number of instructions that it jumps over.
    std::int16_t out = 0, a = 0, b = 0, c = 0;
  };
  [[nodiscard]] std::span<const Instruction> code() const { return code_; }

 private:
  friend class ProgramBuilder;
  void run_widest(const Lanes* coordinates, int count, std::span<Lanes> results) const;
  void run_wide(const Lanes* coordinates, int count, std::span<Lanes> results) const;
  void run_code(const Lanes* coordinates, int count, std::span<Lanes> results) const;
  static constexpr int kMaxRegisters = 128;

  std::vector<Instruction> code_;
  std::vector<Lanes> constants_;
  std::vector<std::int16_t> outputs_;
  int axes_ = 0;  // registers 0 .. axes_ - 1 hold the coordinates
  int registers_ = 0;
};

}  // namespace pillowmesh
