// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_order.h"

#include <gmock/gmock.h>

#include "buckens/linalg/symmetric_matrix.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

using testing::ElementsAre;

TEST(RowOrder, CountsThroughThePartsAndKeepsTheOrderOfVariables) {
  const RowOrder order({2, 0, 2, 0, 2}, 4);
  EXPECT_THAT(order.variables(), ElementsAre(1, 3, 0, 2, 4));
  EXPECT_THAT(order.rows(), ElementsAre(2, 0, 3, 1, 4));
  EXPECT_THAT(order.first_rows(), ElementsAre(0, 2, 2, 5, 5)) << "two parts are empty";
}

TEST(RowOrder, BringsVectorsThereAndBack) {
  const auto order = std::make_shared<const RowOrder>(std::vector{1, 0, 1, 0}, 2);
  const std::vector<double> x = {10, 11, 12, 13};
  EXPECT_THAT(order->by_rows(x.data()), ElementsAre(11, 13, 10, 12));
  std::vector<double> back(4);
  fill_by_rows(order, back.data(), [&](double* rows) {
    for (const double value : order->by_rows(x.data())) *rows++ = value;
  });
  EXPECT_EQ(back, x);
  fill_by_rows({}, back.data(), [](double* rows) { rows[0] = 5; });
  EXPECT_THAT(back, ElementsAre(5, 11, 12, 13)) << "without an order nothing moves";
}

TEST(RowOrder, IsTheSameByContent) {
  const auto make = [](std::vector<int> part) {
    return std::make_shared<const RowOrder>(std::move(part), 2);
  };
  const SharedRowOrder a = make({1, 0, 1});
  EXPECT_TRUE(is_same_order(a, make({1, 0, 1})));
  EXPECT_FALSE(is_same_order(a, make({0, 1, 1})));
  EXPECT_FALSE(is_same_order(make({0, 0, 1}), make({0, 1, 1}))) << "other runs of the same order";
  EXPECT_FALSE(is_same_order(a, nullptr));
  EXPECT_TRUE(is_same_order(nullptr, nullptr));
}

TEST(RowOrder, RenumbersMatrices) {
  SparseMatrix A = matrices::grid(5, 0.3);
  A.coeffRef(0, 1) += 0.5;  // not symmetric: nothing may be transposed
  std::vector<int> part;
  for (int k = 0; k < A.cols(); ++k) part.push_back(k * k % 7 % 3);
  const RowOrder order(part, 3);
  const SparseMatrix B = renumbered(A, order.rows());
  const Matrix whole = A;
  const Matrix found = B;
  for (int i = 0; i < A.rows(); ++i) {
    for (int j = 0; j < A.cols(); ++j) {
      ASSERT_EQ(found(order.row(i), order.row(j)), whole(i, j)) << i << ' ' << j;
    }
  }
  for (int j = 0; j < B.cols(); ++j) {
    int last = -1;
    for (SparseMatrix::InnerIterator it(B, j); it; ++it) {
      ASSERT_GT(it.row(), last);
      last = static_cast<int>(it.row());
    }
  }
  EXPECT_EQ(Matrix(renumbered(B, order.variables())), whole) << "and back";
}

}  // namespace
}  // namespace buckens::linalg
