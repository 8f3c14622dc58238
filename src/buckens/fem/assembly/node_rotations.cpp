// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/node_rotations.h"

#include <array>

#include "buckens/fem/constraint/average_rows.h"

namespace buckens::fem {

namespace {

/// Followers not held by an element rotate with their reference; references rotate if their
/// followers have a lever arm or rotate themselves.
void give_rotations_to_links(const Structure& structure, const std::vector<bool>& held,
                             std::vector<bool>& turns) {
  const auto place = [&](int node) {
    return structure.nodes[static_cast<std::size_t>(node)].position;
  };
  for (const RigidLink& link : structure.links.rigid) {
    const auto& v = link.variables;
    for (const int node : link.nodes) {
      const auto n = static_cast<std::size_t>(node);
      if (!held[n] && (v[3] || v[4] || v[5])) turns[n] = true;
    }
  }
  for (bool found = true; found;) {
    found = false;
    for (const RigidLink& link : structure.links.rigid) {
      const auto reference = static_cast<std::size_t>(link.reference);
      const auto& v = link.variables;
      for (const int node : link.nodes) {
        const bool has_lever = (v[0] || v[1] || v[2]) && place(node) != place(link.reference);
        const bool follows = (v[3] || v[4] || v[5]) && turns[static_cast<std::size_t>(node)];
        if (turns[reference] || (!has_lever && !follows)) continue;
        turns[reference] = found = true;
      }
    }
  }
}

}  // namespace

std::vector<bool> nodes_with_rotations(const Structure& structure) {
  const std::size_t num_nodes = structure.nodes.size();
  std::vector<bool> turns(num_nodes, false), held(num_nodes, false);
  for (const AverageLink& link : structure.links.averages) {
    if (gives_rotation(structure.nodes, link)) {
      turns[static_cast<std::size_t>(link.reference)] = true;
    }
  }
  const std::array<const ElementBlock*, 4> blocks = {&structure.beams, &structure.bars,
                                                     &structure.solids, &structure.shells};
  for (const ElementBlock* block : blocks) {
    for (int e = 0; e < block->num_elements(); ++e) {
      for (const int node : block->nodes(e)) {
        held[static_cast<std::size_t>(node)] = true;
        if (block->has_rotations()) turns[static_cast<std::size_t>(node)] = true;
      }
    }
  }
  // A mass on a spring rotates if it has inertia.
  for (int m = 0; m < structure.masses.num_elements(); ++m) {
    const auto node = static_cast<std::size_t>(structure.masses.ends(m)[0]);
    if (!held[node] && !structure.masses.inertia(m).isZero(0.0)) turns[node] = true;
  }
  give_rotations_to_links(structure, held, turns);
  return turns;
}

}  // namespace buckens::fem
