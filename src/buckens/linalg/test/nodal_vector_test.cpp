// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/nodal_vector.h"

#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace buckens::linalg {
namespace {

constexpr Eigen::Index kLong = NodalVector::kShared;
constexpr Eigen::Index kShort = kLong - 1;

Vector counted(Eigen::Index size) {
  return Vector::LinSpaced(size, 1.0, static_cast<double>(size));
}

TEST(NodalVector, CopiesOfLongVectorsShareMemoryUntilOneIsWrittenTo) {
  NodalVector a = counted(kLong);
  EXPECT_FALSE(a.is_shared());
  const NodalVector b = a;
  NodalVector c;
  c = b;
  EXPECT_TRUE(a.is_shared());
  EXPECT_EQ(b.whole().data(), a.whole().data());
  EXPECT_EQ(c.whole().data(), a.whole().data());
  a.change()[0] = 7;
  c.overwrite(kLong).setConstant(8);
  EXPECT_EQ(a[0], 7);
  EXPECT_EQ(a[1], 2);
  EXPECT_EQ(b.whole(), counted(kLong));
  EXPECT_EQ(c[0], 8);
  EXPECT_FALSE(a.is_shared() || b.is_shared() || c.is_shared());
}

TEST(NodalVector, GivesSomeOfItsNumbers) {
  for (const Eigen::Index size : {kShort, kLong}) {
    const NodalVector a = counted(size);
    EXPECT_EQ(a.some(std::vector{5, 0, 61}), (Vector(3) << 6, 1, 62).finished());
    EXPECT_EQ(a.some({}).size(), 0);
  }
}

TEST(NodalVector, ShortVectorsAreCopiedIntoTheMemoryThatIsThere) {
  const NodalVector a = counted(kShort);
  NodalVector b = 2 * counted(kShort);
  const double* const memory = b.whole().data();
  b = a;
  EXPECT_EQ(b.whole().data(), memory);
  EXPECT_EQ(b.whole(), a.whole());
  EXPECT_FALSE(a.is_shared());
}

TEST(NodalVector, WritesIntoItsOwnMemoryOnceNoCopyIsLeft) {
  NodalVector a = counted(kLong);
  const double* const memory = a.whole().data();
  {
    const NodalVector b = a;
    EXPECT_TRUE(a.is_shared());
  }
  EXPECT_EQ(a.change().data(), memory);
  EXPECT_EQ(a.overwrite(kLong).data(), memory);
  a = 3 * counted(kLong);
  EXPECT_EQ(a.whole().data(), memory);
  NodalVector c = std::move(a);
  EXPECT_EQ(c.whole().data(), memory);
  std::swap(a, c);
  EXPECT_EQ(a.whole().data(), memory);
  EXPECT_EQ(c.size(), 0);
}

TEST(NodalVector, TakesWhatIsComputedFromItself) {
  for (const Eigen::Index size : {kShort, kLong}) {
    const Vector once = counted(size);
    const Matrix A = Matrix::Identity(size, size).colwise().reverse();
    NodalVector a = once;
    const NodalVector before = a;  // so that a has to move
    a = a.whole() + 2 * a.whole();
    EXPECT_EQ(a.whole(), 3 * once);
    a = A * a.whole();
    EXPECT_EQ(a.whole(), 3 * once.reverse());
    a.change() += before.whole();
    EXPECT_EQ(a.whole(), 3 * once.reverse() + once);
    a.change() -= a.whole();
    EXPECT_EQ(a.norm(), 0);
    EXPECT_EQ(before.whole(), once);
  }
}

TEST(NodalVector, ChangesBetweenLengths) {
  NodalVector a;
  EXPECT_EQ(a.size(), 0);
  EXPECT_EQ(a.change().size(), 0);
  for (const Eigen::Index size : {kLong, kShort, Eigen::Index{0}, kLong + 1, kLong}) {
    a = counted(size);
    EXPECT_EQ(a.whole(), counted(size));
    const NodalVector b = a;
    EXPECT_EQ(a.is_shared(), size >= kLong);
    EXPECT_EQ(a.overwrite(size + 1).size(), size + 1);
    a = b;
    EXPECT_EQ(a.whole(), counted(size));
  }
}

TEST(NodalVector, CopiesMayBelongToSeveralThreads) {
  const NodalVector a = counted(kLong);
  std::vector<std::thread> threads;
  std::vector<double> sums(4);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    threads.emplace_back([own = a, &sum = sums[k], k]() mutable {
      for (int round = 0; round < 100; ++round) {
        NodalVector other = own;
        own.change()[0] = static_cast<double>(k);
        std::swap(own, other);
      }
      sum = own.whole().sum();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double sum : sums) EXPECT_EQ(sum, a.whole().sum());
  EXPECT_FALSE(a.is_shared());
}

}  // namespace
}  // namespace buckens::linalg
