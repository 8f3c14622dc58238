// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/iterative_solver.h"

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::linalg {
namespace {

/// A grid of springs between neighbours, and a weak one to the ground: its motion with little
/// energy is the common one.
SparseMatrix grid_of_springs(int side) {
  const int n = side * side * side;
  std::vector<Triplet> entries;
  const auto at = [&](int i, int j, int k) { return i + side * (j + side * k); };
  const auto spring = [&](int a, int b) {
    entries.emplace_back(a, a, 1.0);
    entries.emplace_back(b, b, 1.0);
    entries.emplace_back(a, b, -1.0);
    entries.emplace_back(b, a, -1.0);
  };
  for (int k = 0; k < side; ++k) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        entries.emplace_back(at(i, j, k), at(i, j, k), 1e-4);
        if (i + 1 < side) spring(at(i, j, k), at(i + 1, j, k));
        if (j + 1 < side) spring(at(i, j, k), at(i, j + 1, k));
        if (k + 1 < side) spring(at(i, j, k), at(i, j, k + 1));
      }
    }
  }
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// In a process of its own, since the plug-in is looked for once.
std::string told_with_plugin(const char* file) {
  ::setenv("BUCKENS_GRID_PLUGIN", file, 1);
  std::string told;
  try {
    grid_solver();
  } catch (const IoError& error) {
    told = error.what();
  }
  return told;
}

TEST(GridLibraryDeathTest, SaysWhatIsMissing) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        std::fputs(told_with_plugin("/nowhere/grid.so").c_str(), stderr);
        std::exit(0);
      },
      testing::ExitedWithCode(0), "no file /nowhere/grid.so.*-DBUCKENS_PETSC=ON");
  // A file that is no library.
  EXPECT_EXIT(
      {
        std::fputs(told_with_plugin("/proc/self/status").c_str(), stderr);
        std::exit(0);
      },
      testing::ExitedWithCode(0), "cannot be loaded.*libpetsc");
  // A library that is no plug-in.
  EXPECT_EXIT(
      {
        Dl_info libc{};
        ::dladdr(reinterpret_cast<const void*>(&std::puts), &libc);
        std::fputs(told_with_plugin(libc.dli_fname).c_str(), stderr);
        std::exit(0);
      },
      testing::ExitedWithCode(0), "another version of Buckens");
}

class IterativeSolverTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = missing_grid_solver(); !missing.empty()) {
      GTEST_SKIP() << "no multigrid solver: " << missing;
    }
  }
};

TEST_F(IterativeSolverTest, SolvesLikeAFactor) {
  const SparseMatrix A = grid_of_springs(12);
  const Matrix motions = Vector::Ones(A.rows());
  const IterativeSolver solver(A, motions, {});
  const SparseCholesky factor(A);
  Matrix B = Matrix::Zero(A.rows(), 2);
  B(5, 0) = 1.0;
  B.col(1).setLinSpaced(-1.0, 2.0);
  const Matrix expected = factor.solve(B);
  const Matrix found = solver.solve(B);
  for (Eigen::Index k = 0; k < 2; ++k) {
    const Vector error = found.col(k) - expected.col(k);
    // The tolerance of 1e-11 is as the preconditioner estimates it, within a factor of two.
    EXPECT_LE(error.dot(A * error), 4e-22 * expected.col(k).dot(A * expected.col(k)));
  }
  EXPECT_EQ(solver.iteration_counts().solves, 2);
  EXPECT_GT(solver.iteration_counts().iterations, 2);
  EXPECT_LT(solver.iteration_counts().iterations, 60);
}

TEST_F(IterativeSolverTest, AGoodEstimateSparesIterations) {
  const SparseMatrix A = grid_of_springs(12);
  const IterativeSolver solver(A, Vector::Ones(A.rows()), {});
  Vector expected = Vector::LinSpaced(A.rows(), 0.0, 1.0);
  const Vector b = A * expected;
  Vector x = Vector::Zero(A.rows());
  solver.improve(b, x, 0.0);
  const long from_zero = solver.iteration_counts().iterations;
  x = expected + 1e-6 * Vector::LinSpaced(A.rows(), -1.0, 1.0).cwiseAbs2();
  solver.improve(b, x, 0.0);
  const long from_estimate = solver.iteration_counts().iterations - from_zero;
  EXPECT_LT(from_estimate, from_zero);
  EXPECT_LE((x - expected).dot(A * (x - expected)), 4e-22 * expected.dot(b));
}

TEST_F(IterativeSolverTest, SaysWhenItDoesNotConverge) {
  IterationSettings settings;
  settings.most_iterations = 2;
  const SparseMatrix A = grid_of_springs(12);
  const IterativeSolver solver(A, Vector::Ones(A.rows()), settings);
  Vector x = Vector::Zero(A.rows());
  x[3] = 1.0;
  try {
    solver.solve_in_place(x);
    FAIL();
  } catch (const NumericalError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("size 1728 have not converged in 2 iterations"), std::string::npos) << text;
    EXPECT_NE(text.find("factorise it"), std::string::npos) << text;
  }
}

TEST_F(IterativeSolverTest, RefusesNumbersThatAreNone) {
  SparseMatrix A = grid_of_springs(4);
  A.coeffRef(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(IterativeSolver(A, Vector::Ones(A.rows()), {}), NumericalError);
}

}  // namespace
}  // namespace buckens::linalg
