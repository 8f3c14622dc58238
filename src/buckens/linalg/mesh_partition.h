// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace buckens::linalg {

/// Nodes of a mesh, and which of them elements join.
struct JoinedNodes {
  std::vector<int> weights;        ///< of the nodes
  std::vector<long> starts = {0};  ///< of the elements among `nodes`, and the end
  std::vector<int> nodes;
};

/// Divides the nodes among the processes other than the first, with parts of about equal weight and
/// few elements between them. They do it together (PT-Scotch), always in the same way.
/// @return part of each node, 0 … number of these processes − 1
/// @pre Ranks::count() > 2
/// @throws NumericalError if memory is too small
std::vector<int> divide_among_processes(const JoinedNodes& mesh);

}  // namespace buckens::linalg
