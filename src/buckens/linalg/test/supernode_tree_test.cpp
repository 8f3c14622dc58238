// SPDX-License-Identifier: Apache-2.0
// Order and structure of factors against elimination done entry by entry.
#include "buckens/linalg/supernode_tree.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/linalg/elimination_order.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

using Rows = std::vector<std::set<int>>;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// Rows below the diagonal of each column of L: columns hand theirs to the first of them.
Rows eliminate(const SparseMatrix& A, const std::vector<int>& permutation) {
  std::vector<int> place(permutation.size());
  for (std::size_t k = 0; k < permutation.size(); ++k) {
    place[at(permutation[k])] = static_cast<int>(k);
  }
  Rows rows(permutation.size());
  for (int j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      const int a = place[at(static_cast<int>(it.row()))];
      const int b = place[at(j)];
      if (a != b) rows[at(std::min(a, b))].insert(std::max(a, b));
    }
  }
  for (const std::set<int>& column : rows) {
    if (column.empty()) continue;
    const int parent = *column.begin();
    for (const int row : column) {
      if (row != parent) rows[at(parent)].insert(row);
    }
  }
  return rows;
}

bool is_permutation(std::vector<int> numbers, int n) {
  std::vector<int> all(at(n));
  std::iota(all.begin(), all.end(), 0);
  std::sort(numbers.begin(), numbers.end());
  return numbers == all;
}

std::vector<SparseMatrix> all_kinds() {
  return {matrices::grid(5, 0.1),
          matrices::random_definite(400, 2),
          matrices::random_definite(300, 8),
          matrices::dense_definite(150),
          matrices::diagonal(20),
          matrices::grid(10, 0.1)};
}

TEST(SupernodeTree, HoldsEveryEntryOfTheFactor) {
  for (const SparseMatrix& A : all_kinds()) {
    const SupernodeTree tree = find_supernode_tree(A);
    ASSERT_TRUE(is_permutation(tree.permutation, tree.size));
    const Rows rows = eliminate(A, tree.permutation);
    double entries = 0.0, products = 0.0, stored = 0.0;
    for (int s = 0; s < tree.count; ++s) {
      const int* below = tree.rows_of(s);
      const int end = tree.first_column[at(s + 1)];
      ASSERT_TRUE(std::is_sorted(below, below + tree.rows_below(s)));
      for (int c = tree.first_column[at(s)]; c < end; ++c) {
        for (const int row : rows[at(c)]) {
          ASSERT_TRUE(row < end || std::binary_search(below, below + tree.rows_below(s), row))
              << "entry " << row << ", " << c;
        }
        const double length = 1.0 + static_cast<double>(rows[at(c)].size());
        entries += length;
        products += length * length;
        stored += end - c + tree.rows_below(s);
      }
    }
    EXPECT_EQ(tree.num_entries, entries);
    EXPECT_EQ(tree.num_products, products);
    // Four columns may be joined whatever that stores: in very sparse factors as many zeros as
    // entries (1.97 measured), in that of a solid mesh of 3000 variables few.
    EXPECT_LE(stored, (tree.size < 2000 ? 2.5 : 1.1) * entries) << tree.size;
  }
}

TEST(SupernodeTree, HasSubtreesThatAreRuns) {
  for (const SparseMatrix& A : all_kinds()) {
    const SupernodeTree tree = find_supernode_tree(A);
    std::vector<int> begin(at(tree.count));
    std::iota(begin.begin(), begin.end(), 0);
    std::vector<int> size(at(tree.count), 1);
    for (int s = 0; s < tree.count; ++s) {
      EXPECT_EQ(begin[at(s)], s + 1 - size[at(s)]) << "a run";
      const int p = tree.parent[at(s)];
      EXPECT_EQ(p < 0, tree.rows_below(s) == 0);
      if (p < 0) continue;
      ASSERT_GT(p, s);
      EXPECT_GE(tree.rows_of(s)[0], tree.first_column[at(p)]);
      EXPECT_LT(tree.rows_of(s)[0], tree.first_column[at(p + 1)]);
      begin[at(p)] = std::min(begin[at(p)], begin[at(s)]);
      size[at(p)] += size[at(s)];
    }
  }
}

TEST(ColumnGraph, TakesTheVariablesOfANodeAsOne) {
  const ColumnGraph graph = column_graph(matrices::grid(4, 0.1));
  ASSERT_EQ(graph.size(), 64);
  for (int v = 0; v < graph.size(); ++v) EXPECT_EQ(graph.weight(v), 3);
  const auto neighbours = [&graph](int v) { return graph.begin[at(v + 1)] - graph.begin[at(v)]; };
  EXPECT_EQ(neighbours(0), 7) << "a corner";
  EXPECT_EQ(neighbours(21), 26) << "inside";
}

TEST(ColumnGraph, CountsAnEntryOfOneTriangleForBoth) {
  SparseMatrix A = matrices::diagonal(4);
  A.coeffRef(3, 1) = 0.5;  // without its mirror image, and not compressed
  const ColumnGraph graph = column_graph(A);
  ASSERT_EQ(graph.size(), 4);
  EXPECT_EQ(graph.begin, (std::vector<int>{0, 0, 1, 1, 2}));
  EXPECT_EQ(graph.neighbours, (std::vector<int>{3, 1}));
}

/// Processes that have some entries each add up marks and list edges (divided_graph.h).
TEST(ColumnGraph, FollowsFromMarksAndEdges) {
  for (const SparseMatrix& A : all_kinds()) {
    std::vector<std::uint64_t> marks(at(static_cast<int>(A.cols())), 0);
    const auto visit_lower = [&A](auto&& visit) {
      for (int j = 0; j < A.outerSize(); ++j) {
        for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
          if (it.row() >= j) visit(static_cast<int>(it.row()), j);
        }
      }
    };
    const auto mark = [](int row) {
      return std::uint64_t{0x9e3779b97f4a7c15U} * static_cast<std::uint64_t>(row * row + 7);
    };
    visit_lower([&](int i, int j) {
      marks[at(j)] += mark(i);
      if (i != j) marks[at(i)] += mark(j);
    });
    const std::vector<int> vertex = vertices_of(marks);
    std::vector<int> edges;
    visit_lower([&](int i, int j) {
      if (vertex[at(i)] != vertex[at(j)]) edges.insert(edges.end(), {vertex[at(i)], vertex[at(j)]});
    });
    const ColumnGraph found = graph_of(vertex, edges);
    const ColumnGraph expected = column_graph(A);
    EXPECT_EQ(found.first_column, expected.first_column);
    EXPECT_EQ(found.columns, expected.columns);
    EXPECT_EQ(found.begin, expected.begin);
    EXPECT_EQ(found.neighbours, expected.neighbours);
  }
}

TEST(EliminationOrder, IsTheSameEveryTime) {
  for (const int n : {5, 11}) {  // by least degree, by nested dissection
    const ColumnGraph graph = column_graph(matrices::grid(n, 0.1));
    const std::vector<int> order = elimination_order(graph);
    EXPECT_TRUE(is_permutation(order, graph.size()));
    EXPECT_EQ(elimination_order(graph), order);
  }
}

}  // namespace
}  // namespace buckens::linalg
