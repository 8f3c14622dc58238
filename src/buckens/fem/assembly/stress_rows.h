// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "buckens/base/number_bytes.h"
#include "buckens/fem/element/block.h"
#include "buckens/fem/element/node_parts.h"
#include "buckens/linalg/shared_row_order.h"
#include "buckens/linalg/sparse_rows.h"

namespace buckens::fem {

/// What makes stresses of nodal variables: six rows for each solid, then twelve for each shell, six
/// for either side. Where several processes share the work, each makes the rows that it will have,
/// of its elements, with the bits of one process.
/// @param parts of the nodes: an element is with its first one
/// @throws NumericalError if a process cannot, with its reason
linalg::SparseRows stress_rows(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                               const MeshView& mesh, const NodeParts& parts);

/// The rows of some elements only, numbered through solids, then shells, made here.
/// @param elements ascending
linalg::SparseRows::RowMajor stress_rows_of(
    const std::vector<std::shared_ptr<const ElementBlock>>& blocks, const MeshView& mesh,
    const std::vector<int>& elements);

/// The order in which processes have these rows; null: each has a run of them.
linalg::SharedRowOrder stress_row_order(
    const std::vector<std::shared_ptr<const ElementBlock>>& blocks, const NodeParts& parts);

/// What a process gets for rows `first` to `end` − 1.
/// @param order of the rows, of a process those of whole elements; null: as they are
std::vector<std::byte> description_of_stress_rows(
    const std::vector<std::shared_ptr<const ElementBlock>>& blocks, const MeshView& mesh,
    const linalg::SharedRowOrder& order, int first, int end);

/// How it makes them, each a column. @param description as above, behind what it is one of
linalg::SparseMatrix made_stress_rows(base::BytesFrom description, int first, int end);

}  // namespace buckens::fem
