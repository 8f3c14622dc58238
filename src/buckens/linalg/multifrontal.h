// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/supernode_tree.h"

namespace buckens::linalg {

/// Columns begin … end of supernode s, finished: `corner` is the entry of row and column `begin`,
/// those of column c of the supernode lie (c − begin) · stride further on. Called once for every
/// run of at most kPanelColumns columns, from any thread, several at the same time.
using TakeColumns =
    std::function<void(int s, int begin, int end, const double* corner, std::ptrdiff_t stride)>;

/// L with L Lᵀ = P A Pᵀ, handed over as it is finished, so that only what is still needed takes
/// memory besides.
///
/// Multifrontal (Duff and Reid 1983; Liu 1992): every supernode adds up what its children subtract
/// from its rows, eliminates its columns by dense products (OpenBLAS) and leaves the rest to its
/// parent. Large ones near the roots leave no rests (top_fronts.h). One thread goes through the
/// tree in postorder. Several take whole subtrees and single small fronts above them; all share the
/// others, tile by tile. Sums and products are the same with any number of threads.
/// @param A its terms are formed; it is read column by column, and need not exist as a whole
/// @return bytes that finished columns and fronts took at most at the same time
/// @throws IndefiniteMatrix if A is not positive definite
/// @throws std::bad_alloc
double factorise_fronts(const MatrixSum& A, const SupernodeTree& tree, const TakeColumns& take,
                        TaskPool* pool);

}  // namespace buckens::linalg
