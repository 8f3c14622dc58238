// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "buckens/linalg/column_descriptions.h"
#include "buckens/linalg/grid_plugin.h"
#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A symmetric matrix whose rows other processes have (ranks.h), each a run of them.
class DividedMatrix {
 public:
  /// @throws NumericalError if memory is too small
  explicit DividedMatrix(const SparseMatrix& A);
  /// One that the other processes make, each its columns (Ranks::serve).
  /// @throws NumericalError if one of them cannot, with its reason
  DividedMatrix(Eigen::Index size, const DescribeColumns& describe);
  /// Σ w_k A_k @pre of one size, at least one and at most kBuckensMostProducts
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
  int number_ = -1;
  Vector diagonal_;
  BuckensGridFacts facts_{};
};

}  // namespace buckens::linalg
