// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// Cholesky factor of a sparse symmetric positive definite matrix: factorised once, solved often.
///
/// Backend CHOLMOD (supernodal where it pays, fill-reducing ordering). Solving allocates nothing
/// after the first call of a given number of right-hand sides.
class SparseCholesky {
 public:
  /// @param A symmetric, both triangles stored
  /// @throws NumericalError if A is not positive definite, naming the column
  explicit SparseCholesky(const SparseMatrix& A);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  Eigen::Index size() const;
  /// Entries of L; times eight gives the bytes that one half of a solve reads.
  double num_factor_entries() const;

  /// x ← A⁻¹ x. Cost: two passes over the factor.
  void solve_in_place(Vector& x) const;
  /// A⁻¹ B for several right-hand sides at once.
  Matrix solve(const Matrix& B) const;

 private:
  struct Backend;
  std::unique_ptr<Backend> backend_;
};

}  // namespace buckens::linalg
