// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace buckens::fem {

/// Which of the processes that share a body has each of its nodes (linalg::RowOrder).
struct NodeParts {
  int count = 0;          ///< 0: nodes are not divided, and processes have runs of variables
  std::vector<int> part;  ///< of each node, 0 … count − 1
  int num_border = 0;     ///< nodes of elements that have nodes of several parts

  bool empty() const { return count == 0; }
};

}  // namespace buckens::fem
