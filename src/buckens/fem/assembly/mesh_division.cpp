// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/mesh_division.h"

#include <algorithm>
#include <utility>

#include "buckens/linalg/mesh_partition.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_order.h"

namespace buckens::fem {

namespace {

/// Nodes of elements that have nodes of several parts.
int border_nodes(const linalg::JoinedNodes& mesh, const std::vector<int>& part) {
  std::vector<bool> is_border(part.size(), false);
  const auto part_of = [&](int node) { return part[static_cast<std::size_t>(node)]; };
  for (std::size_t e = 0; e + 1 < mesh.starts.size(); ++e) {
    const auto begin = mesh.nodes.begin() + mesh.starts[e];
    const auto end = mesh.nodes.begin() + mesh.starts[e + 1];
    if (std::all_of(begin, end, [&](int node) { return part_of(node) == part_of(*begin); })) {
      continue;
    }
    std::for_each(begin, end, [&](int node) { is_border[static_cast<std::size_t>(node)] = true; });
  }
  return static_cast<int>(std::count(is_border.begin(), is_border.end(), true));
}

}  // namespace

NodeParts divided_nodes(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                        const MeshView& mesh) {
  NodeParts out;
  if (linalg::Ranks::count() <= 2) return out;
  linalg::JoinedNodes joined;
  for (const auto& dofs : mesh.dofs.node_dofs) {
    joined.weights.push_back(static_cast<int>(
        std::count_if(dofs.begin(), dofs.end(), [](int dof) { return dof >= 0; })));
  }
  for (const auto& block : blocks) {
    for (int e = 0; e < block->num_elements(); ++e) {
      const auto nodes = block->nodes(e);
      joined.nodes.insert(joined.nodes.end(), nodes.begin(), nodes.end());
      joined.starts.push_back(static_cast<long>(joined.nodes.size()));
    }
  }
  out.count = linalg::Ranks::count() - 1;
  out.part = linalg::divide_among_processes(joined);
  out.num_border = border_nodes(joined, out.part);
  return out;
}

linalg::SharedRowOrder row_order(const DofMap& dofs, const NodeParts& parts) {
  if (parts.empty()) return nullptr;
  std::vector<int> of_variables(static_cast<std::size_t>(dofs.num_dofs));
  for (std::size_t node = 0; node < dofs.node_dofs.size(); ++node) {
    for (const int dof : dofs.node_dofs[node]) {
      if (dof >= 0) of_variables[static_cast<std::size_t>(dof)] = parts.part[node];
    }
  }
  auto order = std::make_shared<const linalg::RowOrder>(of_variables, parts.count);
  const std::vector<int>& first = order->first_rows();
  const bool has_empty_part = std::adjacent_find(first.begin(), first.end()) != first.end();
  return has_empty_part ? nullptr : std::move(order);
}

}  // namespace buckens::fem
