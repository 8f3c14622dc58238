// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// Which rows of a matrix are independent, and which follow from them.
struct RowRank {
  std::vector<int> independent;  ///< ascending
  std::vector<int> dependent;    ///< ascending
};

/// Splits the rows of J by rank-revealing QR of Jᵀ.
///
/// Rows are compared as given: scale them first. Dense column-pivoted QR for up to a hundred
/// thousand entries, sparse QR above. Among dependent rows an earlier one is preferred where the
/// pivoting allows.
/// @param tolerance relative to the largest row norm
RowRank split_rows(const SparseMatrix& J, double tolerance);

}  // namespace buckens::linalg
