// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/divided_graph.h"

#include <array>
#include <mutex>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/ranks.h"

namespace buckens::linalg {

ColumnGraph column_graph(std::span<const DividedMatrix* const> terms) {
  std::vector<int> numbers;
  for (const DividedMatrix* term : terms) numbers.push_back(term->number());
  const int count = static_cast<int>(numbers.size());
  const Eigen::Index size = terms.front()->size();
  std::array<char, 400> error{};
  const auto require = [&](int failure) {
    if (failure == 0) return;
    throw NumericalError(
        fmt::format("the graph of {} equations on {} processes could not be found: {}; use more "
                    "memory, or fewer processes on a machine",
                    size, Ranks::count(), error.data()));
  };
  const auto error_size = static_cast<int>(error.size());
  const BuckensGridPlugin& plugin = grid_solver();
  const std::scoped_lock lock(turn_of_grid_solver());
  std::vector<std::uint64_t> marks;
  {
    std::vector<unsigned long long> found(static_cast<std::size_t>(size));
    require(plugin.marks(count, numbers.data(), found.data(), error.data(), error_size));
    marks.assign(found.begin(), found.end());
  }
  const std::vector<int> vertex = vertices_of(marks);
  marks = {};
  long num_edges = 0;
  const int* pairs = nullptr;
  require(plugin.edges(count, numbers.data(), vertex.data(), &num_edges, &pairs, error.data(),
                       error_size));
  ColumnGraph graph = graph_of(vertex, {pairs, static_cast<std::size_t>(2 * num_edges)});
  (void)plugin.edges(0, nullptr, nullptr, nullptr, nullptr, nullptr, 0);
  return graph;
}

}  // namespace buckens::linalg
