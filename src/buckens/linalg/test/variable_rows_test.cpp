// SPDX-License-Identifier: Apache-2.0
// Rows of a body of any elements and constraints in several processes, here threads, against the
// same of whole vectors.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/test/definite_matrices.h"
#include "buckens/linalg/test/row_threads.h"
#include "buckens/linalg/variable_inertia.h"

namespace buckens::linalg {
namespace {

// Sums of some thousand products of numbers of about one, in another order.
constexpr double kOfOtherSum = 1e-12;

/// Numbers between variables that differ by little, so that runs have borders.
SparseMatrix band(int size, int seed, bool is_symmetric) {
  std::srand(static_cast<unsigned>(seed));
  std::vector<Triplet> entries;
  for (int i = 0; i < size; ++i) {
    for (int j = std::max(0, i - 5); j <= i; j += 2) {
      const Eigen::Vector2d value = Eigen::Vector2d::Random();
      entries.emplace_back(i, j, value[0]);
      if (j != i) entries.emplace_back(j, i, is_symmetric ? value[0] : value[1]);
    }
  }
  SparseMatrix out(size, size);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Translations of nodes in an order of their own, among other variables; some have less than
/// three.
std::vector<std::array<int, 3>> scattered_dofs(int nodes, int size) {
  std::vector<std::array<int, 3>> out;
  for (int node = 0; node < nodes; ++node) {
    const int first = (4 * node + 8) % (size - 2);
    out.push_back({first, node % 5 == 0 ? -1 : first + 2, node % 7 == 0 ? -1 : first + 1});
  }
  return out;
}

/// As variables are numbered, or in an order in which neighbours are apart.
class RowsOfVariables : public testing::TestWithParam<bool> {
 protected:
  static constexpr int kSize = 331;

  RowsOfVariables() {
    threads.put(0, d);
    threads.put(1, rate);
    threads.put(2, acceleration);
  }

  static SharedRowOrder scattered() {
    std::vector<int> part;
    for (int k = 0; k < kSize; ++k) part.push_back(k * k % 7 % 3);
    return std::make_shared<const RowOrder>(part, 3);
  }
  static Vector random(int seed) {
    std::srand(static_cast<unsigned>(seed));
    return Vector::Random(kSize);
  }

  /// W_ab, of nodes included.
  Matrix integral(int a, int b) const {
    static constexpr int kPlace[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    const SparseMatrix& stored = W[static_cast<std::size_t>(kPlace[a][b])];
    Matrix out = Matrix::Zero(kSize, kSize);
    if (stored.nonZeros() > 0) out = a <= b ? Matrix(stored) : Matrix(stored.transpose());
    for (int node = 0; node < Ms.outerSize(); ++node) {
      for (SparseMatrix::InnerIterator it(Ms, node); it; ++it) {
        const int row = dofs[static_cast<std::size_t>(it.row())][static_cast<std::size_t>(a)];
        const int column = dofs[static_cast<std::size_t>(node)][static_cast<std::size_t>(b)];
        if (row >= 0 && column >= 0) out(row, column) += it.value();
      }
    }
    return out;
  }

  // W_13 and W_22 are zero.
  std::array<SparseMatrix, 6> W = {band(kSize, 1, true),       SparseMatrix(),
                                   band(kSize, 3, true),       band(kSize, 4, false),
                                   SparseMatrix(kSize, kSize), band(kSize, 6, false)};
  SparseMatrix Ms = matrices::grid(4, 0.3);
  std::vector<std::array<int, 3>> dofs = scattered_dofs(static_cast<int>(Ms.cols()), kSize);
  Matrix Phi = Matrix::Random(kSize, 5), P = Matrix::Random(kSize, 5);
  Matrix patterns = Matrix::Random(kSize, 6);
  RowMajorMatrix N = RowMajorMatrix(0, kSize);
  SharedRowOrder order = GetParam() ? scattered() : nullptr;
  std::vector<int> first = order ? order->first_rows() : std::vector{0, 50, 160, kSize};
  RowThreads threads{
      first,
      [this](std::size_t k, base::BytesTo& put) {
        describe_rows(WholeVariables{&W, &Ms, &dofs, &Phi, &P, &patterns, order}, N, first, k, put);
      },
      order};
  Vector d = random(1), rate = random(2), acceleration = random(3);
};

TEST_P(RowsOfVariables, CoupleAcrossBorders) {
  const Eigen::Matrix3d A = Eigen::Matrix3d::Random(), B = Eigen::Matrix3d::Random();
  Eigen::Matrix<double, 4, 6> weights = Eigen::Matrix<double, 4, 6>::Zero();
  weights.topRows<3>() << A, B;
  base::BytesTo put = RowThreads::program(RowTask::couple, 3, 0, 1, 2);
  put.all(weights.data(), kCoupleWeights);
  const Vector sums = RowThreads::total(threads.run(put));
  const Eigen::Map<const Eigen::Matrix<double, 4, 9>> found(sums.data());

  Vector load = Vector::Zero(kSize);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const Matrix of = integral(a, b);
      load += A(a, b) * (of * d) + B(a, b) * (of * rate);
      EXPECT_NEAR(found(a, b), d.dot(of * d), kOfOtherSum * kSize) << a << b;
      EXPECT_NEAR(found(a, 3 + b), d.dot(of * rate), kOfOtherSum * kSize) << a << b;
      EXPECT_NEAR(found(a, 6 + b), d.dot(of * acceleration), kOfOtherSum * kSize) << a << b;
    }
  }
  EXPECT_GT(load.norm(), 1.0);
  EXPECT_LE((threads.whole(3) - load).norm(), kOfOtherSum * load.norm());
}

TEST_P(RowsOfVariables, CoupleWithoutLoads) {
  base::BytesTo put = RowThreads::program(RowTask::couple, -1, 0, 1, 2);
  const std::array<double, kCoupleWeights> none{};
  put.all(none.data(), none.size());
  const Vector sums = RowThreads::total(threads.run(put));
  EXPECT_NEAR(sums[4 * 4 + 2], d.dot(integral(2, 1) * rate), kOfOtherSum * kSize);
}

TEST_P(RowsOfVariables, SubtractMotionsAndSumMoments) {
  std::array<double, kMotionNumbers> motion{};
  for (std::size_t k = 0; k < 5; ++k) motion[k] = 0.3 * static_cast<double>(k) - 0.7;
  base::BytesTo put =
      RowThreads::program(RowTask::combine, 3, false, 1, 1.0, 0, RowTask::subtract, 3);
  put.all(motion.data(), motion.size());
  put(RowTask::moments);
  put(3);
  const Vector sums = RowThreads::total(threads.run(put));
  const Vector expected = d - Phi * Eigen::Map<const Vector>(motion.data(), 5);
  EXPECT_LE((threads.whole(3) - expected).norm(), kOfOtherSum * expected.norm());
  EXPECT_LE((sums.head(5) - P.transpose() * expected).norm(), kOfOtherSum * kSize);
  EXPECT_EQ(sums[5], 0.0);
  EXPECT_LE((sums.segment(kPatternSums, 6) - patterns.transpose() * expected).norm(),
            kOfOtherSum * kSize);
}

TEST_P(RowsOfVariables, SubtractLoadsAndSumResultants) {
  std::array<double, kMotionNumbers> motion{};
  for (std::size_t k = 0; k < 12; ++k) motion[k] = k == 5 ? 0.0 : 0.3 * static_cast<double>(k) - 1;
  base::BytesTo put =
      RowThreads::program(RowTask::combine, 3, false, 1, 1.0, 0, RowTask::subtract_load, 3);
  put.all(motion.data(), motion.size());
  put(RowTask::resultants);
  put(3);
  const Vector sums = RowThreads::total(threads.run(put));
  const Vector expected = d - P * Eigen::Map<const Vector>(motion.data(), 5) -
                          patterns * Eigen::Map<const Vector>(motion.data() + kPatternSums, 6);
  EXPECT_LE((threads.whole(3) - expected).norm(), kOfOtherSum * expected.norm());
  EXPECT_LE((sums.head(5) - Phi.transpose() * expected).norm(), kOfOtherSum * kSize);
  EXPECT_TRUE(sums.tail(kMomentSums - 5).isZero(0.0));
}

TEST_P(RowsOfVariables, DoNotActByNode) {
  const VariableTables none;
  const VariableInertia inertia(none, 0);
  EXPECT_THROW(inertia.multiply_mass(nullptr, nullptr), NumericalError);
}

INSTANTIATE_TEST_SUITE_P(Orders, RowsOfVariables, testing::Bool(), [](const auto& is_scattered) {
  return is_scattered.param ? "Scattered" : "AsNumbered";
});

}  // namespace
}  // namespace buckens::linalg
