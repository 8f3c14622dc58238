// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/matrix_sum.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/linalg/elimination_order.h"
#include "buckens/linalg/sparse_cholesky.h"
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

TEST(MatrixSumTest, HasTheGraphOfTheWhole) {
  const SumOfThree of;
  const ColumnGraph graph = column_graph(of.sum), expected = column_graph(of.sum.whole());
  EXPECT_EQ(graph.first_column, expected.first_column);
  EXPECT_EQ(graph.columns, expected.columns);
  EXPECT_EQ(graph.begin, expected.begin);
  EXPECT_EQ(graph.neighbours, expected.neighbours);
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

TEST(MatrixSumTest, ReadsOneColumnAsTheWholeHasIt) {
  const SumOfThree of;
  const SparseMatrix whole = of.sum.whole();
  std::vector<MatrixSum::Entry> entries(3);
  for (int k = 0; k < whole.cols(); ++k) {
    of.sum.read_column(k, entries);
    std::size_t at = 0;
    for (SparseMatrix::InnerIterator it(whole, k); it; ++it, ++at) {
      ASSERT_LT(at, entries.size());
      EXPECT_EQ(entries[at].row, it.row());
      EXPECT_EQ(entries[at].value, it.value());
    }
    EXPECT_EQ(at, entries.size());
  }
}

// As K̂ = m M + k K of solids, M by node, and with entries of another term that K has not.
TEST(MatrixSumTest, FactorsReadItColumnByColumn) {
  const SparseMatrix K = matrices::grid(9, 0.3);
  const auto nodes = std::make_shared<SparseMatrix>(K.cols() / 3, K.cols() / 3);
  nodes->setIdentity();
  const SymmetricMatrix M = SymmetricMatrix::by_node(nodes);
  SparseMatrix beside(K.cols(), K.cols());
  const std::vector<Triplet> entries = {{0, 2000, 0.01}, {2000, 0, 0.01}};
  beside.setFromTriplets(entries.begin(), entries.end());
  const Vector b = scattered_block(K.cols(), 1, 3);
  for (const int threads : {1, 2}) {
    const base::AllowedThreads allowed(threads);
    MatrixSum sum;
    sum.add(7.7, M);
    sum.add(1.0 / 3.0, K);
    for (int round = 0; round < 2; ++round) {
      Vector x = b, expected = b;
      SparseCholesky(sum).solve_in_place(x);
      SparseCholesky(sum.whole()).solve_in_place(expected);
      EXPECT_EQ(x, expected) << threads << " " << round;
      sum.add(1.0, beside);
    }
  }
}

TEST(MatrixSumTest, FactorsOfASumRefuseWhatIsNotFiniteOrDefinite) {
  SparseMatrix K = matrices::grid(4, 0.3);
  MatrixSum sum;
  sum.add(-1.0, K);
  EXPECT_THROW(SparseCholesky{sum}, IndefiniteMatrix);
  K.coeffRef(5, 5) = 1e308;
  sum.add(20.0, K);
  EXPECT_THROW(SparseCholesky{sum}, NumericalError) << "finite terms";
  K.coeffRef(5, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SparseCholesky{sum}, NumericalError);
}

}  // namespace
}  // namespace buckens::linalg
