// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

namespace buckens_petsc {

/// Elements of a mesh by the numbers of their nodes.
struct SomeElements {
  std::vector<long> starts;  ///< among `nodes`, from any number on, and the end
  std::vector<int> nodes;
};

/// Pairs of different nodes that elements join, each both ways, for the processes that have the
/// first of the two.
struct JoinedPairs {
  std::vector<std::pair<int, int>> pairs;  ///< ascending, none twice
  std::vector<int> counts;                 ///< of numbers for each process, two per pair

  /// @param first nodes of the processes, and the end
  void find(const SomeElements& elements, const std::vector<int>& first);
};

/// A run of nodes of a mesh: a share of the graph of those that elements join.
struct MeshShare {
  std::vector<int> weights;             ///< of the nodes here
  std::vector<int> starts, neighbours;  ///< of the nodes here, and the end

  /// @param pairs from all processes, as numbers: a node here, and another one
  /// @param first node here
  void join(const std::vector<int>& pairs, int first);
};

}  // namespace buckens_petsc
