// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/small_lu.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace buckens::linalg {
namespace {

/// A matrix whose rows and columns have units from 1e-6 to 1e6, and no good pivot on its diagonal.
Matrix some_matrix(int n) {
  Matrix A(n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) A(i, j) = std::sin(1.0 + 3.7 * i + 1.3 * j * j);
    A(j, j) = 1e-9;
  }
  for (int k = 0; k < n; ++k) {
    const double unit = std::pow(10.0, 6.0 * std::cos(k));
    A.row(k) *= unit;
    A.col(k) *= unit;
  }
  return A;
}

TEST(SmallLu, SolvesWhateverTheUnitsAre) {
  SmallLu lu;
  for (const int n : {1, 3, 12, 3}) {
    const Matrix A = some_matrix(n);
    ASSERT_TRUE(lu.factorise(A));
    Vector x = Vector::Ones(n);
    lu.solve_in_place(x);
    const Vector left = A * x - Vector::Ones(n);
    for (int k = 0; k < n; ++k) {
      // Rounding of the products of its own row.
      const double scale = A.row(k).cwiseAbs() * x.cwiseAbs();
      EXPECT_LE(std::abs(left[k]), 1e-12 * scale) << n << " rows, row " << k;
    }
  }
}

TEST(SmallLu, TellsSingularMatrices) {
  SmallLu lu;
  EXPECT_FALSE(lu.factorise(Matrix::Ones(4, 4)));
  EXPECT_FALSE(lu.factorise(Matrix::Zero(2, 2)));
  Matrix A = Matrix::Identity(3, 3);
  A(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lu.factorise(A));
  Vector none;
  EXPECT_TRUE(lu.factorise(Matrix(0, 0)));
  lu.solve_in_place(none);
}

}  // namespace
}  // namespace buckens::linalg
