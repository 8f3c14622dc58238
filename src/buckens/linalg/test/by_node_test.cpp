// SPDX-License-Identifier: Apache-2.0
// Symmetric matrices of one number for the three variables of each node, against their entries.
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/base/task_pool.h"
#include "buckens/linalg/conjugate_gradients.h"
#include "buckens/linalg/inverse_iteration.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/node_matrix.h"
#include "buckens/linalg/tall_products.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

// Sums of some dozen products in another order.
constexpr double kOtherOrder = 1e-14;

std::shared_ptr<const SparseMatrix> of_nodes(double shift = 0.3) {
  return std::make_shared<const SparseMatrix>(matrices::grid(4, shift));
}

SparseMatrix entries_of(const SparseMatrix& A) {
  std::vector<Triplet> entries;
  for (int j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      for (int a = 0; a < 3; ++a) {
        entries.emplace_back(3 * static_cast<int>(it.row()) + a, 3 * j + a, it.value());
      }
    }
  }
  SparseMatrix out(3 * A.rows(), 3 * A.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

TEST(ByNode, AnswersAsItsEntriesDoWithoutFormingThem) {
  const auto nodes = of_nodes();
  const SymmetricMatrix A = SymmetricMatrix::by_node(nodes);
  const SymmetricMatrix full(entries_of(*nodes));
  EXPECT_EQ(A.rows(), full.rows());
  EXPECT_EQ(A.cols(), full.cols());
  EXPECT_EQ(A.nonZeros(), full.nonZeros());
  EXPECT_EQ(A.diagonal(), full.diagonal());
  // Sums of some ten thousand squares.
  EXPECT_NEAR(A.norm(), full.norm(), 1e-12 * full.norm());
  EXPECT_EQ(A.content(), full.content());
  EXPECT_TRUE(A == full);
  EXPECT_TRUE(full == A);
  EXPECT_TRUE(A == SymmetricMatrix::by_node(of_nodes()));
  EXPECT_FALSE(A == SymmetricMatrix::by_node(of_nodes(0.4)));
  EXPECT_FALSE(A == SymmetricMatrix(entries_of(*of_nodes(0.4))));
  std::vector<int> lengths(static_cast<std::size_t>(A.cols()), 1);
  lengths[0] = 6;
  lengths[7] = 5;
  EXPECT_EQ(A.near_diagonal(lengths), full.near_diagonal(lengths));
  EXPECT_FALSE(A.is_formed());
}

TEST(ByNode, MultipliesAsItsEntriesDo) {
  const auto nodes = of_nodes();
  const SymmetricMatrix A = SymmetricMatrix::by_node(nodes);
  const SparseMatrix full = entries_of(*nodes);
  const Matrix X = scattered_block(A.rows(), 11, 2);
  const Matrix expected = full * X;
  const auto is_close = [](const Matrix& a, const Matrix& b) {
    return (a - b).norm() <= kOtherOrder * b.norm();
  };
  EXPECT_TRUE(is_close(A * X, expected));
  EXPECT_TRUE(is_close(symmetric_product(A, X), expected));
  EXPECT_TRUE(is_close(weighted_product(0.3, A, X), 0.3 * expected));
  const Vector x = X.col(0);
  Vector y;
  multiply({{&A, &x, &y}});
  EXPECT_TRUE(is_close(y, expected.col(0)));
  A.add_product(x, y);
  EXPECT_TRUE(is_close(y, 2.0 * expected.col(0)));
  // Iterations end at 1e-14 of the residual, scaled by the diagonal.
  const Vector solved = conjugate_gradients(full, x);
  EXPECT_LE((conjugate_gradients(A, x) - solved).norm(), 1e-12 * solved.norm());
  EXPECT_FALSE(A.is_formed());
}

TEST(ByNode, ManyColumnsOnSeveralThreadsHaveTheSameBits) {
  const SymmetricMatrix A =
      SymmetricMatrix::by_node(std::make_shared<const SparseMatrix>(matrices::grid(14, 0.3)));
  const Matrix X = scattered_block(A.rows(), 9, 3);
  TaskPool pool(3);
  EXPECT_EQ(symmetric_product(A, X), symmetric_product(A, X, &pool));
}

TEST(ByNode, IsATermOfASum) {
  const auto nodes = of_nodes();
  const SymmetricMatrix A = SymmetricMatrix::by_node(nodes);
  const SparseMatrix full = entries_of(*nodes);
  const SparseMatrix wide = entries_of(*of_nodes(1.7)) + SparseMatrix(full * full);
  MatrixSum sum, expected;
  for (MatrixSum* of : {&sum, &expected}) of->add(0.5, wide);
  sum.add(-2.0, A);
  expected.add(-2.0, full);
  EXPECT_EQ(Matrix(sum.whole()), Matrix(expected.whole()));
  EXPECT_EQ(Matrix(sum.columns(5, 9, Triangles::lower)),
            Matrix(expected.columns(5, 9, Triangles::lower)));
  EXPECT_EQ(sum.diagonal(), expected.diagonal());
  sum.require_finite();
  EXPECT_FALSE(A.is_formed());
}

TEST(ByNode, EntriesThatAreNotFiniteAreRefused) {
  SparseMatrix nodes = *of_nodes();
  nodes.valuePtr()[7] = std::numeric_limits<double>::quiet_NaN();
  const SymmetricMatrix A =
      SymmetricMatrix::by_node(std::make_shared<const SparseMatrix>(std::move(nodes)));
  MatrixSum sum;
  sum.add(1.0, A);
  EXPECT_THROW(sum.require_finite(), NumericalError);
}

TEST(ByNode, EntriesAreFormedWhenAskedFor) {
  const auto nodes = of_nodes();
  SymmetricMatrix A = SymmetricMatrix::by_node(nodes);
  EXPECT_EQ(Matrix(A.whole()), Matrix(entries_of(*nodes)));
  EXPECT_TRUE(A.is_formed());
  const SymmetricMatrix copy = A;
  EXPECT_EQ(copy.nodes(), nodes.get());
  const SymmetricMatrix moved = std::move(A);
  EXPECT_EQ(moved.nodes(), nodes.get());
  EXPECT_TRUE(moved == copy);
}

TEST(ByNode, GivesTheEigenpairsOfItsEntries) {
  const auto nodes = of_nodes();
  const SymmetricMatrix M = SymmetricMatrix::by_node(nodes);
  Vector squares(M.rows());
  for (Eigen::Index k = 0; k < squares.size(); ++k) squares[k] = 1.0 + static_cast<double>(k);
  const InverseOperator inverse = [&](Matrix& F) { F = squares.cwiseInverse().asDiagonal() * F; };
  const Matrix none(M.rows(), 0);
  const InversePairs found = largest_inverse_pairs(M, inverse, none, {.count = 5});
  const InversePairs expected =
      largest_inverse_pairs(entries_of(*nodes), inverse, none, {.count = 5});
  ASSERT_EQ(found.theta.size(), 5);
  // Of θ the error is the square of that of a shape, 1e-9: rounding of sums of 576 terms is left.
  EXPECT_LE((found.theta - expected.theta).norm(), 1e-13 * expected.theta.norm());
  EXPECT_FALSE(M.is_formed());
}

}  // namespace
}  // namespace buckens::linalg
