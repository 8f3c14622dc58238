// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// Factor of a symmetric positive definite matrix A: computed once, used for many solves.
///
/// All that code which solves needs to know. SparseCholesky keeps the factor in the memory of this
/// process; another implementation may keep it on an accelerator or distribute it.
class Factor {
 public:
  virtual ~Factor() = default;

  virtual Eigen::Index size() const = 0;
  /// Entries of L.
  virtual double num_factor_entries() const = 0;
  /// Bytes that each of the two passes of a solve reads.
  virtual double bytes() const = 0;

  /// X ← A⁻¹ B for contiguous columns; X may be B.
  /// @param pool may share the work; the result must not depend on it
  virtual void solve(const double* B, double* X, Eigen::Index columns, TaskPool* pool) const = 0;
  /// x ← A⁻¹ x for vectors of length size() anywhere in memory.
  virtual void solve_in_place(std::span<double* const> vectors, TaskPool* pool = nullptr) const = 0;

  /// x ← A⁻¹ x. Cost: two passes over the factor.
  void solve_in_place(Vector& x, TaskPool* pool = nullptr) const {
    solve(x.data(), x.data(), 1, pool);
  }
  /// X ← A⁻¹ X for several right-hand sides at once.
  void solve_in_place(Matrix& X, TaskPool* pool = nullptr) const {
    solve(X.data(), X.data(), X.cols(), pool);
  }
  /// A⁻¹ B.
  Matrix solve(const Matrix& B, TaskPool* pool = nullptr) const {
    Matrix X(B.rows(), B.cols());
    solve(B.data(), X.data(), B.cols(), pool);
    return X;
  }
};

/// Function that factorises A, symmetric with both triangles stored.
/// @throws NumericalError if A is not positive definite
using MakeFactor = std::function<std::shared_ptr<const Factor>(const SparseMatrix& A)>;

}  // namespace buckens::linalg
