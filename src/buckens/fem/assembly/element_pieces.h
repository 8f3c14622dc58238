// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "buckens/fem/element/block.h"

namespace buckens::fem {

/// Calls visit(piece, first) for pieces of a block of solids or shells with some thousand elements,
/// `first` being the number of the first one in the block; for other blocks once. What elements add
/// to a matrix is listed piece by piece, so that the list stays small beside the matrix.
void visit_pieces(const ElementBlock& block, const std::vector<Node>& nodes,
                  const std::function<void(const ElementBlock& piece, int first)>& visit);

/// Some elements of a block of solids or shells, in their order, with the numbers of all nodes.
std::shared_ptr<const ElementBlock> some_elements(const ElementBlock& block,
                                                  const std::vector<Node>& nodes,
                                                  const std::vector<int>& elements);

}  // namespace buckens::fem
