// SPDX-License-Identifier: Apache-2.0
// No call of a library below starts a thread, however many OpenMP would like to start, and what
// the caller has set stays set.
#include "buckens/linalg/single_thread.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "buckens/linalg/gpl_parts.h"
#include "buckens/linalg/least_norm.h"
#include "buckens/linalg/row_rank.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/tall_products.h"

namespace buckens::linalg {
namespace {

int threads_of_process() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    int count = 0;
    if (word == "Threads:" && status >> count) return count;
  }
  return 0;
}

/// The OpenMP of the process, null where there is none.
template <class Function>
Function open_mp_function(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_DEFAULT, name));
}

/// A dense band: supernodes of many columns.
SparseMatrix wide_band(int n, int half) {
  std::vector<Triplet> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 4.0 * half);
    for (int j = i + 1; j < std::min(n, i + half); ++j) {
      entries.emplace_back(i, j, -1.0);
      entries.emplace_back(j, i, -1.0);
    }
  }
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

class LibraryThreads : public testing::Test {
 protected:
  void SetUp() override {
    if (threads_of_process() == 0) GTEST_SKIP() << "no /proc to count threads in";
    set_ = open_mp_function<void (*)(int)>("omp_set_num_threads");
    get_ = open_mp_function<int (*)()>("omp_get_max_threads");
    if (set_ == nullptr || get_ == nullptr) GTEST_SKIP() << "libraries without OpenMP";
    found_ = get_();
    set_(4);  // on any machine
    before_ = threads_of_process();
  }
  void TearDown() override {
    if (set_ != nullptr && found_ > 0) set_(found_);
  }
  void expect_none_started(const char* by) const {
    EXPECT_EQ(threads_of_process(), before_) << by;
    EXPECT_EQ(get_(), 4) << by << " must leave the caller's setting";
  }

  void (*set_)(int) = nullptr;
  int (*get_)() = nullptr;
  int found_ = 0, before_ = 0;
};

TEST_F(LibraryThreads, NoneAreStartedByFactorsAndSolves) {
  const SparseMatrix A = wide_band(4000, 150);
  const SparseCholesky panels(A, {SolveRoute::panels});
  expect_none_started("a factor");
  const SparseCholesky factor(A, {has_gpl_parts() ? SolveRoute::cholmod : SolveRoute::panels});
  const Matrix X = factor.solve(Matrix::Ones(4000, 8));
  expect_none_started("a solve");
  EXPECT_LT((A * X - Matrix::Ones(4000, 8)).norm(), 1e-9);
}

TEST_F(LibraryThreads, NoneAreStartedByOrthogonalFactors) {
  const SparseMatrix A = wide_band(1200, 100);
  const Vector x = least_norm_solution(A, A * Vector::Ones(1200), 1e-9);
  expect_none_started("least norm");
  EXPECT_LT((x - Vector::Ones(1200)).norm(), 1e-8);
  EXPECT_EQ(split_rows(A, 1e-9).dependent.size(), 0U);
  expect_none_started("rank");
}

TEST_F(LibraryThreads, NoneAreStartedByDenseProducts) {
  const Matrix A = Matrix::Ones(20000, 40);
  EXPECT_EQ(inner_products(A, A)(3, 5), 20000.0);
  expect_none_started("products");
}

TEST(SingleThread, MayBeNestedAndHeldByOthersMeanwhile) {
  const auto get = open_mp_function<int (*)()>("omp_get_max_threads");
  if (get == nullptr) GTEST_SKIP() << "libraries without OpenMP";
  const int before = get();
  {
    const SingleThread outer;
    EXPECT_EQ(get(), 1);
    {
      const SingleThread inner;
      EXPECT_EQ(get(), 1);
    }
    EXPECT_EQ(get(), 1);
    std::thread([before, get] {
      EXPECT_EQ(get(), before) << "belongs to the thread that holds it";
      const SingleThread own;
      EXPECT_EQ(get(), 1);
    }).join();
  }
  EXPECT_EQ(get(), before);
}

}  // namespace
}  // namespace buckens::linalg
