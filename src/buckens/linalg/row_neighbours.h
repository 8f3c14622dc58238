// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "buckens/base/number_bytes.h"
#include "buckens/linalg/row_order.h"
#include "buckens/linalg/row_tables.h"

namespace buckens::linalg {

/// Finds the units that a process has beside its own, and who has them. Since all that joins units
/// is symmetric, a process has beside its units those of another that have one of its own beside
/// them.
class RowNeighbours {
 public:
  /// Sets the run of units. @param first_units see describe_rows()
  RowNeighbours(std::span<const int> first_units, std::size_t place, RowTables& own);
  bool is_here(int unit) const { return unit >= own_->first && unit < own_->first + own_->count; }
  /// A unit here is joined with another, here or not.
  void add(int unit, int other);
  /// When all have been added.
  void finish();
  /// Place of a unit that is here or beside.
  int place_of(int unit) const;

 private:
  std::span<const int> first_units_;
  std::size_t place_;
  RowTables* own_;
  std::vector<std::vector<int>> sent_;
};

/// Puts what tables of all kinds have in common; RowTables::inertia follows.
void put_runs(const RowTables& own, const RowMajorMatrix& N, const SharedRowOrder& order,
              base::BytesTo& put);

/// Numbers of units in the order of rows, and back. A unit is a node of three variables or a
/// variable.
class UnitOrder {
 public:
  UnitOrder(const SharedRowOrder& order, int width) : order_(order.get()), width_(width) {}
  int unit(int number) const {
    return order_ != nullptr ? order_->row(width_ * number) / width_ : number;
  }
  int number(int unit) const {
    return order_ != nullptr ? order_->variable(width_ * unit) / width_ : unit;
  }

 private:
  const RowOrder* order_;
  int width_;
};

/// Columns of a run of units of A, with places for rows.
SparseMatrix columns_at_places(const SparseMatrix& A, const RowTables& own, const UnitOrder& order,
                               const RowNeighbours& beside);

/// Rows of a run of units, as many as are here.
template <class Columns>
Matrix rows_here(const Columns& of, const RowTables& own, const UnitOrder& order) {
  Matrix out(own.count, of.cols());
  for (int k = 0; k < own.count; ++k) out.row(k) = of.row(order.number(own.first + k));
  return out;
}

template <class Sparse>
void put_sparse(const Sparse& A, base::BytesTo& put) {
  put(static_cast<int>(A.rows()));
  put(static_cast<int>(A.cols()));
  put(static_cast<int>(A.nonZeros()));
  put.all(A.outerIndexPtr(), static_cast<std::size_t>(A.outerSize()) + 1);
  put.all(A.innerIndexPtr(), static_cast<std::size_t>(A.nonZeros()));
  put.all(A.valuePtr(), static_cast<std::size_t>(A.nonZeros()));
}

template <class Sparse>
Sparse taken_sparse(base::BytesFrom& take) {
  const auto rows = take.next<int>();
  const auto columns = take.next<int>();
  const auto entries = take.next<int>();
  Sparse A(rows, columns);
  A.resizeNonZeros(entries);
  take.take_all(A.outerIndexPtr(), static_cast<std::size_t>(A.outerSize()) + 1);
  take.take_all(A.innerIndexPtr(), static_cast<std::size_t>(entries));
  take.take_all(A.valuePtr(), static_cast<std::size_t>(entries));
  return A;
}

/// What describe_rows() has put of variables.
VariableTables described_variables(base::BytesFrom& take);

}  // namespace buckens::linalg
