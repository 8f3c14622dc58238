// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/fem/element/block.h"

namespace buckens::fem {

struct StiffnessMatrices {
  linalg::SparseMatrix K, K_damping;  ///< the latter without entries where undamped
};

/// Sums the stiffness of all elements, a hundred or so per thread at a time.
StiffnessMatrices assemble_stiffness(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                                     const MeshView& mesh);

}  // namespace buckens::fem
