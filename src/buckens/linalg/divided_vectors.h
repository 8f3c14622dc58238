// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/linalg/divided_vector.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/row_tables.h"

namespace buckens::linalg {

/// Vectors of one body that the other processes have by runs of rows (ranks.h), and the work on
/// them. Vectors that go there or come back are by variables. Beside vectors, each process has the
/// RowTables of its rows.
class DividedVectors {
 public:
  /// Of a solid whose inertia acts node by node. @param N columns: variables
  /// @throws NumericalError if memory is too small
  DividedVectors(const WholeNodes& of, const RowMajorMatrix& N);
  /// Of another body.
  DividedVectors(const WholeVariables& of, const RowMajorMatrix& N);
  ~DividedVectors();
  DividedVectors(const DividedVectors&) = delete;
  DividedVectors& operator=(const DividedVectors&) = delete;

  Eigen::Index size() const { return size_; }
  /// Rows N, of interfaces and of other places whose values are asked for.
  int num_rows() const { return num_rows_; }
  /// Gives a vector to the others.
  DividedVector put(const Vector& x);
  /// Brings one here. @param x gets its size
  void take(const DividedVector& x, Vector& out) const;
  /// x of K̂ x = b, by a factor of the plug-in which the processes share (SharedFactor).
  DividedVector solve(void* factor, const DividedVector& b);

 private:
  friend class RowProgram;
  template <class Whole>
  void begin(const Whole& of, const RowMajorMatrix& N, int width);
  DividedVector new_vector();

  int number_ = -1;
  Eigen::Index size_;
  int num_rows_;
  SharedRowOrder order_;
  std::shared_ptr<std::vector<int>> dropped_ = std::make_shared<std::vector<int>>();
};

}  // namespace buckens::linalg
