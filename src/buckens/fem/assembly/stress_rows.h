// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "buckens/base/number_bytes.h"
#include "buckens/fem/element/block.h"
#include "buckens/linalg/sparse_rows.h"

namespace buckens::fem {

/// What makes stresses of nodal variables: six rows for each solid, then twelve for each shell, six
/// for either side. Where several processes share the work, each makes the rows that it will have,
/// of its elements, with the bits of one process.
/// @throws NumericalError if a process cannot, with its reason
linalg::SparseRows stress_rows(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                               const MeshView& mesh);

/// What a process gets for rows `first` to `end` − 1.
std::vector<std::byte> description_of_stress_rows(
    const std::vector<std::shared_ptr<const ElementBlock>>& blocks, const MeshView& mesh, int first,
    int end);

/// How it makes them, each a column. @param description as above, behind what it is one of
linalg::SparseMatrix made_stress_rows(base::BytesFrom description, int first, int end);

}  // namespace buckens::fem
