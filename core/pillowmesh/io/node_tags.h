// Gmsh's node numbers, any positive ones, and the indices that they stand for.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "pillowmesh/mesh/ids.h"

namespace pillowmesh {

/// From Gmsh's node tags, any positive numbers, to indices.
class NodeTags {
 public:
  void add(std::int64_t tag) {
    in_order_ = in_order_ && tag == static_cast<std::int64_t>(tags_.size()) + 1;
    tags_.push_back(tag);
  }
  [[nodiscard]] std::size_t size() const { return tags_.size(); }
  void reserve(std::size_t n) { tags_.reserve(n); }
  /// \return a tag that is not positive or given twice; 0 if there is none.
  std::int64_t finish() {
    if (in_order_) return 0;
    sorted_.reserve(tags_.size());
    for (std::size_t i = 0; i < tags_.size(); ++i) sorted_.emplace_back(tags_[i], static_cast<Index>(i));
    if (!std::is_sorted(sorted_.begin(), sorted_.end())) std::sort(sorted_.begin(), sorted_.end());
    for (std::size_t i = 0; i < sorted_.size(); ++i)
      if (sorted_[i].first <= 0 || (i > 0 && sorted_[i].first == sorted_[i - 1].first))
        return sorted_[i].first <= 0 ? -1 : sorted_[i].first;
    // Nearly dense tags, the usual case: a table. Never longer than a multiple of the file.
    const std::int64_t highest = sorted_.empty() ? 0 : sorted_.back().first;
    if (highest > 4 * static_cast<std::int64_t>(tags_.size()) + 1000) return 0;
    table_.assign(static_cast<std::size_t>(highest) + 1, kNone);
    for (const auto& [tag, index] : sorted_) table_[static_cast<std::size_t>(tag)] = index;
    return 0;
  }
  /// kNone when there is no such node.
  [[nodiscard]] Index index_of(std::int64_t tag) const {
    if (in_order_)
      return tag >= 1 && tag <= static_cast<std::int64_t>(tags_.size()) ? static_cast<Index>(tag - 1) : kNone;
    if (!table_.empty())
      return tag >= 0 && tag < static_cast<std::int64_t>(table_.size()) ? table_[static_cast<std::size_t>(tag)] : kNone;
    const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<std::int64_t, Index>(tag, kNone));
    return at != sorted_.end() && at->first == tag ? at->second : kNone;
  }

 private:
  std::vector<std::int64_t> tags_;
  bool in_order_ = true;
  std::vector<std::pair<std::int64_t, Index>> sorted_;
  std::vector<Index> table_;
};

}  // namespace pillowmesh
