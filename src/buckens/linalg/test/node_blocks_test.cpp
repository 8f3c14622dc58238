// SPDX-License-Identifier: Apache-2.0
// Blocks of nodes against the sparse matrix that they are made of. Sums go in the order of Eigen's,
// so that all bits must be equal.
#include "buckens/linalg/node_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/base/task_pool.h"
#include "buckens/linalg/conjugate_gradients.h"
#include "buckens/linalg/elimination_order.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/same_bits.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/tall_products.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

/// Nodes coupled at random, definite. @param left_out share of the entries beside the diagonal that
/// have no place in the pattern
SparseMatrix random_blocks(int nodes, int per_node, double left_out) {
  const Matrix pairs = scattered_block(nodes, per_node, 11);
  const Matrix numbers = scattered_block(nodes * per_node, 18, 4);
  std::vector<Triplet> entries;
  const auto put = [&](int row, int column, double value, double lot) {
    if (row == column || 0.5 * (lot + 1.0) < left_out) return;
    entries.emplace_back(row, column, value);
    entries.emplace_back(column, row, value);
  };
  for (int k = 0; k < pairs.size(); ++k) {
    const int a = k % nodes;
    const int b = static_cast<int>(0.5 * (pairs(a, k / nodes) + 1.0) * nodes);
    for (int e = 0; e < 9; ++e) {
      if (a == b && e / 3 <= e % 3) continue;
      put(3 * a + e / 3, 3 * b + e % 3, numbers(k, e), numbers(k, 9 + e));
    }
  }
  for (int k = 0; k < 3 * nodes; ++k) entries.emplace_back(k, k, 9.0 * per_node + 0.1 * k);
  SparseMatrix A(3 * nodes, 3 * nodes);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// With zeros that the pattern has.
SparseMatrix with_zeros() {
  SparseMatrix A = matrices::grid(4, 0.3);
  for (int k = 0; k < A.cols(); k += 5) {
    for (SparseMatrix::InnerIterator it(A, k); it; ++it) {
      if (it.row() % 7 == 0 && it.row() != k) A.coeffRef(it.row(), k) = A.coeffRef(k, it.row()) = 0;
    }
  }
  return A;
}

std::vector<SparseMatrix> examples() {
  return {matrices::grid(4, 0.3), with_zeros(), random_blocks(40, 6, 0.0),
          random_blocks(40, 6, 0.3)};
}

SymmetricMatrix in_blocks(SparseMatrix A) {
  SymmetricMatrix out = SymmetricMatrix::in_blocks(std::move(A));
  EXPECT_NE(out.blocks(), nullptr);
  return out;
}

TEST(NodeBlocks, HaveTheEntriesOfTheMatrix) {
  for (const SparseMatrix& A : examples()) {
    const auto blocks = NodeBlocks::of(A);
    ASSERT_NE(blocks, nullptr);
    EXPECT_EQ(blocks->size(), A.cols());
    EXPECT_EQ(blocks->nonZeros(), A.nonZeros());
    EXPECT_TRUE(have_same_bits(blocks->whole(), A));
    EXPECT_EQ(blocks->diagonal(), Vector(A.diagonal()));
    EXPECT_EQ(blocks->norm(), A.norm());
    EXPECT_EQ(blocks->content(), SymmetricMatrix(A).content());
    EXPECT_TRUE(blocks->is_finite());
    for (int row = 0; row < A.rows(); ++row) {
      for (int column = 0; column < A.cols(); ++column) {
        ASSERT_EQ(blocks->coeff(row, column), A.coeff(row, column));
      }
    }
  }
}

TEST(NodeBlocks, GoThroughAColumnFromAnyRowOn) {
  for (const SparseMatrix& A : examples()) {
    const auto blocks = NodeBlocks::of(A);
    ASSERT_NE(blocks, nullptr);
    for (int column = 0; column < A.cols(); ++column) {
      for (int from = 0; from < A.rows(); from += 1 + from % 5) {
        NodeBlocks::Column found(*blocks, column, from);
        for (SparseMatrix::InnerIterator it(A, column); it; ++it) {
          if (it.row() < from) continue;
          ASSERT_TRUE(found);
          ASSERT_EQ(found.row(), it.row());
          ASSERT_EQ(found.value(), it.value());
          ++found;
        }
        ASSERT_FALSE(found);
      }
    }
  }
}

TEST(NodeBlocks, ProductsHaveTheBitsOfThoseOfTheMatrix) {
  for (const SparseMatrix& A : examples()) {
    const auto blocks = NodeBlocks::of(A);
    const Matrix X = scattered_block(A.rows(), 2, 2);
    const Vector x = X.col(0);
    Vector y(A.rows()), expected = A * x;
    blocks->multiply(x.data(), y.data());
    EXPECT_EQ(y, expected);
    y = X.col(1);
    expected = y;
    blocks->add_product(x.data(), y.data());
    expected.noalias() += A * x;
    EXPECT_EQ(y, expected);
  }
}

TEST(NodeBlocks, TakeTwoFifthsOfTheMemoryOfSolids) {
  const SparseMatrix A = matrices::grid(12, 0.3);
  const double sparse = 12.0 * static_cast<double>(A.nonZeros());
  EXPECT_LT(NodeBlocks::of(A)->bytes(), 0.42 * sparse);
  // Bits of the pattern for each block.
  const SparseMatrix B = random_blocks(300, 12, 0.05);
  EXPECT_LT(NodeBlocks::of(B)->bytes(), 0.45 * 12.0 * static_cast<double>(B.nonZeros()));
}

TEST(NodeBlocks, AreNotMadeOfOtherMatrices) {
  const SparseMatrix A = matrices::grid(4, 0.3);
  ASSERT_NE(NodeBlocks::of(A), nullptr);
  SparseMatrix changed = A;
  changed.coeffRef(4, 2) = std::nextafter(changed.coeff(4, 2), 1.0);
  EXPECT_EQ(NodeBlocks::of(changed), nullptr) << "not symmetric, below the diagonal blocks";
  changed = A;
  changed.coeffRef(0, 1) = std::nextafter(changed.coeff(0, 1), 1.0);
  EXPECT_EQ(NodeBlocks::of(changed), nullptr) << "not symmetric, in a diagonal block";
  using Place = std::pair<int, int>;
  for (const Place& missing : {Place{4, 2}, Place{2, 4}, Place{0, 1}, Place{1, 0}}) {
    changed = A;
    changed.prune([&](Eigen::Index row, Eigen::Index column, double) {
      return Place(row, column) != missing;
    });
    ASSERT_EQ(changed.nonZeros() + 1, A.nonZeros());
    EXPECT_EQ(NodeBlocks::of(changed), nullptr) << missing.first << " " << missing.second;
  }
  changed = A;
  changed.prune([](Eigen::Index row, Eigen::Index column, double) {
    return row / 3 != 5 || column / 3 != 5;
  });
  EXPECT_EQ(NodeBlocks::of(changed), nullptr) << "a node has no block of its own";
  EXPECT_EQ(NodeBlocks::of(matrices::diagonal(9)), nullptr) << "takes more memory";
  EXPECT_EQ(NodeBlocks::of(matrices::dense_definite(10)), nullptr);
  EXPECT_EQ(NodeBlocks::of(SparseMatrix(0, 0)), nullptr);
  EXPECT_EQ(NodeBlocks::of(SparseMatrix(6, 9)), nullptr);
}

TEST(MatrixInBlocks, AnswersAsItsEntriesDoWithoutFormingThem) {
  const SparseMatrix entries = with_zeros();
  const SymmetricMatrix full(entries);
  const SymmetricMatrix A = in_blocks(entries);
  EXPECT_EQ(A.rows(), full.rows());
  EXPECT_EQ(A.cols(), full.cols());
  EXPECT_EQ(A.nonZeros(), full.nonZeros());
  EXPECT_EQ(A.diagonal(), full.diagonal());
  EXPECT_EQ(A.norm(), full.norm());
  EXPECT_EQ(A.content(), full.content());
  EXPECT_TRUE(A == full);
  EXPECT_TRUE(full == A);
  EXPECT_TRUE(A == in_blocks(entries));
  EXPECT_FALSE(A == in_blocks(matrices::grid(4, 0.3)));
  EXPECT_FALSE(A == SymmetricMatrix(matrices::grid(4, 0.3)));
  std::vector<int> lengths(static_cast<std::size_t>(A.cols()), 2);
  lengths[0] = 7;
  lengths.back() = 1;
  EXPECT_EQ(A.near_diagonal(lengths), full.near_diagonal(lengths));
  EXPECT_TRUE(have_same_bits(A.copied(), entries));
  EXPECT_FALSE(A.is_formed());
}

TEST(MatrixInBlocks, MultipliesWithTheBitsOfItsEntries) {
  const SparseMatrix full = random_blocks(40, 6, 0.3);
  const SymmetricMatrix A = in_blocks(full);
  const Matrix X = scattered_block(A.rows(), 11, 2);
  const Vector x = X.col(0);
  EXPECT_EQ(Matrix(A * X), Matrix(full * X));
  EXPECT_EQ(Vector(A * (2.0 * x)), Vector(full * (2.0 * x)));
  EXPECT_EQ(symmetric_product(A, X), symmetric_product(full, X));
  Vector y, expected = full * x;
  multiply({{&A, &x, &y}});
  EXPECT_EQ(y, expected);
  A.add_product(x, y);
  expected.noalias() += full * x;
  EXPECT_EQ(y, expected);
  EXPECT_EQ(conjugate_gradients(A, x), conjugate_gradients(full, x));
  EXPECT_EQ(weighted_product(0.3, A, X), weighted_product(0.3, full, X));
  EXPECT_FALSE(A.is_formed());
}

TEST(MatrixInBlocks, ManyColumnsOnSeveralThreadsHaveTheSameBits) {
  const SymmetricMatrix A = in_blocks(matrices::grid(14, 0.3));
  const Matrix X = scattered_block(A.rows(), 9, 3);
  TaskPool pool(3);
  EXPECT_EQ(symmetric_product(A, X), symmetric_product(A, X, &pool));
}

TEST(MatrixInBlocks, IsFormedWhenAskedFor) {
  const SparseMatrix full = matrices::grid(4, 0.3);
  SymmetricMatrix A = in_blocks(full);
  EXPECT_TRUE(have_same_bits(A.whole(), full));
  EXPECT_TRUE(A.is_formed());
  const SymmetricMatrix copy = A;
  EXPECT_NE(copy.blocks(), nullptr);
  const SymmetricMatrix moved = std::move(A);
  EXPECT_TRUE(moved == copy);
  EXPECT_TRUE(have_same_bits(moved.copied(), full));
}

TEST(MatrixInBlocks, OthersStayWhole) {
  SparseMatrix unsymmetric = matrices::grid(4, 0.3);
  unsymmetric.coeffRef(4, 2) = std::nextafter(unsymmetric.coeff(4, 2), 1.0);
  for (const SparseMatrix& A : {unsymmetric, matrices::grid(2, 0.3), SparseMatrix(30, 30)}) {
    SparseMatrix given = A;
    const SymmetricMatrix out = SymmetricMatrix::in_blocks(std::move(given));
    EXPECT_EQ(out.blocks(), nullptr);
    EXPECT_TRUE(out.is_formed());
    EXPECT_TRUE(have_same_bits(out.whole(), A));
  }
}

/// As K̂ = m M + k K + c C of solids, M by node, with entries of another term that K has not.
struct SumWithBlocks {
  explicit SumWithBlocks(int n)
      : full(matrices::grid(n, 0.3)), K(in_blocks(full)), C(in_blocks(SparseMatrix(1e-3 * full))) {
    const auto nodes = std::make_shared<SparseMatrix>(full.cols() / 3, full.cols() / 3);
    nodes->setIdentity();
    M = SymmetricMatrix::by_node(nodes);
    beside.resize(full.rows(), full.cols());
    const auto far = static_cast<int>(full.rows()) - 2;
    const std::vector<Triplet> entries = {{0, far, 0.01}, {far, 0, 0.01}};
    beside.setFromTriplets(entries.begin(), entries.end());
    sum.add(7.7, M);
    sum.add(1.0 / 3.0, K);
    sum.add(1.9, beside);
    sum.add(0.7, C);
    whole_M = M.copied();
    whole_C = C.copied();
    expected.add(7.7, whole_M);
    expected.add(1.0 / 3.0, full);
    expected.add(1.9, beside);
    expected.add(0.7, whole_C);
  }

  SparseMatrix full, whole_M, whole_C, beside;
  SymmetricMatrix K, C, M;
  MatrixSum sum, expected;
};

TEST(MatrixInBlocks, IsATermOfASum) {
  const SumWithBlocks of(4);
  EXPECT_TRUE(have_same_bits(of.sum.whole(), of.expected.whole()));
  for (const Triangles which : {Triangles::both, Triangles::lower}) {
    EXPECT_TRUE(have_same_bits(of.sum.columns(5, 9, which), of.expected.columns(5, 9, which)));
  }
  EXPECT_EQ(of.sum.diagonal(), of.expected.diagonal());
  const ColumnGraph graph = column_graph(of.sum), expected = column_graph(of.expected);
  EXPECT_EQ(graph.columns, expected.columns);
  EXPECT_EQ(graph.begin, expected.begin);
  EXPECT_EQ(graph.neighbours, expected.neighbours);
  MatrixSum stiffness;
  stiffness.add(2.0, of.K);
  const double product = inner_product(of.sum, stiffness);
  EXPECT_EQ(product, inner_product(of.expected, stiffness));
  const SparseMatrix twice = 2.0 * of.full;
  EXPECT_EQ(product, of.expected.whole().cwiseProduct(twice).sum());
  EXPECT_EQ(inner_product(of.sum, of.sum), of.expected.whole().squaredNorm());
  of.sum.form_terms();
  of.sum.require_finite();
  EXPECT_FALSE(of.K.is_formed());
}

/// Nodes of a grid, all three variables of which are coupled with all of their neighbours.
SparseMatrix coupled_nodes(int n) {
  const SparseMatrix nodes = matrices::grid(n, 0.3);
  std::vector<Triplet> entries;
  for (int column = 0; column < nodes.cols(); ++column) {
    for (SparseMatrix::InnerIterator it(nodes, column); it; ++it) {
      for (int k = 0; k < 9; ++k) {
        const double value = it.value() * (k % 4 == 0 ? 1.0 : 0.1);
        entries.emplace_back(3 * static_cast<int>(it.row()) + k / 3, 3 * column + k % 3, value);
      }
    }
  }
  SparseMatrix out(3 * nodes.rows(), 3 * nodes.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

void expect_graph_of_whole(const MatrixSum& sum) {
  const ColumnGraph graph = column_graph(sum), expected = column_graph(sum.whole());
  EXPECT_EQ(graph.first_column, expected.first_column);
  EXPECT_EQ(graph.columns, expected.columns);
  EXPECT_EQ(graph.begin, expected.begin);
  EXPECT_EQ(graph.neighbours, expected.neighbours);
}

TEST(MatrixInBlocks, TheGraphIsThatOfNodesWhereAllOfTheirVariablesAreCoupled) {
  const SparseMatrix full = coupled_nodes(5);
  const SymmetricMatrix K = in_blocks(full), C = in_blocks(SparseMatrix(1e-3 * full));
  ASSERT_NE(K.blocks(), nullptr);
  ASSERT_TRUE(K.blocks()->has_whole_blocks());
  const SymmetricMatrix M =
      SymmetricMatrix::by_node(std::make_shared<SparseMatrix>(matrices::grid(5, 0.3)));
  MatrixSum sum;
  sum.add(7.7, M);
  sum.add(0.3, K);
  expect_graph_of_whole(sum);
  sum.add(0.1, C);
  expect_graph_of_whole(sum);
}

TEST(MatrixInBlocks, TheGraphCountsMassesBetweenNodesWithoutStiffness) {
  const SymmetricMatrix K = in_blocks(coupled_nodes(5));
  auto nodes = std::make_shared<SparseMatrix>(K.cols() / 3, K.cols() / 3);
  nodes->setIdentity();
  const int last = static_cast<int>(nodes->cols()) - 1;
  nodes->coeffRef(0, last) = nodes->coeffRef(last, 0) = 0.01;
  nodes->makeCompressed();
  const SymmetricMatrix M = SymmetricMatrix::by_node(nodes);
  MatrixSum sum;
  sum.add(7.7, M);
  sum.add(0.3, K);
  expect_graph_of_whole(sum);
}

TEST(MatrixInBlocks, FactorsHaveTheBitsOfThoseOfWholeMatrices) {
  const SumWithBlocks of(9);
  const Vector b = scattered_block(of.full.cols(), 1, 3);
  for (const int threads : {1, 2}) {
    const base::AllowedThreads allowed(threads);
    Vector x = b, expected = b;
    SparseCholesky(of.sum).solve_in_place(x);
    SparseCholesky(of.expected).solve_in_place(expected);
    EXPECT_EQ(x, expected) << threads;
  }
  EXPECT_FALSE(of.K.is_formed());
}

TEST(MatrixInBlocks, EntriesThatAreNotFiniteAreRefused) {
  SparseMatrix full = matrices::grid(4, 0.3);
  full.coeffRef(4, 2) = full.coeffRef(2, 4) = std::numeric_limits<double>::quiet_NaN();
  const SymmetricMatrix A = in_blocks(full);
  MatrixSum sum;
  sum.add(1.0, A);
  EXPECT_THROW(sum.require_finite(), NumericalError);
}

}  // namespace
}  // namespace buckens::linalg
