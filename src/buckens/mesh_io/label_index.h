// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace buckens::mesh_io {

/// Finds the index of a node or element number of a file.
///
/// Numbers without large gaps are looked up in a list, others in a hash table, so that one huge
/// number costs no memory.
class LabelIndex {
 public:
  /// @param expected how many numbers will be added
  /// @param largest of them
  LabelIndex(std::size_t expected, std::int64_t largest) {
    if (largest >= 0 && static_cast<std::size_t>(largest) <= 4 * expected + 1000) {
      list_.assign(static_cast<std::size_t>(largest) + 1, -1);
    } else {
      table_.reserve(expected);
    }
  }
  LabelIndex() = default;

  /// @return the previous index of the number, −1: none; then it has the new one
  int add(std::int64_t label, int place) {
    int& slot = label >= 0 && static_cast<std::size_t>(label) < list_.size()
                    ? list_[static_cast<std::size_t>(label)]
                    : table_.try_emplace(label, -1).first->second;
    if (slot >= 0) return slot;
    slot = place;
    return -1;
  }

  /// −1 if the number does not exist.
  int find(std::int64_t label) const {
    if (label >= 0 && static_cast<std::size_t>(label) < list_.size()) {
      return list_[static_cast<std::size_t>(label)];
    }
    const auto found = table_.find(label);
    return found == table_.end() ? -1 : found->second;
  }

 private:
  std::vector<int> list_;
  std::unordered_map<std::int64_t, int> table_;
};

}  // namespace buckens::mesh_io
