// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/least_norm.h"

#include <random>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "buckens/linalg/sparse_qr.h"

namespace buckens::linalg {
namespace {

/// A chain of equations between neighbours, of which every `repeat`-th appears twice, the second
/// time mixed with the one before.
SparseMatrix chain(int unknowns, int repeat) {
  std::vector<Triplet> entries;
  int row = 0;
  const auto say = [&](int k, double factor) {
    entries.emplace_back(row, k, factor * (2.0 + 0.1 * (k % 7)));
    entries.emplace_back(row, k + 2, -factor);
  };
  for (int k = 0; k + 2 < unknowns; ++k) {
    say(k, 1.0);
    ++row;
    if (k == 0 || k % repeat != 0) continue;
    say(k, 3.0);
    say(k - 1, -0.5);
    ++row;
  }
  SparseMatrix A(row, unknowns);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

Vector numbers(Eigen::Index count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> any(-1, 1);
  Vector out(count);
  for (double& x : out) x = any(engine);
  return out;
}

TEST(LeastNorm, IsThatOfACompleteOrthogonalDecomposition) {
  const SparseMatrix A = chain(60, 4);
  ASSERT_GT(A.rows(), A.cols());
  const Vector b = A * numbers(A.cols());
  const Vector x = least_norm_solution(A, b, 1e-9);
  const Vector expected = Matrix(A).completeOrthogonalDecomposition().solve(b);
  // Both by orthogonal transformations of a well-conditioned matrix.
  EXPECT_LT((x - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT((A * x - b).norm(), 1e-13 * b.norm());
}

TEST(LeastNorm, TakesManyEquationsAndRowsWithoutEntries) {
  SparseMatrix A = chain(20000, 5);
  A.conservativeResize(A.rows() + 3, A.cols() + 2);
  const Vector some = numbers(A.cols());
  const Vector x = least_norm_solution(A, A * some, 1e-9);
  EXPECT_LT((A * (x - some)).norm(), 1e-12 * (A * some).norm());
  EXPECT_LT(std::abs(x.dot(some - x)), 1e-12 * some.squaredNorm()) << "nothing can be left out";
  EXPECT_EQ(x.tail(2).norm(), 0.0);
}

TEST(SparseQr, RoutesAgree) {
  const SparseMatrix A = chain(400, 5).transpose();
  const Vector b = A.transpose() * numbers(A.rows());
  const Vector x = least_norm(A, b, 1e-9);
  EXPECT_LT((least_norm_by_eigen(A, b, 1e-9) - x).norm(), 1e-12 * x.norm());
  const RowRank found = split_columns(A, 1e-9);
  const RowRank other = split_columns_by_eigen(A, 1e-9);
  EXPECT_EQ(found.independent.size(), other.independent.size());
  EXPECT_EQ(other.independent.size() + other.dependent.size(), static_cast<std::size_t>(A.cols()));
  Matrix kept(A.rows(), static_cast<Eigen::Index>(other.independent.size()));
  for (Eigen::Index k = 0; k < kept.cols(); ++k) {
    kept.col(k) = A.col(other.independent[static_cast<std::size_t>(k)]);
  }
  EXPECT_EQ(kept.colPivHouseholderQr().rank(), kept.cols()) << "independent indeed";
}

TEST(LeastNorm, OfNothingIsNothing) {
  EXPECT_EQ(least_norm_solution(SparseMatrix(0, 3), Vector(0), 1e-9), Vector::Zero(3));
  EXPECT_EQ(least_norm_solution(SparseMatrix(4, 0), Vector::Zero(4), 1e-9).size(), 0);
}

}  // namespace
}  // namespace buckens::linalg
