// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_rows.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace buckens::linalg {

namespace {

TEST(SparseRows, OfOneProcessMultiplyAsEigenDoes) {
  std::vector<Triplet> entries;
  for (int row = 0; row < 50; ++row) {
    for (int k = 0; k < 4; ++k) entries.emplace_back(row, (7 * row + 5 * k) % 30, 0.1 * row - k);
  }
  SparseRows::RowMajor A(52, 30);  // two rows are empty
  A.setFromTriplets(entries.begin(), entries.end());
  const Vector x = Vector::LinSpaced(30, -1.0, 2.0);
  const Vector expected = A * x;
  const Matrix dense = Matrix(A);

  const SparseRows rows(std::move(A));
  EXPECT_EQ(rows.rows(), 52);
  const Vector y = rows * x;
  EXPECT_EQ(y, expected);
  EXPECT_FALSE(rows.largest_norm(x, Matrix::Identity(6, 6))) << "there are no other processes";
  // Sums of four products of numbers up to 5 in another order.
  EXPECT_LT((y - dense * x).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SparseRows, WithoutRowsGiveNothing) {
  const SparseRows rows;
  EXPECT_EQ(rows.rows(), 0);
  EXPECT_EQ((rows * Vector()).size(), 0);
}

}  // namespace

}  // namespace buckens::linalg
