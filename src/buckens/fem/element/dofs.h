// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "buckens/fem/element/dof_map.h"

namespace buckens::fem {

/// The variables of an element, node by node: the first `kPerNode` (3 translations, or 6) of each.
template <std::size_t kPerNode, std::size_t kNodes>
std::array<int, kPerNode * kNodes> element_dofs(const DofMap& map,
                                                const std::array<int, kNodes>& nodes) {
  std::array<int, kPerNode * kNodes> out{};
  for (std::size_t end = 0; end < kNodes; ++end) {
    const auto& node = map.node_dofs[static_cast<std::size_t>(nodes[end])];
    for (std::size_t k = 0; k < kPerNode; ++k) out[kPerNode * end + k] = node[k];
  }
  return out;
}

/// The same for elements whose number of nodes is not known at compile time.
template <std::size_t kPerNode>
std::vector<int> element_dofs(const DofMap& map, std::span<const int> nodes) {
  std::vector<int> out;
  out.reserve(kPerNode * nodes.size());
  for (const int node : nodes) {
    const auto& dofs = map.node_dofs[static_cast<std::size_t>(node)];
    out.insert(out.end(), dofs.begin(), dofs.begin() + kPerNode);
  }
  return out;
}

}  // namespace buckens::fem
