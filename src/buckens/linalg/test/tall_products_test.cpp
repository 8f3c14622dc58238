// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/tall_products.h"

#include <gtest/gtest.h>

#include "buckens/linalg/inverse_iteration.h"

namespace buckens::linalg {
namespace {

// Sums of so many products in another order.
constexpr Eigen::Index kRows = 500;
constexpr double kSumRounding = 1e-14;

TEST(TallProducts, EqualThoseOfEigenForBlocksOfLargerMatrices) {
  const Matrix all = scattered_block(kRows, 20, 1);
  const auto A = all.middleCols(2, 7);
  const auto B = all.rightCols(5);
  const Matrix inner = inner_products(A, B);
  EXPECT_LE((inner - A.transpose() * B).norm(), kSumRounding * A.norm() * B.norm());
  EXPECT_LE((combinations(A, inner) - A * inner).norm(), kSumRounding * A.norm() * inner.norm());
  Matrix rest = B;
  subtract_combinations(A, inner, rest);
  EXPECT_LE((rest - (B - A * inner)).norm(), kSumRounding * A.norm() * inner.norm());
}

TEST(TallProducts, ThreadsChangeNoBit) {
  const Eigen::Index rows = 9000;  // of several parts
  const Matrix A = scattered_block(rows, 7, 1);
  const Matrix B = scattered_block(rows, 5, 2);
  TaskPool pool(3);
  const Matrix inner = inner_products(A, B);
  EXPECT_EQ(inner, inner_products(A, B, &pool));
  EXPECT_LE((inner - A.transpose() * B).norm(), kSumRounding * A.norm() * B.norm());
  EXPECT_EQ(combinations(A, inner), combinations(A, inner, &pool));
  Matrix alone = B, shared = B;
  subtract_combinations(A, inner, alone);
  subtract_combinations(A, inner, shared, &pool);
  EXPECT_EQ(alone, shared);
  SparseMatrix C(rows, rows);
  for (int i = 0; i < static_cast<int>(rows); ++i) C.insert(i, i) = 1.0 + 0.3 * i;
  C.makeCompressed();
  EXPECT_EQ(symmetric_product(C, A), symmetric_product(C, A, &pool));
}

TEST(TallProducts, NothingToMultiplyIsNothing) {
  const Matrix A = scattered_block(kRows, 3, 2);
  const Matrix none(kRows, 0);
  EXPECT_EQ(inner_products(none, A).size(), 0);
  EXPECT_EQ(combinations(none, Matrix(0, 2)), Matrix::Zero(kRows, 2));
  Matrix B = A;
  subtract_combinations(none, Matrix(0, 3), B);
  EXPECT_EQ(B, A);
}

TEST(TallProducts, SparseOnesTakeAnyNumberOfColumns) {
  SparseMatrix A(kRows, kRows);
  for (int i = 0; i < static_cast<int>(kRows); ++i) {
    A.insert(i, i) = 2.0 + 0.01 * i;
    const int other = (i * 7) % static_cast<int>(kRows);
    if (other > i) {
      A.insert(i, other) = 0.1 * i;
      A.insert(other, i) = 0.1 * i;
    }
  }
  A.makeCompressed();
  for (const Eigen::Index columns : {0, 1, 6, 8, 17}) {
    const Matrix X = scattered_block(kRows, columns, 3);
    const Matrix expected = A * X;
    EXPECT_LE((symmetric_product(A, X) - expected).norm(), kSumRounding * expected.norm())
        << columns;
  }
}

}  // namespace
}  // namespace buckens::linalg
