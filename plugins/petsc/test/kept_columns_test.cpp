// SPDX-License-Identifier: Apache-2.0
#include "plugins/petsc/kept_columns.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plugins/petsc/arrays_aside.h"

namespace buckens_petsc {
namespace {

struct List {
  std::vector<int> starts = {0}, rows;
  std::vector<double> values;

  void add(const std::vector<int>& column, double first) {
    for (const int row : column) {
      rows.push_back(row);
      values.push_back(first++);
    }
    starts.push_back(static_cast<int>(rows.size()));
  }
  KeptColumns kept() const {
    KeptColumns out;
    out.add(starts, rows, values);
    return out;
  }
};

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> out;
  for (const double value : values) out.push_back(std::bit_cast<std::uint64_t>(value));
  return out;
}

void expect_as_given(const KeptColumns& kept, const List& given) {
  List found;
  kept.list(found.starts, found.rows, found.values);
  EXPECT_EQ(found.starts, given.starts);
  EXPECT_EQ(found.rows, given.rows);
  EXPECT_EQ(bits(found.values), bits(given.values));
}

constexpr std::size_t kPlace = 16;  // bytes of a column

TEST(KeptColumns, OfVariablesOfANodeHaveRowsInCommon) {
  List stiffness;
  stiffness.add({0, 1, 2, 9, 10, 11}, 1);
  stiffness.add({1, 2, 9, 10, 11}, 7);
  stiffness.add({2, 9, 10, 11}, 12);
  stiffness.add({3, 4, 5, 14}, 16);
  stiffness.add({4, 5, 14}, 20);
  stiffness.add({5, 14}, 23);
  const KeptColumns kept = stiffness.kept();
  expect_as_given(kept, stiffness);
  EXPECT_EQ(kept.bytes(), 6 * kPlace + 10 * sizeof(int) + 24 * sizeof(double));
}

TEST(KeptColumns, OfAMassThatActsAlikeInThreeDirectionsAreKeptOnce) {
  List mass;
  for (int axis = 0; axis < 3; ++axis) mass.add({axis, 6 + axis, 9 + axis}, 1);
  for (int axis = 0; axis < 3; ++axis) mass.add({3 + axis, 9 + axis}, 4);
  const KeptColumns kept = mass.kept();
  expect_as_given(kept, mass);
  EXPECT_EQ(kept.column(2).row(1), 8);
  EXPECT_EQ(kept.bytes(), 6 * kPlace + 5 * (sizeof(int) + sizeof(double)));
}

TEST(KeptColumns, OfStressesOfAnElementHaveRowsInCommon) {
  List stresses;
  for (int k = 0; k < 6; ++k) stresses.add({4, 7, 30}, 3 * k);
  for (int k = 0; k < 6; ++k) stresses.add({7, 8, 31, 33}, 4 * k);
  const KeptColumns kept = stresses.kept();
  expect_as_given(kept, stresses);
  EXPECT_EQ(kept.bytes(), 12 * kPlace + 7 * sizeof(int) + 42 * sizeof(double));
}

TEST(KeptColumns, OfAnyKindAreWhatWasGiven) {
  std::mt19937 random(3);
  const auto below = [&random](int end) { return static_cast<int>(random() % end); };
  List any;
  for (int k = 0; k < 3000; ++k) {
    std::vector<int> rows;
    // Short lists of few rows are often like the end of the one before, or nearly.
    for (int row = below(4); row < 9; row += 1 + below(3)) rows.push_back(row + below(2) * 9);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    if (below(5) == 0) rows.clear();
    any.add(rows, below(3) == 0 ? -0.0 : 0.0);
  }
  expect_as_given(any.kept(), any);
  expect_as_given(List().kept(), List());
}

TEST(KeptColumns, ComeBackFromTheDiskOrAreEmpty) {
  List given;
  for (int k = 0; k < 30'000; ++k) given.add({k, k + 1 + k % 7}, k);
  KeptColumns kept = given.kept();
  ArraysAside aside;
  kept.put(aside);
  ASSERT_TRUE(aside.bring_back());
  expect_as_given(kept, given);
  kept.lose();
  EXPECT_EQ(kept.count(), 30'000);
  EXPECT_EQ(kept.column(29'999).size, 0);
}

}  // namespace
}  // namespace buckens_petsc
