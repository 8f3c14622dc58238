// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// LU factors of a small sparse matrix whose pattern never changes while its values do.
///
/// Backend KLU: the ordering is computed once; each factorise() reuses the pivots of the last one
/// while they stay good (reciprocal pivot growth), and pivots again otherwise.
class SparseLu {
 public:
  /// @param pattern square matrix in compressed form; the values are not read
  explicit SparseLu(const SparseMatrix& pattern);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// @param A new values with the pattern of the constructor
  /// @return false if A is singular to working precision
  bool factorise(const SparseMatrix& A);
  /// Values of the matrix for which the current pivots were chosen; empty before the first.
  const std::vector<double>& pivoted_values() const;
  /// Ratio of the smallest to the largest pivot; a cheap estimate of 1/condition.
  double pivot_ratio() const;
  /// x ← A⁻¹ x with the last factorisation.
  void solve_in_place(Vector& x) const;
  /// The same for each column.
  void solve_in_place(Matrix& X) const;
  /// Entries of L and U predicted by the ordering, before factorising.
  double predicted_entries() const;
  /// Entries of L and U of the last factorisation.
  double num_factor_entries() const;

 private:
  struct Backend;
  std::unique_ptr<Backend> backend_;
};

}  // namespace buckens::linalg
