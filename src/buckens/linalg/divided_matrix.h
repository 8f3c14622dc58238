// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "buckens/linalg/column_descriptions.h"
#include "buckens/linalg/grid_plugin.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/shared_row_order.h"

namespace buckens::linalg {

/// A symmetric matrix whose rows other processes have (ranks.h), each a run of them. Outside of
/// them there are variables only; their order of rows is applied to all that goes there or comes
/// back.
class DividedMatrix {
 public:
  /// @throws NumericalError if memory is too small
  explicit DividedMatrix(const SparseMatrix& A, SharedRowOrder order = {});
  /// One that the other processes make, each its columns (Ranks::serve).
  /// @param describe columns in the order of rows
  /// @throws NumericalError if one of them cannot, with its reason
  DividedMatrix(Eigen::Index size, const DescribeColumns& describe, SharedRowOrder order = {});
  /// Σ w_k A_k @pre of one order of rows, at least one and at most kBuckensMostProducts
  DividedMatrix(std::span<const DividedMatrix* const> terms, std::span<const double> weights);
  ~DividedMatrix();
  DividedMatrix(const DividedMatrix&) = delete;
  DividedMatrix& operator=(const DividedMatrix&) = delete;

  /// y = A x
  struct Product {
    const DividedMatrix* A;
    const double* x;
    double* y;
  };
  /// By as few orders as possible.
  static void multiply(std::span<const Product> products);
  /// The sum of the products of all entries of Σ a_k A_k and Σ b_k A_k.
  static double inner_product(std::span<const DividedMatrix* const> terms,
                              std::span<const double> a, std::span<const double> b);

  SparseMatrix gathered() const;
  const SharedRowOrder& row_order() const { return order_; }
  /// Memory of all matrices that gathered() has returned.
  static double bytes_gathered();
  /// Of the plug-in.
  int number() const { return number_; }
  Eigen::Index size() const { return diagonal_.size(); }
  Eigen::Index entries() const { return facts_.entries; }
  const Vector& diagonal() const { return diagonal_; }
  /// See SymmetricMatrix.
  Vector near_diagonal(std::span<const int> lengths) const;
  double norm() const;
  std::array<std::uint64_t, 2> content() const { return {facts_.content[0], facts_.content[1]}; }

 private:
  /// Asks the plug-in for the matrix, and for its diagonal.
  struct Wish;
  template <class Ask>
  void ask(Eigen::Index size, const Wish& wish, Ask&& ask);

  SharedRowOrder order_;
  int number_ = -1;
  Vector diagonal_;
  BuckensGridFacts facts_{};
};

}  // namespace buckens::linalg
