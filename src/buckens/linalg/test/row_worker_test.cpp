// SPDX-License-Identifier: Apache-2.0
// Work on rows of vectors by several processes, here threads, against the same of whole vectors.
#include "buckens/linalg/row_worker.h"

#include <array>

#include <gtest/gtest.h>

#include "buckens/linalg/node_matrix.h"
#include "buckens/linalg/test/definite_matrices.h"
#include "buckens/linalg/test/row_threads.h"

namespace buckens::linalg {
namespace {

// Sums of some thousand products of numbers of about one, in another order.
constexpr double kOfOtherOrder = 1e-12;

SparseMatrix compressed(SparseMatrix A) {
  A.makeCompressed();
  return A;
}

RowMajorMatrix some_rows(int size) {
  std::vector<Triplet> entries;
  for (int row = 0; row < 5; ++row) {
    for (int k = 0; k < 4; ++k) entries.emplace_back(row, (row * 97 + 61 * k) % size, 0.5 + k);
  }
  RowMajorMatrix N(5, size);
  N.setFromTriplets(entries.begin(), entries.end());
  return N;
}

SharedRowOrder scattered(int nodes) {
  std::vector<int> part;
  for (int node = 0; node < nodes; ++node) part.insert(part.end(), 3, node * node % 7 % 3);
  return std::make_shared<const RowOrder>(part, 3);
}

/// A body of which three workers have the rows, in runs of different lengths: as nodes are
/// numbered, or in an order in which neighbours are apart.
class RowsOfABody : public testing::TestWithParam<bool> {
 protected:
  RowsOfABody() {
    put(0, d);
    put(1, rate);
    put(2, acceleration);
  }

  int nodes() const { return static_cast<int>(Ms.cols()); }
  int size() const { return 3 * nodes(); }
  Vector random(int seed) const {
    std::srand(static_cast<unsigned>(seed));
    return Vector::Random(size());
  }
  void put(int vector, const Vector& x) { threads.put(vector, x); }
  Vector whole(int vector) { return threads.whole(vector); }
  std::vector<Vector> run(const base::BytesTo& program) { return threads.run(program); }
  static Vector total(const std::vector<Vector>& sums) { return RowThreads::total(sums); }
  template <class... Numbers>
  static base::BytesTo program(const Numbers&... numbers) {
    return RowThreads::program(numbers...);
  }

  SparseMatrix Ms = compressed(matrices::grid(9, 0.3));
  Eigen::Matrix4Xd positions = Eigen::Matrix4Xd::Random(4, nodes());
  Eigen::Matrix4Xd first_moments = Eigen::Matrix4Xd::Random(4, nodes());
  RowMajorMatrix N = some_rows(size());
  SharedRowOrder order = GetParam() ? scattered(nodes()) : nullptr;
  std::vector<int> first_rows =
      order ? order->first_rows() : std::vector{0, 3 * (nodes() / 5), 3 * (nodes() / 2), size()};
  RowThreads threads{
      first_rows,
      [this](std::size_t k, base::BytesTo& put) {
        std::vector<int> first_nodes = first_rows;
        for (int& first : first_nodes) first /= 3;
        describe_rows(WholeNodes{&Ms, &positions, &first_moments, order}, N, first_nodes, k, put);
      },
      order};
  Vector d = random(1), rate = random(2), acceleration = random(3);
};

TEST_P(RowsOfABody, CombinesAndAdds) {
  run(program(RowTask::combine, 3, false, 2, 0.5, 0, -2.0, 1, RowTask::combine, 3, true, 1, 4.0,
              2));
  EXPECT_LE((whole(3) - (0.5 * d - 2.0 * rate + 4.0 * acceleration)).norm(), kOfOtherOrder);
}

TEST_P(RowsOfABody, AnEmptySumIsZero) {
  run(program(RowTask::combine, 3, false, 1, 1.0, 0, RowTask::combine, 3, false, 0));
  EXPECT_EQ(whole(3), Vector::Zero(size()));
}

TEST_P(RowsOfABody, MultipliesByMassAcrossBorders) {
  run(program(RowTask::multiply_mass, 3, 0));
  Vector expected(size());
  multiply_by_node(Ms, d.data(), expected.data());
  EXPECT_LE((whole(3) - expected).norm(), kOfOtherOrder * expected.norm());
}

TEST_P(RowsOfABody, MultipliesByMatricesOfTheOthers) {
  run(program(RowTask::multiply, 3, 1, 4));
  EXPECT_EQ(whole(3), 4.0 * rate);
}

TEST_P(RowsOfABody, CouplesAcrossBorders) {
  std::array<double, kCoupleWeights> weights{};
  for (std::size_t k = 0; k < weights.size(); ++k) {
    weights[k] = k % 4 == 3 ? 0.0 : 0.1 * static_cast<double>(k) - 1.0;
  }
  base::BytesTo put = program(RowTask::couple, 3, 0, 1, 2);
  put.all(weights.data(), weights.size());
  const Vector sums = total(run(put));

  NodeSums expected;
  Vector load = Vector::Zero(size());
  const std::array<const double*, 3> vectors = {d.data(), rate.data(), acceleration.data()};
  node_kernels().couple(node_matrix(Ms), 0, nodes(), vectors.data(), weights.data(), load.data(),
                        expected);
  EXPECT_LE((whole(3) - load).norm(), kOfOtherOrder * load.norm());
  const Eigen::Map<const Vector> whole_sums(expected.value, kCoupleSums);
  for (Eigen::Index k = 0; k < kCoupleSums; ++k) {
    if (k % 4 == 3) continue;  // unused
    EXPECT_NEAR(sums[k], whole_sums[k], kOfOtherOrder * whole_sums.norm()) << k;
  }
}

TEST_P(RowsOfABody, CouplesWithoutLoads) {
  base::BytesTo put = program(RowTask::couple, -1, 0, 1, 2);
  const std::array<double, kCoupleWeights> none{};
  put.all(none.data(), none.size());
  const Vector sums = total(run(put));
  Vector Md(size());
  multiply_by_node(Ms, d.data(), Md.data());
  EXPECT_NEAR(sums[0] + sums[5] + sums[10], Md.dot(d), kOfOtherOrder * Md.norm() * d.norm());
}

TEST_P(RowsOfABody, SubtractsMotionsAndSumsMoments) {
  const Eigen::Matrix4d T = Eigen::Matrix4d::Random();
  base::BytesTo put = program(RowTask::combine, 3, false, 1, 1.0, 0, RowTask::subtract, 3);
  put.all(T.data(), kMotionNumbers);
  put(RowTask::moments);
  put(3);
  const Vector sums = total(run(put));
  const Eigen::Map<const Eigen::Matrix3Xd> D(d.data(), 3, nodes());
  const Eigen::Matrix3Xd expected = D - T.topRows<3>() * positions;
  EXPECT_LE((whole(3) - expected.reshaped()).norm(), kOfOtherOrder * expected.norm());
  const Eigen::Matrix<double, 3, 4> moments = expected * first_moments.transpose();
  const Eigen::Map<const Eigen::Matrix4d> found(sums.data());
  EXPECT_LE((found.topRows<3>() - moments).norm(), kOfOtherOrder * moments.norm());
}

TEST_P(RowsOfABody, SubtractsLoadsAndSumsResultants) {
  const Eigen::Matrix4d T = Eigen::Matrix4d::Random();
  base::BytesTo put = program(RowTask::combine, 3, false, 1, 1.0, 0, RowTask::subtract_load, 3);
  put.all(T.data(), kMotionNumbers);
  put(RowTask::resultants);
  put(3);
  const Vector sums = total(run(put));
  const Eigen::Map<const Eigen::Matrix3Xd> F(d.data(), 3, nodes());
  const Eigen::Matrix3Xd expected = F - T.topRows<3>() * first_moments;
  EXPECT_LE((whole(3) - expected.reshaped()).norm(), kOfOtherOrder * expected.norm());
  const Eigen::Matrix<double, 3, 4> resultants = expected * positions.transpose();
  const Eigen::Map<const Eigen::Matrix4d> found(sums.data());
  EXPECT_LE((found.topRows<3>() - resultants).norm(), kOfOtherOrder * resultants.norm());
}

TEST_P(RowsOfABody, AddsLoadsAlongInterfaceRows) {
  const Vector weights = Vector::LinSpaced(5, -1.0, 2.0);
  base::BytesTo put = program(RowTask::combine, 3, false, 1, 1.0, 0, RowTask::add_row_loads, 3);
  put.all(weights.data(), 5);
  run(put);
  EXPECT_LE((whole(3) - d - N.transpose() * weights).norm(), kOfOtherOrder * d.norm());
}

TEST_P(RowsOfABody, MultipliesByInterfaceRows) {
  const Vector sums = total(run(program(RowTask::row_products, 2, 0, 2)));
  EXPECT_LE((sums.head(5) - N * d).norm(), kOfOtherOrder);
  EXPECT_LE((sums.tail(5) - N * acceleration).norm(), kOfOtherOrder);
}

TEST_P(RowsOfABody, PicksNumbersOfAnyRows) {
  const std::vector<int> variables = {0, size() - 1, 3 * (nodes() / 2), 4, 3 * (nodes() / 5) - 1,
                                      4};
  base::BytesTo put = program(RowTask::pick, 1, static_cast<int>(variables.size()));
  for (const int variable : variables) put(order ? order->row(variable) : variable);
  put(RowTask::square);
  put(0);
  const Vector sums = total(run(put));
  ASSERT_EQ(sums.size(), 7);
  // One of them has the number, and the others add zeros.
  for (std::size_t k = 0; k < variables.size(); ++k) {
    EXPECT_EQ(sums[static_cast<Eigen::Index>(k)], rate[variables[k]]) << k;
  }
  EXPECT_NEAR(sums[6], d.squaredNorm(), kOfOtherOrder * sums[6]);
}

TEST_P(RowsOfABody, ComparesAndTotals) {
  put(4, random(4).cwiseAbs());
  const Vector weights = whole(4);
  put(5, 2.0 * weights);
  const std::vector<Vector> sums =
      run(program(RowTask::compare, 0, 1, 4, 5, RowTask::total, 2, 0, 1));
  const Vector change = d - rate;
  const Vector added = total(sums);
  EXPECT_NEAR(added[0], change.cwiseAbs2().dot(weights), kOfOtherOrder * added[0]);
  EXPECT_NEAR(added[1], d.cwiseAbs2().dot(weights), kOfOtherOrder * added[1]);
  EXPECT_EQ(std::max({sums[0][2], sums[1][2], sums[2][2]}),
            change.cwiseProduct(2.0 * weights).cwiseAbs().maxCoeff());
  EXPECT_NEAR(added[3], d.sum() + rate.sum(), kOfOtherOrder * size());
}

TEST_P(RowsOfABody, FormsInnerProducts) {
  const Vector sums = total(run(program(RowTask::inner_product, 0, 1, RowTask::square, 1)));
  EXPECT_NEAR(sums[0], d.dot(rate), kOfOtherOrder * d.norm() * rate.norm());
  EXPECT_NEAR(sums[1], rate.squaredNorm(), kOfOtherOrder * sums[1]);
}

TEST_P(RowsOfABody, FindsTheLargestNormOfRunsOfProducts) {
  // Of two weighted numbers of each node.
  const Matrix F = (Matrix(2, 3) << 1, 0, -2, 0, 3, 0).finished();
  base::BytesTo put = program(RowTask::largest_norm, 0, 4, true, 3, 2, 0, 1, 2, 3);
  put.all(F.data(), 6);
  put(RowTask::largest_norm);
  for (const int number : {1, 4}) put(number);
  put(false);
  for (const int number : {0, 2, 3}) put(number);
  put.all(F.data(), 6);
  const std::vector<Vector> found = run(put);
  for (const int k : {0, 1}) {
    const Vector& x = k == 0 ? d : rate;
    const Matrix y = F * (4.0 * x).reshaped(3, nodes());
    const double largest = std::max({found[0][k], found[1][k], found[2][k]});
    EXPECT_NEAR(largest, y.colwise().squaredNorm().maxCoeff(), kOfOtherOrder * largest);
  }
}

TEST_P(RowsOfABody, MemoryOfDroppedVectorsIsUsedAgain) {
  const double* before = threads.worker(0).rows(RowThreads::kSpace, 2).data();
  run(program(RowTask::drop, 2, RowTask::combine, 9, false, 0));
  EXPECT_EQ(threads.worker(0).rows(RowThreads::kSpace, 9).data(), before);
  EXPECT_EQ(threads.worker(0).num_vectors(), 3U);
  threads.worker(0).remove(RowThreads::kSpace);
  EXPECT_EQ(threads.worker(0).num_vectors(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Orders, RowsOfABody, testing::Bool(), [](const auto& is_scattered) {
  return is_scattered.param ? "Scattered" : "AsNumbered";
});

}  // namespace
}  // namespace buckens::linalg
