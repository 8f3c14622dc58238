// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/linalg/front.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/supernode_tree.h"

namespace buckens::linalg {

/// What the fronts of a matrix begin with: its entries.
class FrontEntries {
 public:
  /// @param A,tree must outlive this object
  FrontEntries(const MatrixSum& A, const SupernodeTree& tree);

  /// Adds those of the columns of supernode s to its front. Of several threads at once.
  /// @param local row of the front of s for each column of L, of which those that s has are set
  void add(int s, const Front& front, std::vector<int>& local) const;

 private:
  const MatrixSum& A_;
  const SupernodeTree& tree_;
  std::vector<int> place_;  // column of L of each row of A
};

}  // namespace buckens::linalg
