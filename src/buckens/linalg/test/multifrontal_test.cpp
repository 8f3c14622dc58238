// SPDX-License-Identifier: Apache-2.0
// The factor against the matrix, with several threads against one.
#include "buckens/linalg/multifrontal.h"

#include <mutex>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "buckens/base/task_pool.h"
#include "buckens/linalg/factor_threads.h"
#include "buckens/linalg/front.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

std::size_t slot(int k) { return static_cast<std::size_t>(k); }

/// L as a full matrix.
Matrix factor_of(const SparseMatrix& A, const SupernodeTree& tree, TaskPool* pool) {
  Matrix L = Matrix::Zero(A.rows(), A.cols());
  std::mutex turn;
  factorise_fronts(
      A, tree,
      [&](int s, int begin, int end, const double* corner, std::ptrdiff_t stride) {
        const std::scoped_lock lock(turn);
        const int first = tree.first_column[slot(s)];
        const int own = tree.columns(s);
        for (int c = begin; c < end; ++c) {
          const double* values = corner + (c - begin) * stride;
          for (int i = c; i < own + tree.rows_below(s); ++i) {
            const int row = i < own ? first + i : tree.rows_of(s)[i - own];
            L(row, first + c) = values[i - begin];
          }
        }
      },
      pool);
  return L;
}

Matrix permuted(const SparseMatrix& A, const std::vector<int>& permutation) {
  const Matrix full(A);
  return full(permutation, permutation);
}

TEST(Multifrontal, GivesTheFactorOfTheMatrix) {
  // The dense one has tiles inside a front and a last block that is not whole.
  for (const SparseMatrix& A : {matrices::grid(6, 0.1), matrices::random_definite(500, 3),
                                matrices::dense_definite(1100), matrices::diagonal(9)}) {
    const SupernodeTree tree = find_supernode_tree(A);
    const Matrix L = factor_of(A, tree, nullptr);
    const Matrix PAP = permuted(A, tree.permutation);
    // Rounding of sums of at most 1100 products.
    EXPECT_LE((L * L.transpose() - PAP).norm(), 1e-14 * PAP.norm()) << A.rows();
    EXPECT_GT(L.diagonal().minCoeff(), 0.0);
  }
}

TEST(Multifrontal, DoesNotDependOnTheNumberOfThreads) {
  for (const SparseMatrix& A : {matrices::grid(9, 0.1), matrices::dense_definite(1100)}) {
    const SupernodeTree tree = find_supernode_tree(A);
    const Matrix alone = factor_of(A, tree, nullptr);
    for (const int threads : {1, 2, 3, 8}) {
      TaskPool pool(threads);
      ASSERT_EQ(factor_of(A, tree, &pool), alone) << threads;
    }
  }
}

TEST(Multifrontal, SharesAFactorAmongTheThreadsAllowed) {
  const SparseMatrix A = matrices::grid(13, 0.1);
  const Matrix B = Matrix::Ones(A.rows(), 2);
  const Matrix alone = SparseCholesky(A).solve(B);
  EXPECT_EQ(FactorThreads::allowed(), 1);
  {
    const FactorThreads four(4);
    EXPECT_EQ(SparseCholesky(A).solve(B), alone);
    {
      const FactorThreads two(2);
      EXPECT_EQ(FactorThreads::allowed(), 2);
    }
    EXPECT_EQ(FactorThreads::allowed(), 4);
  }
  EXPECT_EQ(FactorThreads::allowed(), 1);
}

TEST(Multifrontal, NamesTheSameColumnWithAnyNumberOfThreads) {
  SparseMatrix A = matrices::grid(9, 0.1);
  for (const int column : {100, 700, 1500}) A.coeffRef(column, column) = -5.0;  // apart
  const SupernodeTree tree = find_supernode_tree(A);
  const auto named = [&](TaskPool* pool) -> Eigen::Index {
    try {
      factor_of(A, tree, pool);
    } catch (const IndefiniteMatrix& error) {
      return error.column();
    }
    return -1;
  };
  TaskPool two(2), five(5);
  const Eigen::Index alone = named(nullptr);
  EXPECT_TRUE(alone == 100 || alone == 700 || alone == 1500) << alone;
  EXPECT_EQ(named(&two), alone);
  EXPECT_EQ(named(&five), alone);
}

TEST(Multifrontal, FindsAPivotThatIsNone) {
  for (const int column : {3, 299, 500, 599}) {
    SparseMatrix A = matrices::dense_definite(600);
    A.coeffRef(column, column) = -1.0;
    EXPECT_THROW(factor_of(A, find_supernode_tree(A), nullptr), IndefiniteMatrix) << column;
    TaskPool pool(3);  // threads that wait for the diagonal go on
    EXPECT_THROW(factor_of(A, find_supernode_tree(A), &pool), IndefiniteMatrix) << column;
  }
  SparseMatrix zero(3, 3);
  EXPECT_THROW(factor_of(zero, find_supernode_tree(zero), nullptr), IndefiniteMatrix);
}

TEST(Trapezoid, HasEveryEntryOfTheLowerPartOnce) {
  for (const Trapezoid shape : {Trapezoid{1400, 1200}, Trapezoid{512, 512}, Trapezoid{5, 2}}) {
    std::vector<double> values(static_cast<std::size_t>(shape.size()), 0.0);
    for (int j = 0; j < shape.columns; ++j) {
      const int top = j / Trapezoid::kBlock * Trapezoid::kBlock;
      for (int i = top; i < shape.rows; ++i) shape.column(values.data(), j)[i] += 1.0;
    }
    for (const double value : values) ASSERT_EQ(value, 1.0);
  }
}

}  // namespace
}  // namespace buckens::linalg
