// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace buckens::linalg {

/// Elimination of one vertex of a symmetric matrix.
struct EliminationStep {
  int vertex;
  std::vector<int> coupled;  ///< its remaining neighbours, ascending; now coupled with each other
};

/// Eliminates the vertices of a graph one by one, each time the first one with the fewest remaining
/// neighbours: a chain is eliminated in its own order.
///
/// Time and memory are proportional to the total number of neighbours in all steps, that is the
/// entries of the factor, even for a complete graph.
/// @param couples pairs of vertices; any order, repetitions allowed
std::vector<EliminationStep> eliminate_by_least_degree(
    std::size_t count, const std::vector<std::pair<int, int>>& couples);

}  // namespace buckens::linalg
