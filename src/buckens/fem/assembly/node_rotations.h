// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/structure.h"

namespace buckens::fem {

/// Which nodes have rotations as variables: those of beams and shells, point masses with inertia
/// that no other element holds, and what links make turn with them. Nodes that only bars and solids
/// use have none.
std::vector<bool> nodes_with_rotations(const Structure& structure);

}  // namespace buckens::fem
