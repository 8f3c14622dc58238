// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/element/shape_integrals.h"

namespace buckens::fem {

bool NodalMass::is_numbered_by_node() const {
  if (empty() || (Ms.is_here() && !Ms->isCompressed())) return false;
  for (std::size_t node = 0; node < dofs.size(); ++node) {
    const int first = 3 * static_cast<int>(node);
    if (dofs[node] != std::array<int, 3>{first, first + 1, first + 2}) return false;
  }
  return true;
}

}  // namespace buckens::fem
