// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/task_pool.h"
#include "buckens/linalg/symmetric_matrix.h"

namespace buckens::linalg {

/// Products of matrices with many rows and few columns, as block iterations need them. BLAS does
/// the dense ones: it uses the vector instructions of the processor, while a program that has to
/// run everywhere is compiled without them.
///
/// A pool may share the rows among its threads. They are divided by their number only and sums are
/// added in one order, so no bit depends on the threads.

/// AᵀB.
Matrix inner_products(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& B,
                      TaskPool* pool = nullptr);

/// B ← B − A S. @param A n×m, @param S m×k, @param B n×k
void subtract_combinations(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& S,
                           Eigen::Ref<Matrix> B, TaskPool* pool = nullptr);

/// A S.
Matrix combinations(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& S,
                    TaskPool* pool = nullptr);

/// A X, reading the entries of A once for eight columns.
/// @param A symmetric, both triangles stored
Matrix symmetric_product(const SparseMatrix& A, const Eigen::Ref<const Matrix>& X,
                         TaskPool* pool = nullptr);
/// The same of a matrix that may be given by node, without forming it, or divided among processes,
/// without bringing it back.
Matrix symmetric_product(const SymmetricMatrix& A, const Eigen::Ref<const Matrix>& X,
                         TaskPool* pool = nullptr);

}  // namespace buckens::linalg
