// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/structure.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::fem {

int find_node(const Structure& structure, const std::string& name) {
  for (std::size_t k = 0; k < structure.nodes.size(); ++k) {
    if (structure.nodes[k].name == name) return static_cast<int>(k);
  }
  return -1;
}

const FaceSet* find_face_set(const Structure& structure, const std::string& name) {
  const auto found = std::find_if(structure.face_sets.begin(), structure.face_sets.end(),
                                  [&](const FaceSet& set) { return set.name == name; });
  return found == structure.face_sets.end() ? nullptr : &*found;
}

std::vector<int> face_set_nodes(const Structure& structure, const FaceSet& set) {
  std::vector<int> out = face_set_nodes(structure.solids, set.faces);
  for (const ShellSide& side : set.shells) {
    const auto own = structure.shells.nodes(side.element);
    out.insert(out.end(), own.begin(), own.end());
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

int add_node(Structure& structure, const std::string& name, const Eigen::Vector3d& position) {
  if (!name.empty() && find_node(structure, name) >= 0) {
    throw ModelError(fmt::format("node \"{}\" is given twice; rename one of them", name));
  }
  structure.nodes.push_back({name, position});
  return static_cast<int>(structure.nodes.size()) - 1;
}

namespace {

/// Nodes on the line between two nodes, both included; those between are made.
std::vector<int> divide_line(Structure& structure, const char* what, int node_a, int node_b,
                             int divisions) {
  const int num_nodes = static_cast<int>(structure.nodes.size());
  if (divisions < 1) {
    throw ModelError(fmt::format("{}: {} elements; give at least one", what, divisions));
  }
  if (node_a < 0 || node_b < 0 || node_a >= num_nodes || node_b >= num_nodes) {
    throw ModelError(fmt::format("{} between nodes {} and {}: there are only {} nodes", what,
                                 node_a, node_b, num_nodes));
  }
  const Eigen::Vector3d a = structure.nodes[static_cast<std::size_t>(node_a)].position;
  const Eigen::Vector3d b = structure.nodes[static_cast<std::size_t>(node_b)].position;
  std::vector<int> nodes = {node_a};
  for (int k = 1; k < divisions; ++k) {
    nodes.push_back(add_node(structure, "", a + static_cast<double>(k) / divisions * (b - a)));
  }
  nodes.push_back(node_b);
  return nodes;
}

}  // namespace

void add_bar(Structure& structure, int node_a, int node_b, int divisions, const Material& material,
             const Section& section) {
  const std::vector<int> nodes = divide_line(structure, "bar", node_a, node_b, divisions);
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    structure.bars.add(nodes[k], nodes[k + 1], material, section);
    if (k > 0) structure.straight_nodes.push_back(nodes[k]);
  }
}

BeamDivision add_beam(Structure& structure, int node_a, int node_b, int divisions,
                      const BeamProperties& properties) {
  BeamDivision division{structure.beams.num_elements(), divisions,
                        divide_line(structure, "beam", node_a, node_b, divisions)};
  const int number = structure.beams.add_properties(properties);
  for (std::size_t k = 0; k + 1 < division.nodes.size(); ++k) {
    const auto place = static_cast<double>(k);
    structure.beams.add(division.nodes[k], division.nodes[k + 1], number,
                        {place / divisions, (place + 1.0) / divisions, std::nullopt});
  }
  return division;
}

}  // namespace buckens::fem
