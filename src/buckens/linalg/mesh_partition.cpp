// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/mesh_partition.h"

#include <array>
#include <mutex>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/ranks.h"

namespace buckens::linalg {

std::vector<int> divide_among_processes(const JoinedNodes& mesh) {
  const BuckensGridMesh nodes{static_cast<int>(mesh.weights.size()), mesh.weights.data(),
                              static_cast<long>(mesh.starts.size()) - 1, mesh.starts.data(),
                              mesh.nodes.data()};
  std::vector<int> part(mesh.weights.size());
  std::array<char, 400> error{};
  const std::scoped_lock lock(turn_of_grid_solver());
  if (grid_solver().partition(&nodes, part.data(), error.data(), static_cast<int>(error.size())) !=
      0) {
    throw NumericalError(
        fmt::format("a mesh of {} nodes could not be divided among {} processes: {}; use more "
                    "memory, or fewer processes on a machine",
                    part.size(), Ranks::count() - 1, error.data()));
  }
  return part;
}

}  // namespace buckens::linalg
