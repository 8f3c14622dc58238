// SPDX-License-Identifier: Apache-2.0
// Answers through the variables of a body against products of whole matrices.
#include "buckens/stepping/small_body_answers.h"

#include <cmath>

#include <gtest/gtest.h>

namespace buckens::stepping {
namespace {

using linalg::Matrix;
using linalg::Vector;

Matrix some_matrix(Eigen::Index rows, Eigen::Index columns, double phase) {
  Matrix out(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      out(i, j) = std::cos(phase + 2.1 * static_cast<double>(i) + 0.9 * static_cast<double>(j));
    }
  }
  return out;
}

class SmallBodies : public testing::TestWithParam<int> {};

TEST_P(SmallBodies, AnswerAsTheProductsDo) {
  const int n = GetParam();
  const int rows = n + 7;
  Matrix N = Matrix::Zero(rows, n);
  for (int row = 0; row < rows; row += 2) N(row, row % n) = 1.0;  // others stay zero
  N.bottomRows(3) = some_matrix(3, n, 0.3);
  const Matrix A = some_matrix(n, n, 0.1), B = some_matrix(n, n, 0.7);
  const SmallBodyAnswers answers(N.sparseView(), A, B);
  EXPECT_FALSE(answers.empty());
  const Vector f = some_matrix(rows, 1, 1.1), e = some_matrix(rows, 1, 1.2);
  const Vector y = some_matrix(rows, 1, 1.3), z = some_matrix(rows, 1, 1.4);
  // Sums of at most n² products of numbers below one.
  const double rounding = 1e-15 * n * n * rows;

  Vector found = y;
  answers.add(0.4, f, found);
  EXPECT_LE((found - y - 0.4 * (N * (A * (N.transpose() * f)))).norm(), rounding);
  found = y;
  answers.add(0.4, f, e, found);
  const Vector moved = 0.4 * (A * (N.transpose() * f)) + B * (N.transpose() * e);
  EXPECT_LE((found - y - N * moved).norm(), rounding);
  Vector corrected, moving = z;
  answers.correct(e, corrected, moving);
  EXPECT_LE((corrected - N * (A * (N.transpose() * e))).norm(), rounding);
  EXPECT_LE((moving - z - N * (B * (N.transpose() * e))).norm(), rounding);
  const Vector d = some_matrix(n, 1, 1.5);
  answers.row_values(d, found);
  EXPECT_LE((found - N * d).norm(), rounding);
}

// Bars, beams in the plane and in space, and the largest number.
INSTANTIATE_TEST_SUITE_P(Variables, SmallBodies,
                         testing::Values(4, 6, 12, SmallBodyAnswers::kMostVariables));

TEST(SmallBodies, AreNoneByDefault) { EXPECT_TRUE(SmallBodyAnswers().empty()); }

}  // namespace
}  // namespace buckens::stepping
