// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace buckens::mesh_io {

/// Finds the index of a number among many: sorted once, binary search.
class NastranIds {
 public:
  NastranIds() = default;
  /// @param ids the index of each is its position; of equal ones the first counts
  explicit NastranIds(const std::vector<std::int64_t>& ids) {
    sorted_.reserve(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) sorted_.push_back({ids[i], static_cast<int>(i)});
    if (!std::is_sorted(sorted_.begin(), sorted_.end())) {
      std::sort(sorted_.begin(), sorted_.end());
    }
  }

  /// −1 if the number does not exist.
  int find(std::int64_t id) const {
    const auto entry = first_from(id);
    return entry == sorted_.end() || entry->first != id ? -1 : entry->second;
  }

  /// Calls `visit(id, index)` for the numbers from `first` to `last` in ascending order.
  template <class Visitor>
  void visit_range(std::int64_t first, std::int64_t last, Visitor&& visit) const {
    for (auto entry = first_from(first); entry != sorted_.end() && entry->first <= last; ++entry) {
      visit(entry->first, entry->second);
    }
  }

  /// Pairs of number and index in ascending order.
  const std::vector<std::pair<std::int64_t, int>>& sorted() const { return sorted_; }

 private:
  std::vector<std::pair<std::int64_t, int>>::const_iterator first_from(std::int64_t id) const {
    return std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<std::int64_t, int>{id, -1});
  }

  std::vector<std::pair<std::int64_t, int>> sorted_;
};

}  // namespace buckens::mesh_io
