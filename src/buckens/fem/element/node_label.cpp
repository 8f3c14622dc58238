// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/element/node_label.h"

#include <fmt/format.h>

namespace buckens::fem {

std::string node_label(const std::vector<Node>& nodes, int node) {
  const Node& n = nodes.at(static_cast<std::size_t>(node));
  if (!n.name.empty()) return fmt::format("node \"{}\"", n.name);
  return fmt::format("node {} at ({:g}, {:g}, {:g}) m", node, n.position.x(), n.position.y(),
                     n.position.z());
}

}  // namespace buckens::fem
