// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/row_rank.h"

namespace buckens::linalg {

/// The functions of sparse_qr.h by SPQR, which is under the GPL: absent where BUCKENS_GPL is off.
RowRank split_columns_by_spqr(const SparseMatrix& A, double limit);
Vector least_norm_by_spqr(const SparseMatrix& A, const Vector& b, double limit);

}  // namespace buckens::linalg
