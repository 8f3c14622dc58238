// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// A symmetric matrix whose rows other processes have (ranks.h), each a run of them.
class DividedMatrix {
 public:
  /// @param content hash of A
  /// @throws NumericalError if memory is too small
  DividedMatrix(const SparseMatrix& A, std::array<std::uint64_t, 2> content);
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

  SparseMatrix gathered() const;
  /// Of the plug-in.
  int number() const { return number_; }
  Eigen::Index entries() const { return entries_; }
  const Vector& diagonal() const { return diagonal_; }
  std::array<std::uint64_t, 2> content() const { return content_; }

 private:
  int number_ = -1;
  Eigen::Index entries_;
  Vector diagonal_;
  std::array<std::uint64_t, 2> content_;
};

}  // namespace buckens::linalg
