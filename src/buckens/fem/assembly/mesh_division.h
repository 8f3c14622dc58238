// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/element/node_parts.h"
#include "buckens/linalg/shared_row_order.h"

namespace buckens::fem {

/// Divides the nodes of a mesh among the processes other than the first, so that neighbours are
/// together wherever that is possible: numbers of nodes say nothing about places. Elements join
/// nodes, links do not. Empty where there is only one such process.
/// @pre linalg::is_shared_work()
/// @throws NumericalError if memory is too small
NodeParts divided_nodes(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                        const MeshView& mesh);

/// The order of rows in which each process has the variables of its nodes; null if nodes are not
/// divided, or a part has no variables, since all of them follow others.
/// @pre all variables are of nodes
linalg::SharedRowOrder row_order(const DofMap& dofs, const NodeParts& parts);

}  // namespace buckens::fem
