// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/base/number_bytes.h"
#include "buckens/fem/element/block.h"

namespace buckens::fem {

/// Elements of a mesh on their own, with their nodes and what their matrices depend on. Names,
/// numbers in messages and what is for drawing and stresses only are left out.
struct MeshPart {
  int size = 0;  ///< variables of the whole mesh
  std::vector<Node> nodes;
  DofMap dofs;                 ///< numbered within the part
  std::vector<int> variables;  ///< of the whole mesh, ascending, for each of those here
  std::vector<std::shared_ptr<const ElementBlock>> blocks;
};

/// Puts the elements that have a variable that is asked for. Elements and nodes stay in their
/// order.
/// @return all variables of these elements, ascending
/// @pre shells have directors
std::vector<int> put_part(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                          const MeshView& mesh, const std::vector<bool>& is_asked,
                          base::BytesTo& put);
/// Puts chosen elements of each block, ascending.
std::vector<int> put_part(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                          const MeshView& mesh, const std::vector<std::vector<int>>& elements,
                          base::BytesTo& put);
MeshPart taken_part(base::BytesFrom& take);

}  // namespace buckens::fem
