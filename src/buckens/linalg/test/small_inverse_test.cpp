// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/small_inverse.h"

#include <cmath>

#include <gtest/gtest.h>

namespace buckens::linalg {
namespace {

/// No diagonal entry can be a pivot.
Matrix without_diagonal(int n) {
  Matrix A(n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) A(i, j) = i == j ? 0.0 : std::sin(1.0 + 3.7 * i + 1.3 * j * j);
  }
  return A;
}

TEST(SmallInverse, TimesTheMatrixIsOne) {
  for (const int n : {2, 3, 7, 16, kMostSmallRows}) {
    const Matrix A = without_diagonal(n);
    Matrix X(n, n);
    small_inverse(A, X);
    // Rounding of n products, and of X itself.
    const double rounding = 1e-15 * n * A.norm() * X.norm();
    EXPECT_LE((A * X - Matrix::Identity(n, n)).norm(), rounding) << n;
    EXPECT_LE((X * A - Matrix::Identity(n, n)).norm(), rounding) << n;
  }
}

TEST(SmallInverse, OfMatricesWithRoomForMore) {
  using Roomy = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 16, 16>;
  Roomy A(2, 2), X(2, 2);
  A << 0, 2, 4, 0;
  small_inverse(A, X);
  EXPECT_EQ(X(0, 0), 0.0);
  EXPECT_EQ(X(0, 1), 0.25);
  EXPECT_EQ(X(1, 0), 0.5);
  EXPECT_EQ(X(1, 1), 0.0);
}

TEST(SmallInverse, OfOneRowAndOfNone) {
  Matrix A = Matrix::Constant(1, 1, -4.0), X(1, 1);
  small_inverse(A, X);
  EXPECT_EQ(X(0, 0), -0.25);
  Matrix none(0, 0);
  small_inverse(none, none);
}

TEST(SmallInverse, OfSingularMatricesIsNotFinite) {
  Matrix X(3, 3);
  small_inverse(Matrix::Ones(3, 3), X);
  EXPECT_FALSE(X.allFinite());
}

}  // namespace
}  // namespace buckens::linalg
