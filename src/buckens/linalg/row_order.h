// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/linalg/grid_plugin.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/shared_row_order.h"

namespace buckens::linalg {

/// In which order other processes have the rows of the matrices and vectors of a body (ranks.h): a
/// part of the variables each, chosen so that parts have little to do with one another. Rows count
/// through the parts; the variables of a part stay in their order.
class RowOrder {
 public:
  /// @param part of each variable, 0 … parts − 1
  RowOrder(const std::vector<int>& part, int parts);

  int size() const { return static_cast<int>(rows_.size()); }
  int row(int variable) const { return rows_[static_cast<std::size_t>(variable)]; }
  int variable(int row) const { return variables_[static_cast<std::size_t>(row)]; }
  const std::vector<int>& rows() const { return rows_; }
  const std::vector<int>& variables() const { return variables_; }
  /// First rows of the parts, and the end.
  const std::vector<int>& first_rows() const { return first_rows_; }

  /// Numbers of variables in the order of rows.
  template <class T>
  std::vector<T> by_rows(const T* of_variables) const {
    std::vector<T> out;
    out.reserve(variables_.size());
    for (const int variable : variables_) out.push_back(of_variables[variable]);
    return out;
  }
  /// And back.
  template <class T>
  void by_variables(const std::vector<T>& of_rows, T* of_variables) const {
    for (std::size_t row = 0; row < variables_.size(); ++row) {
      of_variables[variables_[row]] = of_rows[row];
    }
  }

 private:
  std::vector<int> rows_;       // of each variable
  std::vector<int> variables_;  // of each row
  std::vector<int> first_rows_;
};

bool is_same_order(const SharedRowOrder& a, const SharedRowOrder& b);

/// What the plug-in gets. @param order must outlive it
BuckensGridRows rows_for_plugin(const SharedRowOrder& order);

/// Calls f(y) to fill a vector in the order of rows, and gives it back by variables.
template <class T, class F>
void fill_by_rows(const SharedRowOrder& order, T* y, F&& f) {
  if (!order) return f(y);
  std::vector<T> of_rows(order->rows().size());
  f(of_rows.data());
  order->by_variables(of_rows, y);
}

/// A matrix whose rows and columns get other numbers, its rows ascending in each column.
/// @param numbers of those of A, a permutation
SparseMatrix renumbered(const SparseMatrix& A, const std::vector<int>& numbers);
/// The same of a matrix that is symmetric to the bit, with less memory on the way.
SparseMatrix renumbered_symmetric(const SparseMatrix& A, const std::vector<int>& numbers);

}  // namespace buckens::linalg
