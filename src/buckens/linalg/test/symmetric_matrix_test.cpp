// SPDX-License-Identifier: Apache-2.0
// In a process by itself; over several: tests/test_mpi.py.
#include "buckens/linalg/symmetric_matrix.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/linalg/conjugate_gradients.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

TEST(SymmetricMatrix, ProductsHaveTheBitsOfThoseOfASparseMatrix) {
  const SparseMatrix A = matrices::grid(4, 0.3), B = matrices::grid(4, 1.7);
  const SymmetricMatrix wrapped(A), other(B);
  const Matrix X = scattered_block(A.rows(), 3, 1);
  const Vector x = X.col(0), y = X.col(1);
  const Vector Ax = A * x, By = B * y;
  const Matrix AX = A * X;
  EXPECT_EQ(Vector(wrapped * x), Ax);
  EXPECT_EQ(Matrix(wrapped * X), AX);
  const Matrix weighted = 0.3 * (A * X);
  EXPECT_EQ(weighted_product(0.3, wrapped, X), weighted);
  EXPECT_EQ(Vector(wrapped * (2.0 * x)), Vector(A * (2.0 * x)));
  Vector found, second;
  multiply({{&wrapped, &x, &found}, {&other, &y, &second}});
  EXPECT_EQ(found, Ax);
  EXPECT_EQ(second, By);
  Vector sum = y, expected = y;
  wrapped.add_product(x, sum);
  expected.noalias() += A * x;
  EXPECT_EQ(sum, expected);
  EXPECT_EQ(conjugate_gradients(wrapped, x), conjugate_gradients(A, x));
}

TEST(SymmetricMatrix, IsMovedWithoutACopy) {
  SparseMatrix A = matrices::grid(4, 0.3);
  const double* values = A.valuePtr();
  SymmetricMatrix first(std::move(A));
  SymmetricMatrix second(std::move(first));
  SymmetricMatrix third;
  third = std::move(second);
  EXPECT_EQ(third.whole().valuePtr(), values);
  const SymmetricMatrix copy = third;
  EXPECT_NE(copy.whole().valuePtr(), values);
  EXPECT_TRUE(copy == third);
}

TEST(SymmetricMatrix, IsEqualWhereAllBitsAre) {
  const SymmetricMatrix A(matrices::grid(4, 0.3));
  SparseMatrix changed = A;
  EXPECT_TRUE(A == SymmetricMatrix(changed));
  EXPECT_EQ(A.content(), SymmetricMatrix(changed).content());
  changed.valuePtr()[7] = std::nextafter(changed.valuePtr()[7], 1.0);
  EXPECT_FALSE(A == SymmetricMatrix(changed));
  EXPECT_NE(A.content(), SymmetricMatrix(changed).content());
  EXPECT_FALSE(A == SymmetricMatrix(matrices::grid(3, 0.3)));
}

TEST(SymmetricMatrix, TellsEntriesNearItsDiagonal) {
  const SparseMatrix A = matrices::grid(4, 0.3);
  const auto n = static_cast<int>(A.cols());
  std::vector<int> lengths;
  std::vector<double> expected;
  for (int column = 0; column < n; ++column) {
    lengths.push_back(std::min((7 * column) % 6, n - column));
    for (int k = 0; k < lengths.back(); ++k) expected.push_back(A.coeff(column + k, column));
  }
  const Vector found = SymmetricMatrix(A).near_diagonal(lengths);
  EXPECT_EQ(std::vector<double>(found.begin(), found.end()), expected);
}

TEST(SymmetricMatrix, IsATermOfASum) {
  const SparseMatrix A = matrices::grid(3, 0.3), B = matrices::grid(3, 1.7);
  const SymmetricMatrix a(A), b(B);
  MatrixSum plain, wrapped;
  plain.add(2.0, A);
  plain.add(0.1, B);
  wrapped.add(2.0, a);
  wrapped.add(0.1, b);
  EXPECT_FALSE(plain.is_divisible());
  EXPECT_TRUE(wrapped.is_divisible());
  EXPECT_EQ(wrapped.size(), A.rows());
  EXPECT_TRUE(SymmetricMatrix(plain.whole()) == SymmetricMatrix(wrapped.whole()));
  EXPECT_EQ(plain.diagonal(), wrapped.diagonal());
  EXPECT_FALSE(a.is_divided()) << "in one process nothing is";
}

}  // namespace
}  // namespace buckens::linalg
