// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/predicted_factor.h"

#include <gtest/gtest.h>

#include "buckens/linalg/multifrontal.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

TEST(PredictedFactor, IsWhatTheFactorTakes) {
  for (const int nodes : {4, 9, 14}) {
    const SparseMatrix A = matrices::grid(nodes, 0.1);
    const PredictedFactor predicted = predict_factor(A);
    const SparseCholesky factor(A);
    // Panels begin at whole cache lines, wherever their supernode does.
    EXPECT_GT(predicted.bytes, 0.8 * factor.bytes()) << nodes;
    EXPECT_LT(predicted.bytes, 1.25 * factor.bytes()) << nodes;
    EXPECT_GT(predicted.peak, predicted.bytes);
    EXPECT_LT(predicted.peak, 3.0 * predicted.bytes);
    EXPECT_LT(8.0 * factor.num_factor_entries(), most_factor_bytes(A.rows()));
  }
}

TEST(PredictedFactor, IsWhatOneThreadTakesAtMost) {
  for (const int nodes : {4, 9, 14}) {
    const SparseMatrix A = matrices::grid(nodes, 0.1);
    const double most = factorise_fronts(
        A, find_supernode_tree(A), [](int, int, int, const double*, std::ptrdiff_t) {}, nullptr);
    const double predicted = predict_factor(A).peak;  // rows rounded up to whole cache lines
    EXPECT_GE(predicted, most) << nodes;
    EXPECT_LE(predicted, 1.25 * most) << nodes;
  }
}

TEST(PredictedFactor, OfADiagonalIsTheDiagonal) {
  SparseMatrix A(100, 100);
  A.setIdentity();
  EXPECT_GE(predict_factor(A).bytes, 800.0);
  EXPECT_LE(predict_factor(A).bytes, most_factor_bytes(100));
}

}  // namespace
}  // namespace buckens::linalg
