// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace buckens_petsc {

class ArraysAside;

/// Columns of a sparse matrix as their entries are listed, in less memory where columns resemble
/// the one before.
///
/// The rows of a column are those that end the list kept last, all of them moved by the same
/// number, or a list of their own. The columns of the variables of a node have the same rows from
/// the diagonal on, and so have the stresses of an element; of a mass matrix that acts alike in
/// three directions, they have rows one further down and the same values.
class KeptColumns {
 public:
  struct Column {
    const int* rows;
    int moved;
    const double* values;
    int size;

    int row(int entry) const { return rows[entry] + moved; }
    double value(int entry) const { return values[entry]; }
  };

  KeptColumns() = default;
  /// @param starts of the columns, and the end @param rows ascending in each column
  KeptColumns(const std::vector<int>& starts, std::vector<int>&& rows,
              std::vector<double>&& values);

  int count() const { return static_cast<int>(places_.size()); }
  Column column(int k) const {
    const Place& at = places_[static_cast<std::size_t>(k)];
    return {rows_.data() + at.row, at.moved, values_.data() + at.value, at.size};
  }
  /// As they were given.
  void list(std::vector<int>& starts, std::vector<int>& rows, std::vector<double>& values) const;
  /// What is stored, in bytes.
  std::size_t bytes() const;

  /// Between the two no column may be read.
  void put(ArraysAside& aside);
  /// After arrays did not come back: columns are empty.
  void lose();

 private:
  struct Place {
    int row, value;  // first ones
    int size, moved;
  };
  /// Whether the rows of the last list, from `from` on, moved, are these.
  bool ends_with(int from, int moved, const int* rows, int size) const;

  std::vector<Place> places_;
  std::vector<int> rows_;
  std::vector<double> values_;
};

}  // namespace buckens_petsc
