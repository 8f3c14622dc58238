// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/trapezoid.h"

namespace buckens::linalg {

/// The dense matrix of one supernode of a multifrontal factorisation: its columns, which are
/// eliminated in it, and what they subtract from the rows below. Memory belongs to others.
class Front {
 public:
  /// @param columns of the supernode @param below rows below them
  Front(int columns, int below) : own_{columns + below, columns}, rest_{below, below} {}

  /// Numbers that it takes: for its columns, and for the rest.
  std::ptrdiff_t own_size() const { return own_.size(); }
  std::ptrdiff_t rest_size() const { return rest_.size(); }
  const Trapezoid& own() const { return own_; }
  double* own_values() const { return own_values_; }

  /// Takes memory, which is set to zero. @param rest null if others do without it
  void begin(double* own, double* rest, TaskPool* pool);
  /// Column of the whole front: [i] is row i, for i ≥ j.
  double* column(int j) const {
    if (j < own_.columns) return own_.column(own_values_, j);
    return rest_.column(rest_values_, j - own_.columns) - own_.columns;
  }
  /// Adds the rest of a front below this one in the tree.
  /// @param places rows of this front for its rows, ascending
  void add(const double* rest, std::span<const int> places, TaskPool* pool);
  /// Computes L in the own columns, and subtracts L Lᵀ of the rows below from the rest. All
  /// products are made of the same tiles whatever the pool, so that no bit depends on it.
  /// @return first column without a positive pivot, −1 if there is none
  int eliminate(TaskPool* pool);
  /// Computes L in the blocks begin … end of the own columns, from which those before have been
  /// subtracted; nothing is subtracted from other columns. @return as above
  int eliminate_blocks(int begin, int end, TaskPool* pool);

 private:
  void update_tile(int begin, int p, int row, int rows);
  void factorise_diagonal(int p, int& failed);
  void divide_tile(int p, int row, int rows);
  void update_rest(int q, int row, int rows);

  Trapezoid own_, rest_;
  double* own_values_ = nullptr;
  double* rest_values_ = nullptr;
};

}  // namespace buckens::linalg
