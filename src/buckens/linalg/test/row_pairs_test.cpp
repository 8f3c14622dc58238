// SPDX-License-Identifier: Apache-2.0
// Kept pairs of which several processes, here threads, have the rows.
#include <array>

#include <gtest/gtest.h>

#include "buckens/linalg/test/row_threads.h"

namespace buckens::linalg {
namespace {

// Pairs are in single precision.
constexpr double kOfSingle = 3e-7;
constexpr int kLoad = 0, kAnswer = 1, kOther = 2, kWeights = 3;

class RowsOfPairs : public testing::Test {
 protected:
  static constexpr int kSize = 90;

  RowsOfPairs() {
    put(kLoad, c);
    put(kAnswer, x);
    put(kOther, r);
    // The first pair becomes twice both, the second four times the same.
    threads.run(RowThreads::program(RowTask::put_pair, ThreadPairs::kNumber, 0, 1, 2.0, kLoad,
                                    kAnswer, RowTask::put_pair, ThreadPairs::kNumber, 1, 1, 4.0,
                                    kAnswer, kLoad));
  }

  void put(int vector, const Vector& values) { threads.put(vector, values); }
  static Vector random(int seed) {
    std::srand(static_cast<unsigned>(seed));
    return Vector::Random(kSize);
  }

  std::array<SparseMatrix, 6> W;
  Matrix none = Matrix(kSize, 0);
  RowMajorMatrix N = RowMajorMatrix(0, kSize);
  std::vector<int> first = {0, 20, 55, kSize};
  RowThreads threads{
      first, [this](std::size_t k, base::BytesTo& put) {
        const std::vector<std::array<int, 3>> dofs;
        describe_rows(WholeVariables{&W, nullptr, &dofs, &none, &none, &none}, N, first, k, put);
      }};
  Vector c = random(1), x = random(2), r = random(3);
};

TEST_F(RowsOfPairs, HaveProducts) {
  const Vector sums = RowThreads::total(
      threads.run(RowThreads::program(RowTask::pair_products, ThreadPairs::kNumber, 0, 2, kOther)));
  EXPECT_NEAR(sums[0], 2.0 * c.dot(r), kOfSingle * kSize);
  EXPECT_NEAR(sums[1], 4.0 * x.dot(r), kOfSingle * kSize);
}

TEST_F(RowsOfPairs, AreSubtractedAndRounded) {
  threads.run(
      RowThreads::program(RowTask::subtract_loads, ThreadPairs::kNumber, 0, 2, kOther, 0.5, -1.5));
  const Vector found = threads.whole(kOther);
  EXPECT_LE((found - (r - c + 6.0 * x)).norm(), kOfSingle * 6.0 * x.norm());
  EXPECT_EQ(found, Vector(found.cast<float>().cast<double>()));
}

TEST_F(RowsOfPairs, AnswersAreCombinedAndAdded) {
  threads.run(RowThreads::program(RowTask::combine_answers, ThreadPairs::kNumber, 0, 2, 7, false,
                                  0.5, -1.5, RowTask::combine_answers, ThreadPairs::kNumber, 1, 1,
                                  kOther, true, 1.0));
  EXPECT_LE((threads.whole(7) - (x - 6.0 * c)).norm(), kOfSingle * 6.0 * c.norm());
  EXPECT_LE((threads.whole(kOther) - (r + 4.0 * c)).norm(), kOfSingle * 4.0 * c.norm());
}

TEST_F(RowsOfPairs, RowsAreScaled) {
  put(kWeights, Vector(random(4).cwiseAbs().array() + 1.0));
  const Vector weights = threads.whole(kWeights);
  const Vector sums = RowThreads::total(
      threads.run(RowThreads::program(RowTask::scale, 8, kOther, kWeights, false, RowTask::scale, 9,
                                      kOther, kWeights, true, RowTask::square, 8)));
  EXPECT_EQ(threads.whole(8), Vector(r.cwiseProduct(weights)));
  EXPECT_EQ(threads.whole(9), Vector(r.cwiseQuotient(weights)));
  EXPECT_NEAR(sums[0], r.cwiseProduct(weights).squaredNorm(), 1e-12 * kSize);
}

}  // namespace
}  // namespace buckens::linalg
