// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/column_descriptions.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/nodal_vector.h"
#include "buckens/linalg/shared_row_order.h"

namespace buckens::linalg {

/// A sparse matrix of any shape that multiplies vectors and does nothing else, such as the one that
/// makes stresses of displacements.
///
/// Where several processes share the work and it is large, those other than the first have its rows
/// (ranks.h) from the beginning. In a process by itself products are those of Eigen.
class SparseRows {
 public:
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  SparseRows() = default;
  /// @param A is empty afterwards
  /// @throws NumericalError if memory is too small
  explicit SparseRows(RowMajor&& A);
  /// One whose rows other processes make, as columns of its transpose (Ranks::serve).
  /// @param order in which they have them, and in which they are described
  /// @pre is_shared_work(columns)
  /// @throws NumericalError if one of them cannot, with its reason
  SparseRows(Eigen::Index rows, Eigen::Index columns, const SharedRowOrder& order,
             const DescribeColumns& describe);

  Eigen::Index rows() const { return rows_; }
  /// A x
  Vector operator*(const Vector& x) const { return multiplied(x, nullptr); }
  /// The same by several threads, with the same bits.
  Vector multiplied(const Vector& x, TaskPool* pool) const;
  /// The largest norm ‖F y‖ of the runs of y = A x that F has columns for, found where rows and
  /// vector are, if other processes have both. @pre where they have an order, one of them has all
  /// rows of a run
  std::optional<double> largest_norm(const NodalVector& x, const Matrix& F) const;

 private:
  friend class RowProgram;
  /// By which other processes know it, and whether they have not multiplied vectors of this body by
  /// it.
  std::pair<int, bool> number_for(int space) const;

  class Elsewhere;

  Eigen::Index rows_ = 0;
  RowMajor here_;  // empty where other processes have them
  std::shared_ptr<const Elsewhere> elsewhere_;
};

}  // namespace buckens::linalg
