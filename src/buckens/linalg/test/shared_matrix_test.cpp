// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/shared_matrix.h"

#include <gtest/gtest.h>

#include "buckens/linalg/same_bits.h"

namespace buckens::linalg {
namespace {

SparseMatrix tridiagonal(int n, double beside) {
  std::vector<Triplet> entries;
  for (int k = 0; k < n; ++k) entries.emplace_back(k, k, 2.0);
  for (int k = 0; k + 1 < n; ++k) {
    entries.emplace_back(k, k + 1, beside);
    entries.emplace_back(k + 1, k, beside);
  }
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

TEST(SharedMatrix, ComesAgainWhereItWasLetGoOf) {
  int made = 0;
  const SharedMatrix A(tridiagonal(7, -1.0), [&made] {
    ++made;
    return tridiagonal(7, -1.0);
  });
  const SharedMatrix copy = A;
  EXPECT_TRUE(A.is_here());
  A.let_go();
  A.let_go();
  EXPECT_FALSE(copy.is_here());
  EXPECT_EQ(copy.rows(), 7);
  EXPECT_EQ(copy.nonZeros(), 19);
  EXPECT_EQ(made, 0) << "its size is known without it";
  EXPECT_TRUE(have_same_bits(*copy, tridiagonal(7, -1.0)));
  EXPECT_EQ(copy->coeff(0, 1), -1.0);
  EXPECT_EQ(made, 1);
  EXPECT_TRUE(A.is_here());
}

TEST(SharedMatrix, StaysWhereNobodyCanMakeItAgain) {
  const SharedMatrix A(tridiagonal(3, -1.0));
  A.let_go();
  EXPECT_TRUE(A.is_here());
  SharedMatrix().let_go();
  EXPECT_EQ(SharedMatrix().get(), nullptr);
}

TEST(SharedMatrix, IsComparedWithoutComingAgain) {
  const auto never = [](double beside) {
    return SharedMatrix(tridiagonal(5, beside), []() -> SparseMatrix {
      ADD_FAILURE() << "made again";
      return tridiagonal(5, 0.0);
    });
  };
  const SharedMatrix one = never(-1.0), same = never(-1.0), other = never(-1.0 - 1e-15);
  const SharedMatrix here(tridiagonal(5, -1.0));
  EXPECT_TRUE(one.has_same_bits(same));
  EXPECT_FALSE(one.has_same_bits(other));
  one.let_go();
  EXPECT_TRUE(one.has_same_bits(one));
  EXPECT_TRUE(one.has_same_bits(same));
  EXPECT_TRUE(here.has_same_bits(one));
  EXPECT_FALSE(one.has_same_bits(other));
  other.let_go();
  EXPECT_FALSE(one.has_same_bits(other));
  EXPECT_FALSE(one.has_same_bits(SharedMatrix()));
}

}  // namespace
}  // namespace buckens::linalg
