// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "buckens/fem/element/block.h"

namespace buckens::fem {

/// A sparse matrix of a mesh in whose place all of its entries are summed: it takes no more memory
/// than all entries that elements may add, while a list of what they add takes five times as much.
class EntrySums {
 public:
  /// Room for the variables of nodes that an element has in common.
  EntrySums(const std::vector<std::shared_ptr<const ElementBlock>>& blocks, const DofMap& dofs);

  /// Sums in the order of the calls. @pre an element has both variables
  void add(std::span<const linalg::Triplet> entries);
  /// The matrix, without entries that nothing was added to. Empties this object.
  linalg::SparseMatrix take();

 private:
  linalg::SparseMatrix sums_;
  std::vector<bool> has_entry_;
};

struct StiffnessMatrices {
  linalg::SparseMatrix K, K_damping;  ///< the latter without entries where undamped
};

/// Sums the stiffness of all elements, some thousand at a time.
StiffnessMatrices assemble_stiffness(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                                     const MeshView& mesh);

}  // namespace buckens::fem
