// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/fem/element/dof_map.h"

namespace buckens::fem {

/// How messages name a node: by its name, or by number and position.
std::string node_label(const std::vector<Node>& nodes, int node);

}  // namespace buckens::fem
