// SPDX-License-Identifier: Apache-2.0
// Some nodal variables against all of them, bit for bit.
#include "buckens/body/nodal_part.h"

#include <gtest/gtest.h>

namespace buckens::body {
namespace {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

constexpr int kNodalVariables = 203;

Vector sine_wave(Eigen::Index n) {
  Vector out(n);
  for (Eigen::Index k = 0; k < n; ++k) out[k] = std::sin(1.7 * static_cast<double>(k));
  return out;
}

/// @param columns on which the rows depend
void expect_bits_of_all(const NodalRecovery& T, const Vector& x, const std::vector<int>& rows,
                        const std::vector<int>& columns) {
  const NodalPart part(T, rows);
  EXPECT_EQ(part.variables(), columns);
  EXPECT_EQ(part.apply(x(part.variables())), Vector(T.apply(x)(rows)));
}

std::vector<int> counted(int count) {
  std::vector<int> out;
  for (int k = 0; k < count; ++k) out.push_back(k);
  return out;
}

TEST(NodalPart, OfVariablesThatAreThoseOfTheMesh) {
  expect_bits_of_all(NodalRecovery(), sine_wave(kNodalVariables), {0, 7, 8, 202}, {0, 7, 8, 202});
}

TEST(NodalPart, OfVariablesThatFollowOthers) {
  // Most variables are there themselves, some are sums of several, and one is always zero.
  std::vector<linalg::Triplet> entries;
  for (int row = 0; row < kNodalVariables; ++row) {
    if (row == 9) continue;
    if (row % 5 != 2) entries.emplace_back(row, row / 2, 1.0);
    for (int k = 0; row % 5 == 2 && k < 7; ++k) {
      entries.emplace_back(row, (13 * k + row) % 102, 0.3 + 0.7 * k);
    }
  }
  SparseMatrix T(kNodalVariables, 102);
  T.setFromTriplets(entries.begin(), entries.end());
  const NodalRecovery recovery(T);
  expect_bits_of_all(recovery, sine_wave(102), {3, 9, 200}, {1, 100});
  expect_bits_of_all(recovery, sine_wave(102), {4, 7, 201}, {2, 7, 20, 33, 46, 59, 72, 85, 100});
  expect_bits_of_all(recovery, sine_wave(102), {9}, {});
  expect_bits_of_all(recovery, sine_wave(102), counted(kNodalVariables), counted(102));
}

/// Rows and modes of reduced bodies.
class PartOfReduced : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(PartOfReduced, HasTheBitsOfAll) {
  const auto [rows, modes] = GetParam();
  Matrix T(rows, modes);
  T.reshaped() = sine_wave(T.size());
  const NodalRecovery recovery(T);
  const std::vector<int> all = counted(modes);
  for (int row = 0; row < rows; ++row) expect_bits_of_all(recovery, sine_wave(modes), {row}, all);
  expect_bits_of_all(recovery, sine_wave(modes), {0, 3, rows / 2, rows - 1}, all);
  expect_bits_of_all(recovery, sine_wave(modes), counted(rows), all);
  expect_bits_of_all(recovery, sine_wave(modes), {}, {});
}

// Eigen adds up 128 columns and more in pieces whose length depends on the number of rows.
INSTANTIATE_TEST_SUITE_P(Sizes, PartOfReduced,
                         testing::Values(std::pair(64, 20), std::pair(203, 31), std::pair(65, 7),
                                         std::pair(5, 3), std::pair(77, 150),
                                         std::pair(4001, 140)));

}  // namespace
}  // namespace buckens::body
