// SPDX-License-Identifier: Apache-2.0
#include "plugins/petsc/arrays_aside.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "plugins/petsc/test/file_limit.h"

namespace buckens_petsc {
namespace {

template <class T>
std::vector<T> numbers(std::size_t count) {
  std::vector<T> out(count);
  std::iota(out.begin(), out.end(), T{1});
  return out;
}

constexpr std::size_t kMany = 200'000;

TEST(ArraysAside, LeaveMemoryAndComeBackAsTheyWere) {
  const std::vector<int> rows = numbers<int>(kMany);
  const std::vector<double> values = numbers<double>(kMany);
  std::vector<int> first = rows;
  std::vector<double> second = values;
  ArraysAside aside;
  aside.put(first);
  if (!first.empty()) GTEST_SKIP() << "neither TMPDIR, /var/tmp nor /tmp is on a disk";
  aside.put(second);
  EXPECT_EQ(first.capacity(), 0U);
  EXPECT_EQ(second.capacity(), 0U);
  EXPECT_TRUE(aside.bring_back());
  EXPECT_EQ(first, rows);
  EXPECT_EQ(second, values);
}

TEST(ArraysAside, SmallOnesStay) {
  std::vector<double> few = numbers<double>(100);
  ArraysAside aside;
  aside.put(few);
  EXPECT_EQ(few, numbers<double>(100));
  EXPECT_TRUE(aside.bring_back());
  EXPECT_EQ(few, numbers<double>(100));
}

TEST(ArraysAside, StayInMemoryWhereTheDiskDoesNotTakeThem) {
  std::vector<int> rows = numbers<int>(kMany);          // 0.8 MB
  std::vector<double> values = numbers<double>(kMany);  // 1.6 MB
  ArraysAside aside;
  {
    const FileLimit limit(rlim_t{1'000'000});
    aside.put(values);
    EXPECT_EQ(values, numbers<double>(kMany));
    aside.put(rows);
  }
  EXPECT_TRUE(aside.bring_back());
  EXPECT_EQ(values, numbers<double>(kMany));
  EXPECT_EQ(rows, numbers<int>(kMany));
}

}  // namespace
}  // namespace buckens_petsc
