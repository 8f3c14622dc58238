// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/complementarity.h"

#include <random>

#include <gtest/gtest.h>

namespace buckens::stepping {
namespace {

using linalg::Matrix;
using linalg::Vector;

/// P ≥ 0, D P − b ≥ 0, and one of both is zero in every row.
void expect_complementary(const Matrix& D, const Vector& b, const Vector& P) {
  const Vector open = D * P - b;
  const double size = b.cwiseAbs().maxCoeff() + (D * P).cwiseAbs().maxCoeff();
  EXPECT_GE(P.minCoeff(), 0.0);
  EXPECT_GE(open.minCoeff(), -1e-9 * size);
  EXPECT_NEAR(P.dot(open), 0.0, 1e-9 * size * P.cwiseAbs().maxCoeff());
}

TEST(Complementarity, OneStopPushesOrDoesNot) {
  const Matrix D = Matrix::Constant(1, 1, 0.5);
  EXPECT_DOUBLE_EQ(solve_complementarity(D, Vector::Constant(1, 3.0))[0], 6.0);
  EXPECT_EQ(solve_complementarity(D, Vector::Constant(1, -3.0))[0], 0.0);
}

TEST(Complementarity, AStopThatOthersRelieveDoesNotPull) {
  // An impulse on the first row moves the second one away by more than required.
  Matrix D(2, 2);
  D << 1.0, 0.9, 0.9, 1.0;
  const Vector b = (Vector(2) << 1.0, 0.5).finished();
  const Vector P = solve_complementarity(D, b);
  EXPECT_NEAR(P[0], 1.0, 1e-10);
  EXPECT_EQ(P[1], 0.0);
}

TEST(Complementarity, RandomProblems) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int n = 1; n <= 12; ++n) {
    for (int trial = 0; trial < 20; ++trial) {
      const Matrix A = Matrix::NullaryExpr(n, n + 2, [&] { return normal(random); });
      const Matrix D = A * A.transpose();
      const Vector b = Vector::NullaryExpr(n, [&] { return normal(random); });
      expect_complementary(D, b, solve_complementarity(D, b));
    }
  }
}

TEST(Complementarity, RowsThatHoldTheSameShareThePush) {
  const Matrix D = Matrix::Ones(2, 2);
  const Vector b = Vector::Ones(2);
  const Vector P = solve_complementarity(D, b);
  EXPECT_NEAR(P.sum(), 1.0, 1e-9);
  expect_complementary(D, b, P);
}

}  // namespace
}  // namespace buckens::stepping
