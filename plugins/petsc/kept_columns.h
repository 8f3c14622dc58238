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

  /// Room for what is added. Memory counts once there is something in it.
  void reserve(std::size_t columns, std::size_t entries);
  /// @param rows ascending
  void add(const int* rows, const double* values, int size);
  /// @param starts of the columns, and the end
  void add(const std::vector<int>& starts, const std::vector<int>& rows,
           const std::vector<double>& values);

  int count() const { return static_cast<int>(places_.size()); }
  Column column(int k) const {
    const Place& at = places_[static_cast<std::size_t>(k)];
    return {rows_.data() + at.row, at.moved, values_.data() + at.value, at.size};
  }
  /// As they were given.
  void list(std::vector<int>& starts, std::vector<int>& rows, std::vector<double>& values) const;
  /// What is stored.
  std::size_t bytes() const;

  /// No column may be read until arrays have come back.
  void put(ArraysAside& aside);
  /// After arrays did not come back: columns are empty.
  void lose();

 private:
  struct Place {
    int row, value;  // first ones
    int size, moved;
  };

  std::vector<Place> places_;
  std::vector<int> rows_;
  std::vector<double> values_;
  int last_list_ = 0;  // in rows_, from where on
};

}  // namespace buckens_petsc
