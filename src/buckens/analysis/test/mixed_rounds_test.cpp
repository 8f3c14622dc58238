// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/mixed_rounds.h"

#include <gtest/gtest.h>

namespace buckens::analysis {
namespace {

using linalg::Matrix;
using linalg::Vector;

/// Rounds x -> A x + b from zero until nothing changes. One of them grows, five shrink slowly.
int rounds_until_settled(bool is_mixed) {
  constexpr Eigen::Index n = 40;
  constexpr int kMost = 100;
  const Matrix basis = Matrix::Identity(n, n) - Matrix::Constant(n, n, 2.0 / n);  // orthonormal
  Vector factors = Vector::Constant(n, 1e-3);
  factors.head<6>() << -0.99, -1.2, 0.95, -0.97, 0.5, -0.8;
  const Matrix A = basis * factors.asDiagonal() * basis;
  const Vector b = Vector::LinSpaced(n, 1.0, 2.0);
  const Vector exact = (Matrix::Identity(n, n) - A).lu().solve(b);
  MixedRounds mixed;
  Vector x = Vector::Zero(n);
  for (int round = 1; round <= kMost; ++round) {
    const Vector g = A * x + b;
    // Rounding of 40 numbers of order one.
    if ((g - x).norm() <= 1e-12) {
      EXPECT_LE((x - exact).norm(), 1e-10);
      return round;
    }
    x = is_mixed ? mixed.mix(x, g) : g;
  }
  return kMost + 1;
}

TEST(MixedRounds, ConvergeWherePlainOnesGrow) {
  EXPECT_GT(rounds_until_settled(false), 100);
  // One for each of the six, and some for the rest, which shrinks a thousandfold by itself.
  EXPECT_LE(rounds_until_settled(true), 14);
}

}  // namespace
}  // namespace buckens::analysis
