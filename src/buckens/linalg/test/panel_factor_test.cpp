// SPDX-License-Identifier: Apache-2.0
// Solves over panels against CHOLMOD's own and against the matrix.
#include "buckens/linalg/panel_factor.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/base/test/allocation_count.h"
#include "buckens/linalg/blas_kernels.h"
#include "buckens/linalg/gpl_parts.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

using matrices::dense_definite;
using matrices::diagonal;
using matrices::grid;
using matrices::random_definite;

struct Case {
  std::string name;
  SparseMatrix A;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"grid of 1029", grid(7, 0.1)},
      {"soft grid of 3000", grid(10, 1e-6)},
      {"random", random_definite(700, 3)},
      {"dense, several panels", dense_definite(300)},
      {"dense, one panel and a column", dense_definite(129)},
      {"diagonal", diagonal(50)},
      {"one", diagonal(1)},
      {"seven", dense_definite(7)},
  };
  return all;
}

double residual(const SparseMatrix& A, const Matrix& X, const Matrix& B) {
  // Relative to |A| |X|: the measure in which a stable solve stays at rounding.
  return (A * X - B).norm() / (A.norm() * X.norm() + B.norm());
}

std::vector<SimdLevel> levels_here() {
  std::vector<SimdLevel> levels = {SimdLevel::portable};
  if (best_simd_level() >= SimdLevel::avx2) levels.push_back(SimdLevel::avx2);
  if (best_simd_level() >= SimdLevel::avx512) levels.push_back(SimdLevel::avx512);
  return levels;
}

TEST(PanelFactor, LeavesResidualsAsSmallAsCholmod) {
  if (!has_gpl_parts()) GTEST_SKIP() << "no CHOLMOD to compare with";
  for (const Case& problem : cases()) {
    const SparseCholesky reference(problem.A, {SolveRoute::cholmod});
    ASSERT_EQ(reference.route(), SolveRoute::cholmod);
    for (const SimdLevel level : levels_here()) {
      const SparseCholesky factor(problem.A, {SolveRoute::panels, level});
      ASSERT_EQ(factor.route(), SolveRoute::panels);
      for (const Eigen::Index sides : {1, 2, 3, 5, 6, 8, 12, 32, 33}) {
        const Matrix B = scattered_block(problem.A.rows(), sides, 11);
        const Matrix X = factor.solve(B);
        // Rounding of different sums: a few times CHOLMOD's, which may be zero by luck.
        EXPECT_LE(residual(problem.A, X, B),
                  4.0 * residual(problem.A, reference.solve(B), B) + 2e-16)
            << problem.name << ", " << to_string(level) << ", " << sides;
      }
    }
  }
}

TEST(PanelFactor, SolvesAsADenseFactor) {
  for (const Case& problem : cases()) {
    if (problem.A.rows() > 1100) continue;
    const SparseCholesky factor(problem.A, {SolveRoute::panels});
    const Matrix B = scattered_block(problem.A.rows(), 3, 2);
    const Matrix expected = Matrix(problem.A).llt().solve(B);
    // Rounding times the condition, below 1e5 in all of these.
    EXPECT_LE((factor.solve(B) - expected).norm(), 1e-11 * expected.norm()) << problem.name;
    Vector x = B.col(1);
    factor.solve_in_place(x);
    EXPECT_LE((x - expected.col(1)).norm(), 1e-11 * expected.norm()) << problem.name;
    Matrix X = B;
    factor.solve_in_place(X);
    EXPECT_EQ(X, factor.solve(B)) << problem.name;
  }
}

TEST(PanelFactor, DoesNotDependOnTheNumberOfThreads) {
  const SparseMatrix A = grid(16, 0.1);  // 12288 variables: groups below groups, and shared panels
  const SparseCholesky factor(A, {SolveRoute::panels});
  ASSERT_GE(factor.num_parts(), 5);
  TaskPool one(1), two(2), three(3), four(4), eight(8);
  for (const Eigen::Index sides : {1, 6, 32}) {
    const Matrix B = scattered_block(A.rows(), sides, 4);
    const Matrix alone = factor.solve(B);
    EXPECT_LE(residual(A, alone, B), 1e-15);
    for (TaskPool* pool : {&one, &two, &three, &four, &eight}) {
      for (int round = 0; round < 5; ++round) {
        ASSERT_EQ(factor.solve(B, pool), alone) << sides << ", " << pool->threads();
      }
    }
  }
}

TEST(PanelFactor, SolvesAColumnAlikeWhateverStandsBesideIt) {
  const SparseMatrix A = grid(10, 0.1);
  const Matrix B = scattered_block(A.rows(), 32, 5);
  for (const SimdLevel level : levels_here()) {
    const SparseCholesky factor(A, {SolveRoute::panels, level});
    const Matrix all = factor.solve(B);
    // One alone is summed in another order, in which memory is read at its full speed.
    for (const Eigen::Index sides : {2, 4, 6, 8, 12, 20, 31}) {
      const Matrix some = factor.solve(B.leftCols(sides));
      EXPECT_EQ(some, all.leftCols(sides)) << to_string(level) << ", " << sides;
    }
  }
}

TEST(PanelFactor, SharesReadingAmongThreads) {
  const SparseCholesky factor(grid(16, 0.1), {SolveRoute::panels});
  EXPECT_EQ(factor.busiest_share(1), 1.0);
  // The halves of this cube differ a little; its top is shared.
  EXPECT_LE(factor.busiest_share(2), 0.53);
  EXPECT_LE(factor.busiest_share(4), 0.30);
  for (const int threads : {2, 3, 4, 8}) EXPECT_GE(factor.busiest_share(threads), 1.0 / threads);
}

TEST(PanelFactor, SharesAFactorBetweenCallers) {
  const SparseMatrix A = grid(7, 0.1);
  const SparseCholesky factor(A, {SolveRoute::panels});
  const Matrix B = scattered_block(A.rows(), 8, 3);
  Matrix expected(B.rows(), B.cols());
  for (Eigen::Index k = 0; k < B.cols(); ++k) expected.col(k) = factor.solve(B.col(k));
  Matrix found(B.rows(), B.cols());
  TaskPool pool(4);
  for (int round = 0; round < 20; ++round) {
    pool.run(8, [&](int k) { found.col(k) = factor.solve(B.col(k)); });
    ASSERT_EQ(found, expected);
  }
}

TEST(PanelFactor, RepeatedSolvesAllocateNothing) {
  if (!test::kCountsAllocations) GTEST_SKIP() << "malloc belongs to a sanitizer";
  const SparseMatrix A = grid(13, 0.1);
  TaskPool pool(2);
  const SparseCholesky factor(A, {SolveRoute::panels});
  Vector x = Vector::Ones(A.rows());
  Matrix X = scattered_block(A.rows(), 6, 3);
  EXPECT_GT(test::count_allocations([&] { factor.solve_in_place(X, &pool); }), 0);
  EXPECT_EQ(test::count_allocations([&] {
              for (int k = 0; k < 3; ++k) {
                factor.solve_in_place(x, &pool);
                factor.solve_in_place(X, &pool);
              }
            }),
            0);
}

TEST(PanelFactor, SaysWhichMatrixIsNotDefinite) {
  SparseMatrix A = grid(13, 0.1);
  A.coeffRef(1234, 1234) = -5.0;
  const auto message = [&A](SolveRoute route) -> std::string {
    try {
      const SparseCholesky factor(A, {route});
    } catch (const NumericalError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message(SolveRoute::panels),
              testing::HasSubstr("a matrix of size 6591 is not positive definite (column 1234)"));
  if (!has_gpl_parts()) return;
  EXPECT_EQ(message(SolveRoute::panels), message(SolveRoute::cholmod));
}

TEST(PanelFactor, ReadsFewerBytesThanCholmod) {
  if (!has_gpl_parts()) GTEST_SKIP() << "no CHOLMOD to compare with";
  const SparseMatrix A = grid(13, 0.1);
  const SparseCholesky panels(A, {SolveRoute::panels});
  const SparseCholesky cholmod(A, {SolveRoute::cholmod});
  // Orders by METIS alone and by the better of METIS and CHOLMOD's own dissection.
  EXPECT_LE(panels.num_factor_entries(), 1.1 * cholmod.num_factor_entries());
  EXPECT_GE(panels.bytes(), 8.0 * panels.num_factor_entries());
  EXPECT_LT(panels.bytes(), cholmod.bytes());
}

TEST(PanelFactor, LetsTheMemoryOfItsSourceGoAsItReads) {
  const int n = 1100;  // one supernode of 10 MB: more than is given up at a time
  const auto make = [n](bool used_up) {
    Matrix L = Matrix(dense_definite(n)).llt().matrixL();
    std::vector<int> permutation(static_cast<std::size_t>(n));
    std::iota(permutation.begin(), permutation.end(), 0);
    const std::array<int, 2> columns = {0, n};
    const std::array<std::int64_t, 2> begin = {0, n}, values = {0, 0};
    Supernodes source;
    source.size = n;
    source.count = 1;
    source.permutation = source.rows = permutation.data();
    source.first_column = columns.data();
    source.rows_begin = begin.data();
    source.values_begin = values.data();
    source.values = L.data();
    source.used_up = used_up;
    const PanelFactor factor(source);
    const Matrix B = scattered_block(n, 3, 2);
    Matrix X(n, 3);
    PanelFactor::Workspace work;
    factor.solve(B.data(), X.data(), 3, n, work, nullptr);
    return std::pair{X, L.diagonal().cwiseAbs().minCoeff()};
  };
  const auto [kept, kept_pivot] = make(false);
  const auto [given, given_pivot] = make(true);
  EXPECT_EQ(kept, given);
  EXPECT_GT(kept_pivot, 0.0);
#if defined(__linux__)
  EXPECT_EQ(given_pivot, 0.0);  // pages that were given back read as zeros
#endif
}

TEST(SparseCholesky, TakesPanelsInPlaceOfCholmodsSupernodes) {
  if (!has_gpl_parts()) GTEST_SKIP() << "no CHOLMOD to compare with";
  const SparseMatrix A = grid(12, 1e-3);
  const Matrix B = scattered_block(A.rows(), 3, 4);
  SparseCholesky solver(A, {SolveRoute::cholmod});
  const Matrix before = solver.solve(B);
  ASSERT_TRUE(solver.take_panels());
  EXPECT_EQ(solver.route(), SolveRoute::panels);
  EXPECT_TRUE(solver.take_panels());  // has them
  // Rounding times the condition of the matrix, some 1e4.
  EXPECT_LE((solver.solve(B) - before).norm(), 1e-11 * before.norm());

  SparseMatrix line(50, 50);  // too sparse for supernodes
  for (int k = 0; k < 50; ++k) line.insert(k, k) = 2.0 + k;
  line.makeCompressed();
  SparseCholesky sparse(line, {SolveRoute::cholmod});
  EXPECT_FALSE(sparse.take_panels());
  EXPECT_EQ(sparse.route(), SolveRoute::cholmod);
}

TEST(SparseCholesky, SolvesVectorsThatLieAnywhere) {
  const SparseMatrix A = grid(8, 1e-3);
  const Matrix B = scattered_block(A.rows(), 40, 4);
  for (const SolveRoute route : {SolveRoute::panels, SolveRoute::cholmod}) {
    if (route == SolveRoute::cholmod && !has_gpl_parts()) continue;
    const SparseCholesky solver(A, {route});
    for (const Eigen::Index count : {0, 1, 6, 40}) {  // 40: more than pass through at once
      Matrix X = B;
      std::vector<double*> vectors;
      for (Eigen::Index k = 0; k < count; ++k) vectors.push_back(X.col(39 - k).data());
      solver.solve_in_place(vectors);
      const Matrix expected = solver.solve(B.rightCols(count));
      // CHOLMOD sums one column in another order than several.
      EXPECT_LE((X.rightCols(count) - expected).norm(), 1e-12 * expected.norm()) << count;
      EXPECT_EQ(X.leftCols(40 - count), B.leftCols(40 - count));
    }
  }
}

TEST(BlasKernels, FitTheProcessor) {
  choose_blas_kernels();
  if (best_simd_level() == SimdLevel::portable || std::getenv("OPENBLAS_CORETYPE") != nullptr) {
    GTEST_SKIP() << "nothing to choose";
  }
  EXPECT_NE(blas_kernels(), "Prescott");
  // The setting for the choice is restored.
  EXPECT_EQ(std::getenv("OPENBLAS_CORETYPE"), nullptr);
}

}  // namespace
}  // namespace buckens::linalg
