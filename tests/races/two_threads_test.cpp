// SPDX-License-Identifier: Apache-2.0
// One factor made and read by two threads, small enough for the thread sanitizer. That it gives the
// right numbers is shown by linalg/test/panel_factor_test.cpp.
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/task_pool.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::linalg {
namespace {

/// n³ nodes with three variables each, all of which are coupled with those of the 26 neighbours.
SparseMatrix grid(int n) {
  std::vector<Triplet> entries;
  const auto add_block = [&](int a, int b, double value) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) entries.emplace_back(3 * a + r, 3 * b + c, r == c ? value : 0.1);
    }
  };
  const auto inside = [n](int i) { return i >= 0 && i < n; };
  for (int node = 0; node < n * n * n; ++node) {
    const std::array<int, 3> at = {node % n, node / n % n, node / n / n};
    add_block(node, node, 100.0);  // dominates its row: definite
    for (int d = 0; d < 27; ++d) {
      const std::array<int, 3> to = {at[0] + d % 3 - 1, at[1] + d / 3 % 3 - 1, at[2] + d / 9 - 1};
      if (d == 13 || !inside(to[0]) || !inside(to[1]) || !inside(to[2])) continue;
      add_block(node, to[0] + n * (to[1] + n * to[2]), -1.0);
    }
  }
  SparseMatrix A(3 * n * n * n, 3 * n * n * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

TEST(TwoThreads, ReadOneFactor) {
  const SparseMatrix A = grid(5);
  const SparseCholesky factor(A, {SolveRoute::panels});
  const Matrix B = Matrix::Ones(A.rows(), 4);
  const Matrix expected = factor.solve(B);
  Matrix found(B.rows(), B.cols());
  TaskPool pool(2);
  for (int round = 0; round < 3; ++round) {
    pool.run(2, [&](int k) { found.middleCols(2 * k, 2) = factor.solve(B.middleCols(2 * k, 2)); });
    EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-15);  // of answers of size 0.01
  }
}

TEST(TwoThreads, SolveTogether) {
  const SparseMatrix A = grid(12);  // large enough for parts, and for panels that are shared
  const SparseCholesky factor(A, {SolveRoute::panels});
  ASSERT_GE(factor.num_parts(), 2);
  const Matrix B = Matrix::Ones(A.rows(), 4);
  TaskPool pool(2);
  EXPECT_EQ(factor.solve(B, &pool), factor.solve(B));
  EXPECT_EQ(factor.solve(B.leftCols(1), &pool), factor.solve(B.leftCols(1)));
}

TEST(TwoThreads, MakeOneFactor) {
  const SparseMatrix A = grid(8);
  const Matrix B = Matrix::Ones(A.rows(), 1);
  const Matrix alone = SparseCholesky(A).solve(B);
  const base::AllowedThreads two(2);
  EXPECT_EQ(SparseCholesky(A).solve(B), alone);
}

}  // namespace
}  // namespace buckens::linalg
