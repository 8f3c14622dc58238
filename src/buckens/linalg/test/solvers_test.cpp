// SPDX-License-Identifier: Apache-2.0
// Sparse solvers against dense ones.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "buckens/base/errors.h"
#include "buckens/base/sanitizers.h"
#include "buckens/linalg/conjugate_gradients.h"
#include "buckens/linalg/gpl_parts.h"
#include "buckens/linalg/row_rank.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/sparse_lu.h"

namespace buckens::linalg {
namespace {

constexpr int kColumns = 40;

/// Symmetric, diagonally dominant, condition below 100.
SparseMatrix definite(int n = kColumns) {
  std::vector<Triplet> entries;
  for (int k = 0; k < n; ++k) {
    entries.emplace_back(k, k, 4.0 + k % 5);
    for (const int other : {(k + 1) % n, (k + 7) % n}) {
      entries.emplace_back(k, other, -0.9);
      entries.emplace_back(other, k, -0.9);
    }
  }
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

Matrix right_sides(Eigen::Index n, Eigen::Index count) {
  Matrix B(n, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) {
      B(i, j) = std::sin(1.0 + static_cast<double>(3 * i + (i + 2) * (j + 1) * (j + 1)));
    }
  }
  return B;
}

TEST(SparseCholesky, SolvesAsADenseFactor) {
  const SparseMatrix A = definite();
  const SparseCholesky factor(A);
  const Matrix B = right_sides(kColumns, 5);
  const Matrix expected = Matrix(A).ldlt().solve(B);
  EXPECT_LE((factor.solve(B) - expected).norm(), 1e-13 * expected.norm());
  Vector x = B.col(2);
  factor.solve_in_place(x);
  EXPECT_LE((x - expected.col(2)).norm(), 1e-13 * expected.norm());
  EXPECT_EQ(factor.size(), kColumns);
  EXPECT_GE(factor.num_factor_entries(), 0.5 * static_cast<double>(A.nonZeros()));
}

TEST(SparseCholesky, MovesWithItsFactor) {
  SparseCholesky first(definite());
  const SparseCholesky second(std::move(first));
  Vector x = Vector::Ones(kColumns);
  second.solve_in_place(x);
  EXPECT_LE((definite() * x - Vector::Ones(kColumns)).norm(), 1e-13);
}

TEST(SparseCholesky, RefusesAnIndefiniteMatrix) {
  SparseMatrix A = definite();
  A.coeffRef(17, 17) = -5.0;
  EXPECT_THROW(SparseCholesky{A}, NumericalError);
  SparseMatrix large = definite(5000);  // ordered by dissection
  large.coeffRef(1234, 1234) = -5.0;
  EXPECT_THROW(SparseCholesky{large}, NumericalError);
}

/// What a failed factorisation says.
std::string refusal(const SparseMatrix& A, const CholeskyOptions& options = {}) {
  try {
    const SparseCholesky factor(A, options);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(SparseCholesky, SaysWhereAMatrixIsIndefinite) {
  for (const int n : {kColumns, 5000}) {
    SparseMatrix A = definite(n);
    A.coeffRef(17, 17) = -5.0;
    try {
      const SparseCholesky factor(A);
      FAIL() << n;
    } catch (const IndefiniteMatrix& error) {
      // Its own pivot, or that of a neighbour which is eliminated after it.
      const std::string text = error.what();
      EXPECT_NE(text.find("size " + std::to_string(n) + " is not positive definite"),
                std::string::npos)
          << text;
      EXPECT_NE(text.find("column " + std::to_string(error.column())), std::string::npos) << text;
      EXPECT_EQ(error.column(), 17);
    }
  }
}

TEST(SparseCholesky, SaysWhichEntryIsNotFinite) {
  SparseMatrix A = definite();
  A.coeffRef(9, 8) = std::nan("");
  EXPECT_NE(refusal(A).find("not finite (row 9, column 8"), std::string::npos) << refusal(A);
}

TEST(SparseCholesky, SaysHowMuchMemoryItNeeds) {
#if BUCKENS_IS_SANITIZED
  GTEST_SKIP() << "sanitizers need more address space than the limit";
#endif
  // In a process of its own: what earlier tests have freed would be room within the limit.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  // A full matrix as a sparse one: its factor of 4000²/2 numbers takes 64 MB, and as much again
  // while it is made.
  const int n = 4000;
  SparseMatrix A(n, n);
  A.reserve(Eigen::VectorXi::Constant(n, n));
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) A.insert(i, j) = i == j ? 2.0 * n : 1.0;
  }
  A.makeCompressed();
  const auto in_little_memory = [&] {
    std::ifstream statm("/proc/self/statm");
    rlim_t pages = 0;
    statm >> pages;
    // Room for the factor, not for the front that it is computed in.
    const rlim_t most = pages * 4096 + rlim_t{100} * 1000 * 1000;
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
    std::fputs(refusal(A, {SolveRoute::panels}).c_str(), stderr);
    std::_Exit(0);
  };
  EXPECT_EXIT(in_little_memory(), testing::ExitedWithCode(0),
              "not enough memory to factorise a matrix of size 4000 \\(0\\.06[0-9]+ GB");
}

TEST(SparseCholesky, CountsWiderWhereCholmodNeedsIt) {
  if (!has_gpl_parts()) {
    EXPECT_NE(refusal(definite(), {SolveRoute::cholmod}).find("has no CHOLMOD"), std::string::npos);
    return;
  }
  for (const int n : {kColumns, 5000}) {
    const SparseMatrix A = definite(n);
    const Matrix B = right_sides(n, 3);
    CholeskyOptions options;
    options.route = SolveRoute::cholmod;
    const SparseCholesky narrow(A, options);
    EXPECT_EQ(narrow.index_bits(), 32);
    options.most_narrow_entries = narrow.num_factor_entries() - 1;
    const SparseCholesky wide(A, options);
    EXPECT_EQ(wide.index_bits(), 64);
    EXPECT_EQ(wide.num_factor_entries(), narrow.num_factor_entries());
    EXPECT_EQ(wide.solve(B), narrow.solve(B)) << "the same numbers in the same order";
    EXPECT_EQ(SparseCholesky(A).index_bits(), 64);
  }
}

TEST(SparseLu, FactorisesNewValuesInOnePattern) {
  const SparseMatrix A = definite();
  SparseLu lu(A);
  for (const double shift : {0.0, 1.0, -20.0}) {  // the last is indefinite and needs other pivots
    SparseMatrix B = A;
    for (int k = 0; k < kColumns; ++k) B.coeffRef(k, k) += shift * std::cos(k);
    ASSERT_TRUE(lu.factorise(B));
    EXPECT_GT(lu.pivot_ratio(), 1e-6);
    const Vector b = right_sides(kColumns, 1).col(0);
    Vector x = b;
    lu.solve_in_place(x);
    EXPECT_LE((B * x - b).norm(), 1e-11 * b.norm()) << shift;
  }
}

TEST(SparseLu, TellsASingularMatrixAndRecovers) {
  const SparseMatrix A = definite();
  SparseLu lu(A);
  SparseMatrix singular = A;
  for (int k = 0; k < singular.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(singular, k); it; ++it) {
      if (it.row() == 9 || it.col() == 9) it.valueRef() = 0.0;
    }
  }
  EXPECT_FALSE(lu.factorise(singular));
  EXPECT_TRUE(lu.factorise(A));
}

TEST(ConjugateGradients, SolveAsADenseFactor) {
  const SparseMatrix A = definite();
  const Vector b = right_sides(kColumns, 1).col(0);
  const Vector expected = Matrix(A).ldlt().solve(b);
  // Residual 1e-14 |b| times the condition.
  EXPECT_LE((conjugate_gradients(A, b) - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(conjugate_gradients(A, Vector::Zero(kColumns)).norm(), 0.0);
}

TEST(ConjugateGradients, RefuseWhatIsNoNumber) {
  const SparseMatrix A = definite();
  for (const double value : {std::nan(""), HUGE_VAL, 1e200}) {  // the last overflows when squared
    Vector b = Vector::Ones(kColumns);
    b[3] = value;
    try {
      conjugate_gradients(A, b);
      FAIL() << value;
    } catch (const NumericalError& error) {
      EXPECT_NE(std::string(error.what()).find("not finite"), std::string::npos) << error.what();
    }
  }
}

TEST(ConjugateGradients, LeaveMasslessRowsOut) {
  const SparseMatrix small = definite(20);
  std::vector<Triplet> entries;
  for (int k = 0; k < small.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator it(small, k); it; ++it) {
      entries.emplace_back(static_cast<int>(it.row()) + 1, static_cast<int>(it.col()) + 1,
                           it.value());
    }
  }
  SparseMatrix A(22, 22);
  A.setFromTriplets(entries.begin(), entries.end());
  const Vector b = right_sides(22, 1).col(0);
  const Vector x = conjugate_gradients(A, b);
  EXPECT_EQ(x[0], 0.0);
  EXPECT_EQ(x[21], 0.0);
  const Vector expected = Matrix(small).ldlt().solve(b.segment(1, 20));
  EXPECT_LE((x.segment(1, 20) - expected).norm(), 1e-12 * expected.norm());
}

TEST(RowRank, FindsRowsThatFollowFromOthers) {
  Matrix J = right_sides(6, 9);
  J.row(3) = 2.0 * J.row(0) - 0.5 * J.row(5);
  J.row(4).setZero();
  const RowRank split = split_rows(J.sparseView(), 1e-9);
  ASSERT_EQ(split.independent.size(), 4U);
  EXPECT_EQ(split.dependent.size(), 2U);
  EXPECT_EQ(std::count(split.dependent.begin(), split.dependent.end(), 4), 1);
  Matrix kept(4, 9);
  for (std::size_t k = 0; k < 4; ++k) {
    kept.row(static_cast<Eigen::Index>(k)) = J.row(split.independent[k]);
  }
  EXPECT_EQ(kept.fullPivLu().rank(), 4);
  EXPECT_TRUE(split_rows(SparseMatrix(0, 5), 1e-9).independent.empty());
}

TEST(RowRank, LargeMatricesAreSplitAsWell) {
  // Four million entries: the sparse route. Row 1500 repeats row 300.
  const int n = 2100;
  std::vector<Triplet> entries;
  for (int k = 0; k < n; ++k) {
    const int like = k == 1500 ? 300 : k;
    entries.emplace_back(k, like, 1.0);
    entries.emplace_back(k, (like + 1) % n, 0.3);
  }
  SparseMatrix J(n, n);
  J.setFromTriplets(entries.begin(), entries.end());
  const RowRank split = split_rows(J, 1e-9);
  EXPECT_EQ(split.independent.size(), static_cast<std::size_t>(n - 1));
  ASSERT_EQ(split.dependent.size(), 1U);
  EXPECT_TRUE(split.dependent[0] == 1500 || split.dependent[0] == 300);
}

}  // namespace
}  // namespace buckens::linalg
