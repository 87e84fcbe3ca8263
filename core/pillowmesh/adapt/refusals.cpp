#include "pillowmesh/adapt/refusals.h"

namespace pillowmesh {
namespace {

/// Twice as many would find one refusal in forty more (shock2d, best).
constexpr std::size_t kEntriesPerCell = 2;
/// Of the growth that was seen, so much is held against the same change again: what is around may have moved meanwhile.
constexpr double kSure = 0.8;

}  // namespace

Refusals::Key Refusals::key(Operator op, const Cavity& cavity) {
  Key hash = static_cast<Key>(op);
  for (const Corners<2>& cell : cavity.new_cells)
    for (const VertexId v : cell) {
      hash = (hash ^ static_cast<std::uint32_t>(v)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
  return hash;
}

void Refusals::make_room(CellId cells) {
  const std::size_t n = kEntriesPerCell * static_cast<std::size_t>(cells);
  if (n <= entries_.size() + entries_.size() / 8) return;
  release();
  entries_.resize(n);
}

bool Refusals::expected(Key key, double allowed) const {
  if (entries_.empty()) return false;
  const Entry& e = entries_[place(key)];
  if (e.tag != tag(key)) return false;
  const double growth = e.growth;
  return (growth > 0.0 ? kSure : 2.0 - kSure) * growth > allowed;
}

void Refusals::remember(Key key, double growth) {
  if (!entries_.empty()) entries_[place(key)] = {tag(key), static_cast<float>(growth)};
}

}  // namespace pillowmesh
