// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace buckens::linalg {

/// One vertex's turn when a symmetric matrix is eliminated.
struct EliminationStep {
  int vertex;
  std::vector<int> coupled;  ///< with it and still there, ascending; coupled with each other now
};

/// Eliminates the vertices of a graph one after the other, each time one with the fewest neighbours
/// left, the first of them: along a chain in its own order.
///
/// Time and memory follow the neighbours of all steps together, that is the entries of the factor,
/// also where all are coupled with all.
/// @param couples pairs of vertices; any order, repetitions allowed
std::vector<EliminationStep> eliminate_by_least_degree(
    std::size_t count, const std::vector<std::pair<int, int>>& couples);

}  // namespace buckens::linalg
