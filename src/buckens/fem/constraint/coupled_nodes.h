// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/fem/fe_model.h"

namespace buckens::fem {

/// Pairs of nodes between which lines may be drawn, for a body that has matrices but no elements.
///
/// Nodes are near each other if K couples them and no third node, coupled with both, lies nearer to
/// either than they do to one another (relative neighbours). That leaves the chain of a beam and
/// the edges of regular elements, without the diagonals.
std::vector<std::array<int, 2>> coupled_nodes(const FeModel& fe);

}  // namespace buckens::fem
