// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/fem/fe_model.h"

namespace buckens::fem {

/// Pairs of nodes to connect by lines in drawings of a body with matrices but no elements.
///
/// Nodes are neighbours if K couples them and no third node, coupled with both, is closer to each
/// than they are to one another (relative neighbourhood graph). That leaves the chain of a beam and
/// the edges of regular elements, without the diagonals.
std::vector<std::array<int, 2>> coupled_nodes(const FeModel& fe);

}  // namespace buckens::fem
