// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/graph_partition.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"

namespace buckens::linalg {
namespace {

Graph grid(int width, int height) {
  Graph graph;
  graph.vertex_weights.assign(static_cast<std::size_t>(width * height), 1.0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int v = y * width + x;
      if (x + 1 < width) graph.edges.emplace_back(v, v + 1);
      if (y + 1 < height) graph.edges.emplace_back(v, v + width);
    }
  }
  return graph;
}

/// Number of connected pieces of one part, by repeated merging.
int pieces_of(const Graph& graph, const std::vector<int>& part_of, int part) {
  std::vector<std::size_t> root(part_of.size());
  for (std::size_t v = 0; v < root.size(); ++v) root[v] = v;
  for (std::size_t round = 0; round < root.size(); ++round) {
    for (const auto& [a, b] : graph.edges) {
      const auto i = static_cast<std::size_t>(a);
      const auto j = static_cast<std::size_t>(b);
      if (part_of[i] != part || part_of[j] != part) continue;
      root[i] = root[j] = std::min(root[i], root[j]);
    }
  }
  std::set<std::size_t> roots;
  for (std::size_t v = 0; v < root.size(); ++v) {
    if (part_of[v] == part) roots.insert(root[v]);
  }
  return static_cast<int>(roots.size());
}

TEST(GraphPartition, PartsAreConnectedAndEven) {
  const Graph graph = grid(12, 10);
  for (const int count : {2, 3, 7, 24, 60, 119}) {
    const std::vector<int> part_of = divide_graph(graph, count);
    for (int part = 0; part < count; ++part) {
      EXPECT_EQ(pieces_of(graph, part_of, part), 1) << part << " of " << count;
      // METIS keeps parts within a few per cent; small parts are whole vertices.
      const auto size = std::count(part_of.begin(), part_of.end(), part);
      EXPECT_LE(static_cast<double>(size), 1.3 * 120.0 / count + 1.0) << count;
    }
  }
}

TEST(GraphPartition, OnePartAndOnePerVertex) {
  const Graph graph = grid(3, 2);
  EXPECT_EQ(divide_graph(graph, 1), std::vector<int>(6, 0));
  EXPECT_EQ(divide_graph(graph, 6), (std::vector<int>{0, 1, 2, 3, 4, 5}));
}

TEST(GraphPartition, IsTheSameEveryTime) {
  const Graph graph = grid(20, 20);
  EXPECT_EQ(divide_graph(graph, 9), divide_graph(graph, 9));
}

TEST(GraphPartition, HeavyVerticesGetPartsOfTheirOwn) {
  Graph path = grid(10, 1);
  path.vertex_weights[0] = 9.0;  // as heavy as all the others together
  const std::vector<int> part_of = divide_graph(path, 2);
  EXPECT_EQ(std::count(part_of.begin(), part_of.end(), part_of[0]), 1);
}

TEST(GraphPartition, RefusesWhatCannotBe) {
  const Graph graph = grid(2, 2);
  EXPECT_THROW(divide_graph(graph, 0), ModelError);
  EXPECT_THROW(divide_graph(graph, 5), ModelError);
  Graph apart;
  apart.vertex_weights.assign(4, 1.0);
  apart.edges = {{0, 1}, {2, 3}};
  EXPECT_THROW(divide_graph(apart, 2), ModelError);
}

}  // namespace
}  // namespace buckens::linalg
