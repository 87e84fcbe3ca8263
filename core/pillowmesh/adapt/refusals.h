// Changes of topology that were refused, remembered: hot passes come to the same ones again and again.
#pragma once

#include <cstdint>
#include <vector>

#include "pillowmesh/adapt/trial.h"

namespace pillowmesh {

/// By how much refused changes would have raised the energy. A change is known by the cells that it would make, not by
/// those that it would replace: where there are other cells to replace meanwhile, or weights of the energy have changed,
/// what is remembered is an estimate only. In a table of fixed size one change takes the place of another, which is then
/// merely tried once more.
class Refusals {
 public:
  using Key = std::uint64_t;
  /// Of what `cavity` plans. Cost: its cells.
  static Key key(Operator op, const Cavity& cavity);

  /// Room for a change of each of so many cells. Forgets what was there when that takes much more than there is.
  void make_room(CellId cells);
  /// Forgets everything, and holds no memory.
  void release() { std::vector<Entry>().swap(entries_); }
  /// Whether the change, as it went last, would raise the energy by more than is allowed.
  [[nodiscard]] bool expected(Key key, double allowed) const;
  /// \param growth of the energy, at least; may be infinite. Without room nothing is remembered.
  void remember(Key key, double growth);
  /// That there is room for.
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::uint32_t tag = 0;
    float growth = 0.0f;
  };
  [[nodiscard]] std::size_t place(Key key) const { return ((key & 0xffffffff) * entries_.size()) >> 32; }
  static std::uint32_t tag(Key key) { return static_cast<std::uint32_t>(key >> 32) | 1; }  // 0: nothing is there

  std::vector<Entry> entries_;
};

}  // namespace pillowmesh
