// SPDX-License-Identifier: Apache-2.0
// Elimination by blocks against dense solves.
#include "buckens/linalg/block_lu.h"

#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace buckens::linalg {
namespace {

using Couples = std::vector<std::pair<int, int>>;

double some_number(int k) { return std::sin(1.0 + 0.7 * k + 0.01 * k * k); }

/// A matrix with the pattern of the couples whose symmetric part is positive definite.
struct Example {
  std::vector<int> sizes;
  Couples couples;
  std::vector<int> first;
  Matrix A;

  Example(std::vector<int> block_sizes, Couples block_couples)
      : sizes(std::move(block_sizes)), couples(std::move(block_couples)) {
    int rows = 0;
    for (const int size : sizes) {
      first.push_back(rows);
      rows += size;
    }
    A = Matrix::Zero(rows, rows);
    int k = 0;
    const auto fill = [&](int i, int j) {
      for (int c = 0; c < sizes[static_cast<std::size_t>(j)]; ++c) {
        for (int r = 0; r < sizes[static_cast<std::size_t>(i)]; ++r) {
          A(first[static_cast<std::size_t>(i)] + r, first[static_cast<std::size_t>(j)] + c) =
              some_number(++k);
        }
      }
    };
    for (int i = 0; i < static_cast<int>(sizes.size()); ++i) fill(i, i);
    for (const auto& [i, j] : couples) {
      fill(i, j);
      fill(j, i);
    }
    // More than the sum of a row and of a column.
    for (Eigen::Index r = 0; r < A.rows(); ++r) {
      A(r, r) = A.row(r).cwiseAbs().sum() + A.col(r).cwiseAbs().sum();
    }
  }

  void enter(BlockLu& lu) const {
    lu.clear();
    const auto put = [&](int i, int j) {
      const int place = lu.place(i, j);
      for (int c = 0; c < sizes[static_cast<std::size_t>(j)]; ++c) {
        for (int r = 0; r < sizes[static_cast<std::size_t>(i)]; ++r) {
          lu.block(place)[c * lu.stride(place) + r] +=
              A(first[static_cast<std::size_t>(i)] + r, first[static_cast<std::size_t>(j)] + c);
        }
      }
    };
    for (int i = 0; i < static_cast<int>(sizes.size()); ++i) put(i, i);
    for (const auto& [i, j] : couples) {
      put(i, j);
      put(j, i);
    }
  }

  void expect_solution(BlockLu& lu) const {
    enter(lu);
    ASSERT_TRUE(lu.factorise());
    EXPECT_GT(lu.pivot_ratio(), 0.1);
    EXPECT_LE(lu.pivot_ratio(), 1.0);
    Vector x(A.rows());
    for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = some_number(static_cast<int>(3 * k));
    Vector found = A * x;
    lu.solve_in_place(found);
    // Diagonally dominant: conditions are near one.
    EXPECT_LE((found - x).norm(), 1e-14 * x.norm());
  }
};

Couples chain(int blocks) {
  Couples out;
  for (int k = 0; k + 1 < blocks; ++k) out.emplace_back(k, k + 1);
  return out;
}

TEST(BlockLu, SolvesChainsOfEveryBlockSize) {
  for (int size = 1; size <= BlockLu::kLargestBlock; ++size) {
    const Example example(std::vector<int>(12, size), chain(12));
    BlockLu lu(example.sizes, example.couples);
    EXPECT_EQ(lu.size(), 12 * size);
    // Nothing fills: 12 blocks on the diagonal and 22 beside it.
    EXPECT_EQ(lu.num_entries(), static_cast<std::size_t>(34 * size * size));
    example.expect_solution(lu);
    example.expect_solution(lu);  // a second matrix in the same place
  }
}

TEST(BlockLu, SolvesBlocksOfUnlikeSize) {
  const Example alike({2, 3, 3, 3, 3}, chain(5));  // filled up
  BlockLu first(alike.sizes, alike.couples);
  EXPECT_EQ(first.num_entries(), 13U * 9U);
  alike.expect_solution(first);
  const Example unlike({1, 6, 1, 1, 2, 1, 1}, chain(7));  // as they are
  BlockLu second(unlike.sizes, unlike.couples);
  EXPECT_LT(second.num_entries(), 19U * 36U);
  unlike.expect_solution(second);
}

TEST(BlockLu, ReadsVectorsInTheGivenOrder) {
  const Example example({3, 2, 3}, chain(3));
  const std::vector<int> rows = {0, 1, 6, 2, 7, 3, 4, 5};
  BlockLu lu(example.sizes, example.couples, rows);
  example.enter(lu);
  constexpr double kMore = 2.5;  // on the diagonal of the row that is the third of the first block
  lu.diagonal(6) += kMore;
  Matrix A = example.A;
  A(2, 2) += kMore;
  ASSERT_TRUE(lu.factorise());
  Vector x(A.rows());
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = some_number(static_cast<int>(3 * k));
  const Vector right = A * x;
  Vector found(x.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    found[rows[k]] = right[static_cast<Eigen::Index>(k)];
  lu.solve_in_place(found);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    // Diagonally dominant: conditions are near one.
    EXPECT_NEAR(found[rows[k]], x[static_cast<Eigen::Index>(k)], 1e-14 * x.norm()) << k;
  }
}

TEST(BlockLu, SolvesTreesLoopsAndCliques) {
  const Example tree(std::vector<int>(7, 3), {{0, 1}, {0, 2}, {1, 3}, {1, 4}, {2, 5}, {2, 6}});
  BlockLu of_tree(tree.sizes, tree.couples);
  EXPECT_EQ(of_tree.num_entries(), 19U * 9U) << "a tree fills nothing";
  tree.expect_solution(of_tree);
  Couples loop = chain(9);
  loop.emplace_back(8, 0);
  loop.emplace_back(3, 4);  // once more
  const Example ring(std::vector<int>(9, 2), {loop.begin(), loop.end() - 1});
  BlockLu of_ring(ring.sizes, loop);
  ring.expect_solution(of_ring);
  Couples all;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < i; ++j) all.emplace_back(i, j);
  }
  const Example clique({5, 3, 5, 4, 5}, all);
  BlockLu of_clique(clique.sizes, all);
  clique.expect_solution(of_clique);
}

TEST(BlockLu, BlocksThatAreAloneChangeNothing) {
  Couples all = chain(6);
  all.emplace_back(0, 5);
  all.emplace_back(1, 4);
  for (const int size : {2, 5}) {
    Example example(std::vector<int>(6, size), all);
    const std::vector<char> alone = {0, 1, 0, 0, 1, 0};
    for (const int block : {1, 4}) {
      const int first = example.first[static_cast<std::size_t>(block)];
      const Matrix own = example.A.block(first, first, size, size);
      example.A.middleRows(first, size).setZero();
      example.A.middleCols(first, size).setZero();
      example.A.block(first, first, size, size) = own;
    }
    BlockLu told(example.sizes, example.couples), untold(example.sizes, example.couples);
    told.set_alone(alone);
    example.expect_solution(told);
    example.expect_solution(untold);
    EXPECT_EQ(told.pivot_ratio(), untold.pivot_ratio());
    Vector x = Vector::LinSpaced(example.A.rows(), -1.0, 2.0), y = x;
    told.solve_in_place(x);
    untold.solve_in_place(y);
    EXPECT_EQ(x, y);  // to the last bit: products with zero are left out, no more
    // And takes part again.
    told.set_alone({});
    Example(std::vector<int>(6, size), all).expect_solution(told);
  }
}

TEST(BlockLu, TakesValuesWhateverBlocksWereAloneBefore) {
  // Matrices come and go with other blocks alone, factorised in between, and leave nothing behind.
  Couples all = chain(6);
  all.emplace_back(0, 5);
  all.emplace_back(1, 4);
  const std::vector<int> sizes(6, 3);
  BlockLu from(sizes, all), to(sizes, all);
  for (const int block : {1, 4, 2, -1, 3, 0}) {
    Example example(sizes, all);
    std::vector<char> alone(block < 0 ? 0 : 6, 0);
    if (block >= 0) {
      alone[static_cast<std::size_t>(block)] = 1;
      const int first = example.first[static_cast<std::size_t>(block)];
      const Matrix own = example.A.block(first, first, 3, 3);
      example.A.middleRows(first, 3).setZero();
      example.A.middleCols(first, 3).setZero();
      example.A.block(first, first, 3, 3) = own;
    }
    from.clear();
    from.set_alone(alone);
    example.enter(from);
    to.take_values(from);
    ASSERT_TRUE(from.factorise() && to.factorise());
    Vector x = Vector::LinSpaced(example.A.rows(), -1.0, 2.0), y = x;
    from.solve_in_place(x);
    to.solve_in_place(y);
    EXPECT_EQ(x, y) << block;
    EXPECT_LE((example.A * x - Vector::LinSpaced(x.size(), -1.0, 2.0)).norm(), 1e-13) << block;
  }
}

TEST(BlockLu, TellsPoorPivots) {
  const Example example({2, 2}, chain(2));
  BlockLu lu(example.sizes, example.couples);
  example.enter(lu);
  lu.diagonal(2) *= -1.0;
  EXPECT_FALSE(lu.factorise());
  example.enter(lu);
  lu.diagonal(0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lu.factorise());
  // Two rows and columns equal up to 1e-9 of the diagonal.
  BlockLu small({2}, {});
  small.clear();
  for (int k = 0; k < 4; ++k) small.block(0)[k] = 1.0;
  small.diagonal(1) += 1e-9;
  ASSERT_TRUE(small.factorise());
  EXPECT_NEAR(small.pivot_ratio(), 1e-9, 1e-15);
  example.expect_solution(lu);  // and recovers
}

TEST(BlockLu, CliquesTakeNoMoreMemoryAndOrderingThanTheirBlocks) {
  // As many springs on one flexible body: all rows are coupled with all. Anything that is kept or
  // looked up for each of the 7e7 products of the elimination would take most of a gigabyte and
  // many seconds.
  const int count = 600;
  Couples all;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < i; ++j) all.emplace_back(i, j);
  }
  const Example example(std::vector<int>(count, 1), all);
  BlockLu lu(example.sizes, all);
  EXPECT_EQ(lu.num_entries(), static_cast<std::size_t>(count * count));
  example.expect_solution(lu);
}

TEST(BlockLu, FillsAsTheOrderOfLeastDegreeDoes) {
  // A wheel: the rim goes first, one block after the other, each time coupling its neighbours; the
  // hub waits. 8 blocks on the rim: pivots with 3, 3, 3, 3, 3, 3, 2, 1 and 0 neighbours.
  Couples wheel = chain(8);
  wheel.emplace_back(7, 0);
  for (int k = 0; k < 8; ++k) wheel.emplace_back(8, k);
  const Example example(std::vector<int>(9, 2), wheel);
  BlockLu lu(example.sizes, wheel);
  EXPECT_EQ(lu.num_entries(), 4U * (9U + 2U * (6U * 3U + 2U + 1U)));
  example.expect_solution(lu);
  // Two cliques of five that have two blocks in common: nothing fills.
  Couples two;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < i; ++j) {
      if (i < 5 || j > 2) two.emplace_back(i, j);
    }
  }
  const Example pair(std::vector<int>(8, 3), two);
  BlockLu of_pair(pair.sizes, two);
  EXPECT_EQ(of_pair.num_entries(), 9U * (8U + 2U * (10U + 10U - 1U)));
  pair.expect_solution(of_pair);
}

TEST(BlockLu, AStarOfTenThousandRaysIsEliminatedFromOutside) {
  const int count = 10001;
  Couples rays;
  for (int k = 1; k < count; ++k) rays.emplace_back(0, k);
  BlockLu lu(std::vector<int>(count, 1), rays);
  EXPECT_EQ(lu.num_entries(), static_cast<std::size_t>(3 * count - 2));
  for (int k = 0; k < count; ++k) lu.diagonal(k) = k == 0 ? 2.0 * count : 1.0;
  for (int k = 1; k < count; ++k) {
    *lu.block(lu.place(0, k)) = 1.0;
    *lu.block(lu.place(k, 0)) = 1.0;
  }
  ASSERT_TRUE(lu.factorise());
  Vector x = Vector::Zero(count);
  x[0] = 1.0;
  lu.solve_in_place(x);
  EXPECT_NEAR(x[0] * (count + 1.0), 1.0, 1e-12);  // 2 count − (count − 1) is left of the centre
  EXPECT_NEAR(x[count - 1] * (count + 1.0), -1.0, 1e-12);
}

TEST(BlockLu, AChainOfTenThousandIsOrderedInItsOwnOrder) {
  const int count = 10000;
  BlockLu lu(std::vector<int>(count, 1), chain(count));
  EXPECT_EQ(lu.num_entries(), static_cast<std::size_t>(3 * count - 2));
  lu.clear();
  for (int k = 0; k < count; ++k) lu.diagonal(k) = 2.0;
  for (int k = 0; k + 1 < count; ++k) {
    *lu.block(lu.place(k, k + 1)) = -1.0;
    *lu.block(lu.place(k + 1, k)) = -1.0;
  }
  ASSERT_TRUE(lu.factorise());
  EXPECT_NEAR(lu.pivot_ratio(), 0.5 * (count + 1.0) / count, 1e-9);  // pivots (k+1)/k
  // -x'' = const: a parabola.
  Vector x = Vector::Ones(count);
  lu.solve_in_place(x);
  EXPECT_NEAR(x[count / 2], 0.5 * (count / 2 + 1.0) * (count / 2), 1e-6 * x[count / 2]);
}

}  // namespace
}  // namespace buckens::linalg
