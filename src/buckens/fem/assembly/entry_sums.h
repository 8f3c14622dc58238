// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/fem/element/block.h"

namespace buckens::fem {

/// A sparse matrix of a mesh in whose place all of its entries are summed: it takes no more memory
/// than all entries that elements may add, while a list of what they add takes five times as much.
class EntrySums {
 public:
  /// Room for the variables of nodes that an element has in common.
  /// @param pool null: the calling thread alone. No bit depends on it
  EntrySums(const std::vector<std::shared_ptr<const ElementBlock>>& blocks, const DofMap& dofs,
            TaskPool* pool = nullptr);

  /// Sums in the order of the calls and of the lists, whatever the number of threads.
  /// @pre an element has both variables of an entry
  void add(const std::vector<std::span<const linalg::Triplet>>& lists, TaskPool* pool = nullptr);
  /// The matrix, without entries that nothing was added to. Empties this object.
  linalg::SparseMatrix take();

 private:
  /// Those of the columns for which is_own(column).
  template <class IsOwn>
  void add_columns(std::span<const linalg::Triplet> entries, IsOwn&& is_own);

  linalg::SparseMatrix sums_;
  std::vector<char> has_entry_;  // bytes: threads write to neighbours at the same time
};

}  // namespace buckens::fem
