// SPDX-License-Identifier: Apache-2.0
// Simultaneous inverse iteration on problems whose eigenvalues are known by construction.
#include "buckens/linalg/inverse_iteration.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace buckens::linalg {
namespace {

SparseMatrix diagonal(const Vector& values) {
  SparseMatrix out(values.size(), values.size());
  for (int k = 0; k < static_cast<int>(values.size()); ++k) out.insert(k, k) = values[k];
  return out;
}

InverseOperator divided_by(const Vector& values) {
  return [values](Matrix& F) { F = (values.cwiseInverse().asDiagonal() * F).eval(); };
}

TEST(InverseIteration, FindsTheLargestInOrder) {
  Vector squares(300);
  for (Eigen::Index k = 0; k < 300; ++k) squares[k] = std::pow(1.0 + static_cast<double>(k), 2);
  const SparseMatrix M = diagonal(Vector::Constant(300, 4.0));
  const auto pairs = largest_inverse_pairs(M, divided_by(squares), Matrix(300, 0), {.count = 12});
  ASSERT_TRUE(pairs.is_complete);
  ASSERT_EQ(pairs.theta.size(), 12);
  for (Eigen::Index k = 0; k < 12; ++k) {
    // The error of θ is the square of that of the vector, 1e-18; rounding of products remains.
    EXPECT_NEAR(pairs.theta[k] * squares[k], 4.0, 1e-12) << k;
    EXPECT_NEAR(std::abs(pairs.shapes(k, k)), 0.5, 1e-8) << k;
  }
  const Matrix identity = pairs.shapes.transpose() * (M * pairs.shapes);
  EXPECT_LE((identity - Matrix::Identity(12, 12)).norm(), 1e-13);
  // Twelve from 300 within less than the 300 solves of a full basis.
  EXPECT_LE(pairs.solves, 240);
}

TEST(InverseIteration, EveryMultiplicityIsComplete) {
  // Seven, two, nineteen and one equal: more than a block of six could find on its own.
  std::vector<double> values;
  values.insert(values.end(), 7, 1.0);
  values.insert(values.end(), 2, 1.5);
  values.insert(values.end(), 19, 2.0);
  values.push_back(2.5);
  while (values.size() < 400) values.push_back(3.0 + 0.1 * static_cast<double>(values.size()));
  const Vector squares = Eigen::Map<Vector>(values.data(), 400);
  const SparseMatrix M = diagonal(Vector::Ones(400));
  for (const int count : {5, 7, 9, 20, 28, 29, 33}) {
    const auto pairs =
        largest_inverse_pairs(M, divided_by(squares), Matrix(400, 0), {.count = count});
    ASSERT_TRUE(pairs.is_complete) << count;
    ASSERT_EQ(pairs.theta.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
      EXPECT_NEAR(pairs.theta[k] * squares[k], 1.0, 1e-12) << count << ": " << k;
    }
  }
}

// What has converged beyond the wanted pairs is not sought again with those that may be missing.
TEST(InverseIteration, AMultiplePairThatIsCutCostsNoMore) {
  constexpr int kBlock = 8;
  Vector squares(600);
  for (Eigen::Index k = 0; k < 600; ++k) squares[k] = std::pow(1.0 + static_cast<double>(k / 3), 2);
  const SparseMatrix M = diagonal(Vector::Ones(600));
  const auto solves = [&](int count) {
    const auto pairs = largest_inverse_pairs(M, divided_by(squares), Matrix(600, 0),
                                             {.count = count, .block = kBlock});
    EXPECT_TRUE(pairs.is_complete);
    return pairs.solves;
  };
  // The seventh of them whole, and cut before its last; a sweep more or less is rounding.
  EXPECT_LE(solves(20), solves(21) + kBlock);
}

TEST(InverseIteration, DeflatedVectorsStayOut) {
  const Vector squares = Vector::LinSpaced(60, 1.0, 60.0);
  const SparseMatrix M = diagonal(Vector::Ones(60));
  Matrix known = Matrix::Zero(60, 2);
  known(0, 0) = known(2, 1) = 1.0;
  const auto pairs = largest_inverse_pairs(M, divided_by(squares), known, {.count = 4});
  ASSERT_EQ(pairs.theta.size(), 4);
  const std::vector<double> expected = {2, 4, 5, 6};
  for (Eigen::Index k = 0; k < 4; ++k) {
    EXPECT_NEAR(pairs.theta[k] * expected[static_cast<std::size_t>(k)], 1.0, 1e-12);
  }
}

TEST(InverseIteration, VariablesWithoutMassHaveNoPairs) {
  Vector masses = Vector::Zero(50);
  masses.head(8).setOnes();
  const Vector squares = Vector::LinSpaced(50, 1.0, 50.0);
  const auto pairs =
      largest_inverse_pairs(diagonal(masses), divided_by(squares), Matrix(50, 0), {.count = 20});
  EXPECT_TRUE(pairs.is_complete);
  ASSERT_EQ(pairs.theta.size(), 8);
  for (Eigen::Index k = 0; k < 8; ++k) EXPECT_NEAR(pairs.theta[k] * squares[k], 1.0, 1e-12);
}

TEST(InverseIteration, NegativeOnesCountByMagnitude) {
  Vector squares = Vector::LinSpaced(80, 1.0, 80.0);
  squares[1] = -2.0;
  const SparseMatrix M = diagonal(Vector::Ones(80));
  const auto pairs = largest_inverse_pairs(M, divided_by(squares), Matrix(80, 0), {.count = 3});
  ASSERT_EQ(pairs.theta.size(), 3);
  EXPECT_NEAR(pairs.theta[1], -0.5, 1e-12);
}

TEST(InverseIteration, ReportsWhatDidNotConverge) {
  const Vector squares = Vector::LinSpaced(2000, 1.0, 1.001);
  const SparseMatrix M = diagonal(Vector::Ones(2000));
  const auto pairs =
      largest_inverse_pairs(M, divided_by(squares), Matrix(2000, 0), {.count = 5, .max_sweeps = 6});
  EXPECT_FALSE(pairs.is_complete);
}

// Where all pairs are of almost one size, as over a shift far above the lowest ω², the first sweeps
// know little of the largest.
TEST(InverseIteration, IsJudgedMoreThanOnce) {
  const Vector squares = Vector::LinSpaced(2000, 1.0, 1.001);
  const SparseMatrix M = diagonal(Vector::Ones(2000));
  std::vector<double> seen;
  InverseIterationSettings settings{.count = 5};
  settings.is_worthwhile = [&](double theta) {
    seen.push_back(1.0 - theta);
    return seen.size() < 4;
  };
  const auto pairs = largest_inverse_pairs(M, divided_by(squares), Matrix(2000, 0), settings);
  EXPECT_FALSE(pairs.is_complete);
  EXPECT_EQ(pairs.sweeps, 16);
  ASSERT_EQ(seen.size(), 4U);
  // Ritz values of nested spaces.
  for (std::size_t k = 1; k < seen.size(); ++k) EXPECT_LT(seen[k], seen[k - 1]);
}

}  // namespace
}  // namespace buckens::linalg
