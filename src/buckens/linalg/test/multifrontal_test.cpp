// SPDX-License-Identifier: Apache-2.0
// The factor against the matrix, with several threads against one.
#include "buckens/linalg/multifrontal.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/task_pool.h"
#include "buckens/linalg/front.h"
#include "buckens/linalg/front_plan.h"
#include "buckens/linalg/predicted_factor.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/test/definite_matrices.h"
#include "buckens/linalg/top_fronts.h"

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

/// L by supernodes: its columns one after the other, from the diagonal down.
struct SparseL {
  const SupernodeTree* tree;
  std::vector<std::vector<double>> columns;  // per column of L
  double most;                               // bytes of finished columns and fronts

  Vector times(const Vector& x) const {
    Vector y = Vector::Zero(tree->size);
    visit([&](int row, int column, double value) { y[row] += value * x[column]; });
    return y;
  }
  Vector transposed_times(const Vector& x) const {
    Vector y = Vector::Zero(tree->size);
    visit([&](int row, int column, double value) { y[column] += value * x[row]; });
    return y;
  }
  double bytes() const {
    double sum = 0;
    for (const auto& column : columns) sum += sizeof(double) * static_cast<double>(column.size());
    return sum;
  }

 private:
  template <class F>
  void visit(F&& f) const {
    for (int s = 0; s < tree->count; ++s) {
      const int first = tree->first_column[slot(s)];
      for (int c = 0; c < tree->columns(s); ++c) {
        const std::vector<double>& values = columns[slot(first + c)];
        for (int i = c; i < tree->columns(s) + tree->rows_below(s); ++i) {
          const int below = i - tree->columns(s);
          f(below < 0 ? first + i : tree->rows_of(s)[below], first + c, values[slot(i - c)]);
        }
      }
    }
  }
};

SparseL sparse_factor_of(const SparseMatrix& A, const SupernodeTree& tree, TaskPool* pool) {
  SparseL L{&tree, std::vector<std::vector<double>>(slot(tree.size)), 0.0};
  L.most = factorise_fronts(
      A, tree,
      [&](int s, int begin, int end, const double* corner, std::ptrdiff_t stride) {
        const int rows = tree.columns(s) + tree.rows_below(s);
        for (int c = begin; c < end; ++c) {
          const double* values = corner + (c - begin) * stride;
          L.columns[slot(tree.first_column[slot(s)] + c)].assign(values + (c - begin),
                                                                 values + (rows - begin));
        }
      },
      pool);
  return L;
}

/// Bytes of finished columns and fronts where every front leaves a rest, and takes those of its
/// children.
double bytes_with_rests(const SupernodeTree& tree) {
  std::vector<double> waiting(slot(tree.count));
  double used = 0, most = 0, finished = 0;
  for (int s = 0; s < tree.count; ++s) {
    const Front front(tree.columns(s), tree.rows_below(s));
    const double rest = 8.0 * static_cast<double>(front.rest_size());
    finished += 8.0 * tree.columns(s) * (tree.rows_below(s) + 0.5 * tree.columns(s));
    most = std::max(most, finished + used + 8.0 * static_cast<double>(front.own_size()) + rest);
    used += rest - waiting[slot(s)];
    if (tree.parent[slot(s)] >= 0) waiting[slot(tree.parent[slot(s)])] += rest;
  }
  return most;
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

// Top fronts at three levels of the tree, of which some have several blocks, and sums from all
// levels.
void expect_three_levels(const SupernodeTree& tree) {
  const FrontPlan plan(tree, 1);
  int levels = 0, blocks = 0;
  for (int s = 0; s < tree.count; ++s) {
    if (!plan.is_top(s)) continue;
    int level = 1;
    for (int p = tree.parent[slot(s)]; p >= 0; p = tree.parent[slot(p)]) {
      EXPECT_TRUE(plan.is_top(p));
      ++level;
    }
    levels = std::max(levels, level);
    blocks = std::max(blocks, Front(tree.columns(s), 0).own().blocks());
    for (const int child : plan.waiting(s)) EXPECT_FALSE(plan.is_top(child));
    EXPECT_TRUE(FrontPlan(tree, 16).is_top(s));
  }
  EXPECT_GE(levels, 3);
  EXPECT_GT(blocks, TopFronts::kBlocks);
}

TEST(LargeGrid, GivesTheSameFactorInLittleMemory) {
  // Smaller ones need less memory than this, but more of it for fronts.
  const SparseMatrix A = matrices::grid(22, 0.1);
  const SupernodeTree tree = find_supernode_tree(A);
  expect_three_levels(tree);
  const SparseL alone = sparse_factor_of(A, tree, nullptr);
  const Vector x = scattered_block(tree.size, 1, 11).col(0);
  Vector permuted_x(tree.size), expected(tree.size);
  for (int k = 0; k < tree.size; ++k) permuted_x[tree.permutation[slot(k)]] = x[k];
  const Vector Ax = A * permuted_x;
  for (int k = 0; k < tree.size; ++k) expected[k] = Ax[tree.permutation[slot(k)]];
  const Vector product = alone.times(alone.transposed_times(x));
  // Rounding of sums of at most some thousand products.
  EXPECT_LE((product - expected).norm(), 1e-14 * expected.norm());

  // The rests of the subtrees below top fronts, and a group of blocks.
  EXPECT_LE(alone.most, 1.2 * alone.bytes());
  EXPECT_LE(alone.most, predict_factor(A).peak);
  EXPECT_GE(alone.most, 0.9 * predict_factor(A).peak);
  EXPECT_GE(bytes_with_rests(tree) - alone.bytes(), 2.0 * (alone.most - alone.bytes()));
  for (const int threads : {2, 3}) {
    TaskPool pool(threads);
    const SparseL L = sparse_factor_of(A, tree, &pool);
    ASSERT_TRUE(L.columns == alone.columns) << threads;
  }
}

TEST(LargeGrid, NamesTheFirstColumnThatFails) {
  SparseMatrix A = matrices::grid(18, 0.1);
  const SupernodeTree tree = find_supernode_tree(A);
  expect_three_levels(tree);
  const auto forget = [](int, int, int, const double*, std::ptrdiff_t) {};
  // Of the three last top fronts, in columns of their first, second and last blocks.
  Eigen::Index first = -1;
  for (const int behind : {1, 2, 3}) {
    const int s = tree.count - behind;
    const int c = tree.first_column[slot(s)] + tree.columns(s) * behind / 4;
    first = tree.permutation[slot(c)];
    A.coeffRef(first, first) = -1e3;
    for (const int threads : {1, 2, 3}) {
      TaskPool pool(threads);
      try {
        factorise_fronts(A, tree, forget, &pool);
        FAIL();
      } catch (const IndefiniteMatrix& error) {
        EXPECT_EQ(error.column(), first) << behind << " " << threads;
      }
    }
  }
}

TEST(Multifrontal, SharesAFactorAmongTheThreadsAllowed) {
  const SparseMatrix A = matrices::grid(13, 0.1);
  const Matrix B = Matrix::Ones(A.rows(), 2);
  const Matrix alone = SparseCholesky(A).solve(B);
  EXPECT_EQ(base::AllowedThreads::count(), 1);
  {
    const base::AllowedThreads four(4);
    EXPECT_EQ(SparseCholesky(A).solve(B), alone);
    {
      const base::AllowedThreads two(2);
      EXPECT_EQ(base::AllowedThreads::count(), 2);
    }
    EXPECT_EQ(base::AllowedThreads::count(), 4);
  }
  EXPECT_EQ(base::AllowedThreads::count(), 1);
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
