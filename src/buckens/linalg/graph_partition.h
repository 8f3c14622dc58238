// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

namespace buckens::linalg {

/// An undirected graph with weights; `edges` holds each pair at least once, repetitions add up.
struct Graph {
  std::vector<double> vertex_weights;  ///< one per vertex, not negative
  std::vector<std::pair<int, int>> edges;
};

/// Divides a connected graph into `count` connected parts of about equal weight with few edges
/// between them (METIS, multilevel k-way).
/// @param count 1 … number of vertices
/// @return part of each vertex; parts are numbered by their first vertex, none is empty
/// @throws ModelError if count is out of range or the graph is in pieces
std::vector<int> divide_graph(const Graph& graph, int count);

}  // namespace buckens::linalg
