// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/matrix_sum.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

/// Three matrices of different patterns: a grid, its diagonal, and a few entries beside it.
struct SumOfThree {
  SparseMatrix grid = matrices::grid(4, 0.3), diagonal, few;
  MatrixSum sum;

  SumOfThree() : diagonal(grid.rows(), grid.cols()), few(grid.rows(), grid.cols()) {
    const auto n = static_cast<int>(grid.rows());
    std::vector<Triplet> entries;
    for (int k = 0; k < n; ++k) entries.emplace_back(k, k, 0.1 + k);
    diagonal.setFromTriplets(entries.begin(), entries.end());
    entries = {{0, n - 1, 0.7}, {n - 1, 0, 0.7}, {1, 2, -0.1}, {2, 1, -0.1}};
    few.setFromTriplets(entries.begin(), entries.end());
    sum.add(1.0 / 3.0, diagonal);
    sum.add(1e5, grid);
    sum.add(-7.7, few);
  }
  SparseMatrix expected() const {
    SparseMatrix out = 1.0 / 3.0 * diagonal + 1e5 * grid;
    out += -7.7 * few;
    out.makeCompressed();
    return out;
  }
};

void expect_same(const SparseMatrix& found, const SparseMatrix& expected) {
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_EQ(found.cols(), expected.cols());
  ASSERT_EQ(found.nonZeros(), expected.nonZeros());
  for (Eigen::Index k = 0; k <= found.cols(); ++k) {
    ASSERT_EQ(found.outerIndexPtr()[k], expected.outerIndexPtr()[k]);
  }
  for (Eigen::Index k = 0; k < found.nonZeros(); ++k) {
    ASSERT_EQ(found.innerIndexPtr()[k], expected.innerIndexPtr()[k]);
    ASSERT_EQ(found.valuePtr()[k], expected.valuePtr()[k]);
  }
}

TEST(MatrixSumTest, HasTheBitsOfTheSumOfWholeMatrices) {
  const SumOfThree of;
  expect_same(of.sum.whole(), of.expected());
  const Vector diagonal = of.expected().diagonal();
  EXPECT_EQ(of.sum.diagonal(), diagonal);
}

TEST(MatrixSumTest, RunsOfColumnsMakeUpTheWhole) {
  const SumOfThree of;
  const SparseMatrix expected = of.expected();
  for (const Eigen::Index length : {1, 5, 64}) {
    for (Eigen::Index first = 0; first < of.sum.size(); first += length) {
      const Eigen::Index count = std::min(length, of.sum.size() - first);
      expect_same(of.sum.columns(first, count), expected.middleCols(first, count));
    }
  }
  EXPECT_EQ(of.sum.columns(3, 0).nonZeros(), 0);
}

TEST(MatrixSumTest, LowerTrianglesOfRunsOfColumnsMakeUpThatOfTheWhole) {
  const SumOfThree of;
  const SparseMatrix expected = of.expected().triangularView<Eigen::Lower>();
  for (Eigen::Index first = 0; first < of.sum.size(); first += 5) {
    const Eigen::Index count = std::min<Eigen::Index>(5, of.sum.size() - first);
    expect_same(of.sum.columns(first, count, Triangles::lower), expected.middleCols(first, count));
  }
}

TEST(MatrixSumTest, TheWidestTermHasThePatternOfTheSumOrThereIsNone) {
  const SumOfThree of;
  EXPECT_EQ(of.sum.widest(), nullptr) << "the few entries lie beside the grid";
  MatrixSum two;
  EXPECT_EQ(two.widest(), nullptr);
  two.add(1.0, of.diagonal);
  EXPECT_EQ(two.widest(), &of.diagonal);
  two.add(2.0, of.grid);
  EXPECT_EQ(two.widest(), &of.grid);
}

TEST(MatrixSumTest, NothingIsOfSizeZero) {
  EXPECT_EQ(MatrixSum().size(), 0);
  EXPECT_EQ(MatrixSum().whole().rows(), 0);
}

TEST(MatrixSumTest, RefusesEntriesThatAreNotFinite) {
  SumOfThree of;
  of.sum.require_finite();
  of.few.valuePtr()[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(of.sum.require_finite(), NumericalError);
}

}  // namespace
}  // namespace buckens::linalg
