// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::stepping {

/// Row values y = N A Nᵀ f of a body with few variables, through its variables.
///
/// A part of a divided beam has six or twelve variables but eighteen rows of markers and patterns,
/// nearly all of them unit rows: N and Nᵀ cost a few additions and A is 6×6 or 12×12, where N A Nᵀ
/// is 18×18.
class SmallBodyAnswers {
 public:
  using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  /// Largest number of variables for which this is used.
  static constexpr int kMostVariables = 24;

  SmallBodyAnswers() = default;
  /// @param A responses of the variables to loads on them, @param B to loads of a correction
  SmallBodyAnswers(const RowMatrix& N, linalg::Matrix A, linalg::Matrix B);

  bool empty() const { return n_ == 0; }

  /// y += N (c A Nᵀ f).
  void add(double c, const linalg::Vector& f, linalg::Vector& y) const;
  /// y += N (c A Nᵀ f + B Nᵀ e).
  void add(double c, const linalg::Vector& f, const linalg::Vector& e, linalg::Vector& y) const;
  /// y = N A Nᵀ e and z += N B Nᵀ e.
  void correct(const linalg::Vector& e, linalg::Vector& y, linalg::Vector& z) const;
  /// y = N d.
  void row_values(const linalg::Vector& d, linalg::Vector& y) const;

 private:
  using Variables = std::array<double, kMostVariables>;
  struct Entry {
    int row, column;
    double value;
  };
  /// x = Nᵀ f.
  Variables gather(const linalg::Vector& f) const;
  /// y += N x.
  void spread(const double* x, linalg::Vector& y) const;
  void add_product(const linalg::Matrix& M, double factor, const Variables& x,
                   Variables& out) const;

  int n_ = 0;
  Eigen::Index num_rows_ = 0;
  std::vector<Entry> N_;
  linalg::Matrix A_, B_;
};

}  // namespace buckens::stepping
