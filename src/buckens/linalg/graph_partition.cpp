// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/graph_partition.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <metis.h>

#include "buckens/base/errors.h"

namespace buckens::linalg {

namespace {

// METIS takes integer weights; this many units for the heaviest vertex are fine enough.
constexpr double kWeightUnits = 1000.0;

/// Neighbours of all vertices in one list, with the number of edges to each.
struct Adjacency {
  std::vector<idx_t> first, neighbours, weights;

  explicit Adjacency(const Graph& graph) {
    const std::size_t count = graph.vertex_weights.size();
    std::vector<std::vector<int>> lists(count);
    for (const auto& [a, b] : graph.edges) {
      if (a == b) continue;
      lists[static_cast<std::size_t>(a)].push_back(b);
      lists[static_cast<std::size_t>(b)].push_back(a);
    }
    first.push_back(0);
    for (auto& list : lists) {
      std::sort(list.begin(), list.end());
      for (std::size_t k = 0; k < list.size(); ++k) {
        if (k > 0 && list[k] == list[k - 1]) {
          ++weights.back();
          continue;
        }
        neighbours.push_back(list[k]);
        weights.push_back(1);
      }
      first.push_back(static_cast<idx_t>(neighbours.size()));
    }
  }

  template <class Visit>
  void for_each_neighbour(std::size_t vertex, Visit&& visit) const {
    for (idx_t k = first[vertex]; k < first[vertex + 1]; ++k) {
      visit(static_cast<std::size_t>(neighbours[static_cast<std::size_t>(k)]));
    }
  }
};

/// Connected pieces of the parts: piece of each vertex and number of vertices per piece.
struct Pieces {
  std::vector<int> piece;
  std::vector<int> size;
  std::vector<int> part;  // that each piece belongs to

  Pieces(const Adjacency& graph, const std::vector<int>& part_of) : piece(part_of.size(), -1) {
    std::vector<std::size_t> open;
    for (std::size_t start = 0; start < part_of.size(); ++start) {
      if (piece[start] >= 0) continue;
      const int number = static_cast<int>(size.size());
      size.push_back(0);
      part.push_back(part_of[start]);
      piece[start] = number;
      open.push_back(start);
      while (!open.empty()) {
        const std::size_t vertex = open.back();
        open.pop_back();
        ++size.back();
        graph.for_each_neighbour(vertex, [&](std::size_t near) {
          if (piece[near] >= 0 || part_of[near] != part_of[start]) return;
          piece[near] = number;
          open.push_back(near);
        });
      }
    }
  }
};

/// Gives pieces that lie apart from the largest piece of their part to a neighbouring part.
void join_stray_pieces(const Adjacency& graph, std::vector<int>& part_of) {
  for (bool again = true; again;) {
    again = false;
    const Pieces pieces(graph, part_of);
    std::vector<int> largest;
    for (std::size_t p = 0; p < pieces.size.size(); ++p) {
      const auto part = static_cast<std::size_t>(pieces.part[p]);
      if (largest.size() <= part) largest.resize(part + 1, -1);
      int& best = largest[part];
      if (best < 0 || pieces.size[p] > pieces.size[static_cast<std::size_t>(best)]) {
        best = static_cast<int>(p);
      }
    }
    for (std::size_t v = 0; v < part_of.size(); ++v) {
      if (largest[static_cast<std::size_t>(part_of[v])] == pieces.piece[v]) continue;
      graph.for_each_neighbour(v, [&](std::size_t near) {
        if (pieces.piece[near] == pieces.piece[v]) return;
        part_of[v] = part_of[near];
        again = true;
      });
    }
  }
}

/// Splits the largest parts until there are `count`: vertices in the order of a walk from one end.
void split_until(const Adjacency& graph, int count, std::vector<int>& part_of) {
  std::vector<std::vector<std::size_t>> parts;
  for (std::size_t v = 0; v < part_of.size(); ++v) {
    const auto part = static_cast<std::size_t>(part_of[v]);
    if (parts.size() <= part) parts.resize(part + 1);
    parts[part].push_back(v);
  }
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  const auto smaller = [](const auto& a, const auto& b) { return a.size() < b.size(); };
  while (static_cast<int>(parts.size()) < count) {
    const auto large = std::max_element(parts.begin(), parts.end(), smaller);
    // One vertex whose removal leaves the rest connected: the last one reached by a walk.
    std::vector<bool> reached(part_of.size(), true);
    for (const std::size_t v : *large) reached[v] = false;
    std::vector<std::size_t> walk = {large->front()};
    reached[walk[0]] = true;
    for (std::size_t k = 0; k < walk.size(); ++k) {
      graph.for_each_neighbour(walk[k], [&](std::size_t near) {
        if (reached[near]) return;
        reached[near] = true;
        walk.push_back(near);
      });
    }
    parts.push_back({walk.back()});
    const auto source = std::max_element(parts.begin(), parts.end() - 1, smaller);
    std::erase(*source, walk.back());
  }
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (const std::size_t v : parts[p]) part_of[v] = static_cast<int>(p);
  }
}

/// Numbers parts in the order of their first vertices.
void renumber(std::vector<int>& part_of) {
  std::vector<int> number;
  int next = 0;
  for (int& part : part_of) {
    const auto old = static_cast<std::size_t>(part);
    if (number.size() <= old) number.resize(old + 1, -1);
    if (number[old] < 0) number[old] = next++;
    part = number[old];
  }
}

std::vector<int> metis_parts(const Graph& graph, Adjacency& adjacency, int count) {
  const double heaviest =
      *std::max_element(graph.vertex_weights.begin(), graph.vertex_weights.end());
  std::vector<idx_t> weights;
  for (const double weight : graph.vertex_weights) {
    const double units = heaviest > 0.0 ? kWeightUnits * weight / heaviest : 1.0;
    weights.push_back(std::max<idx_t>(1, static_cast<idx_t>(std::lround(units))));
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_CONTIG] = 1;
  options[METIS_OPTION_SEED] = 1;  // the same parts every time
  auto vertices = static_cast<idx_t>(weights.size());
  idx_t constraints = 1;
  idx_t parts = count;
  idx_t cut = 0;
  std::vector<idx_t> part_of(weights.size(), 0);
  const int status = METIS_PartGraphKway(
      &vertices, &constraints, adjacency.first.data(), adjacency.neighbours.data(), weights.data(),
      nullptr, adjacency.weights.data(), &parts, nullptr, nullptr, options, &cut, part_of.data());
  // Without METIS's answer the repair below still finds connected parts, less even ones.
  if (status != METIS_OK) std::fill(part_of.begin(), part_of.end(), 0);
  return {part_of.begin(), part_of.end()};
}

}  // namespace

std::vector<int> divide_graph(const Graph& graph, int count) {
  const auto vertices = static_cast<int>(graph.vertex_weights.size());
  if (count < 1 || count > vertices) {
    throw ModelError(fmt::format("{} elements cannot be divided into {} parts", vertices, count));
  }
  std::vector<int> part_of(graph.vertex_weights.size(), 0);
  if (count == vertices) {
    std::iota(part_of.begin(), part_of.end(), 0);
    return part_of;
  }
  if (count == 1) return part_of;
  Adjacency adjacency(graph);
  if (Pieces(adjacency, part_of).size.size() > 1) {
    throw ModelError("a mesh in several pieces cannot be divided");
  }
  part_of = metis_parts(graph, adjacency, count);
  join_stray_pieces(adjacency, part_of);
  split_until(adjacency, count, part_of);
  renumber(part_of);
  return part_of;
}

}  // namespace buckens::linalg
