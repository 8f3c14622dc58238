// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/fem/structure.h"

namespace buckens::model {

/// Spring of a mesh file between nodes of the structure.
struct NodeSpring {
  int node_a = 0, node_b = 0;
  fem::SpringBlock::Stiffness stiffness;
};

/// Adds springs. Programs that give every node six variables let springs turn nodes of solids, too;
/// there nothing resists the rotation, so it follows without moment, and the spring keeps what
/// stiffness is left then.
/// @param structure with all elements, masses and links
/// @return a note for each kind of stiffness that is lost in this way
std::vector<std::string> add_node_springs(const std::vector<NodeSpring>& springs,
                                          const std::string& file, fem::Structure& structure);

}  // namespace buckens::model
