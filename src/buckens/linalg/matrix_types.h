// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace buckens::linalg {

/// Dense column vector of doubles, length set at run time.
using Vector = Eigen::VectorXd;

/// Dense column-major matrix of doubles.
using Matrix = Eigen::MatrixXd;

/// Sparse column-compressed matrix with `int` indices, the layout CHOLMOD and KLU read in place.
using SparseMatrix = Eigen::SparseMatrix<double>;

/// Entry of a sparse matrix under assembly: (row, column, value); duplicates are summed.
using Triplet = Eigen::Triplet<double, int>;

}  // namespace buckens::linalg
