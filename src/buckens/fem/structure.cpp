// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/structure.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::fem {

int find_node(const Structure& structure, const std::string& name) {
  for (std::size_t k = 0; k < structure.nodes.size(); ++k) {
    if (structure.nodes[k].name == name) return static_cast<int>(k);
  }
  return -1;
}

int add_node(Structure& structure, const std::string& name, const Eigen::Vector3d& position) {
  if (!name.empty() && find_node(structure, name) >= 0) {
    throw ModelError(fmt::format("node \"{}\" is given twice; rename one of them", name));
  }
  structure.nodes.push_back({name, position});
  return static_cast<int>(structure.nodes.size()) - 1;
}

BeamDivision add_beam(Structure& structure, int node_a, int node_b, int divisions,
                      const BeamProperties& properties) {
  const int num_nodes = static_cast<int>(structure.nodes.size());
  if (divisions < 1) {
    throw ModelError(fmt::format("beam: {} elements; give at least one", divisions));
  }
  if (node_a < 0 || node_b < 0 || node_a >= num_nodes || node_b >= num_nodes) {
    throw ModelError(fmt::format("beam between nodes {} and {}: there are only {} nodes", node_a,
                                 node_b, num_nodes));
  }
  const Eigen::Vector3d a = structure.nodes[static_cast<std::size_t>(node_a)].position;
  const Eigen::Vector3d b = structure.nodes[static_cast<std::size_t>(node_b)].position;
  BeamDivision division{structure.beams.num_elements(), divisions, {node_a}};
  for (int k = 1; k < divisions; ++k) {
    division.nodes.push_back(
        add_node(structure, "", a + static_cast<double>(k) / divisions * (b - a)));
  }
  division.nodes.push_back(node_b);
  const int number = structure.beams.add_properties(properties);
  for (std::size_t k = 0; k + 1 < division.nodes.size(); ++k) {
    structure.beams.add(division.nodes[k], division.nodes[k + 1], number);
  }
  return division;
}

}  // namespace buckens::fem
