// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/factor_work.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::linalg {
namespace {

SparseMatrix long_chain(int size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < size; ++k) {
    entries.emplace_back(k, k, 4.0);
    if (k + 1 < size) entries.emplace_back(k, k + 1, -1.0);
    if (k + 1 < size) entries.emplace_back(k + 1, k, -1.0);
  }
  SparseMatrix A(size, size);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

std::vector<base::Work> told_of(int size) {
  std::vector<base::Work> told;
  base::set_work_sink([&told](const base::Work& work) { told.push_back(work); });
  const SparseCholesky factor(long_chain(size));
  base::set_work_sink({});
  return told;
}

TEST(FactorWork, TellsOfLargeMatricesAndOfTheirEnd) {
  const std::vector<base::Work> told = told_of(20000);
  ASSERT_EQ(told.size(), 3U);
  for (const base::Work& work : told) EXPECT_EQ(work.name, "factorising 20000 equations");
  EXPECT_EQ(told[0].stage, "ordering");
  EXPECT_TRUE(told[1].stage.starts_with("factor of ")) << told[1].stage;
  EXPECT_TRUE(told[1].outlook.empty()) << "less than a gigabyte";
  EXPECT_EQ(told[2].stage, "") << "over";
  EXPECT_TRUE(told_of(1000).empty());
}

TEST(FactorWork, SaysBeforehandWhatMuchMemoryIsNeeded) {
  std::vector<base::Work> told;
  base::set_work_sink([&told](const base::Work& work) { told.push_back(work); });
  FactorWork(500000).begin(3.4e9);
  base::set_work_sink({});
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(told[1].outlook, "the factor alone takes 3.4 GB of memory");
  EXPECT_TRUE(told[1].is_long);
}

}  // namespace
}  // namespace buckens::linalg
