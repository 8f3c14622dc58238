// SPDX-License-Identifier: Apache-2.0
// Work on rows of vectors by several processes, here threads, against the same of whole vectors.
#include "buckens/linalg/row_worker.h"

#include <array>
#include <barrier>
#include <thread>

#include <gtest/gtest.h>

#include "buckens/linalg/node_matrix.h"
#include "buckens/linalg/test/definite_matrices.h"

namespace buckens::linalg {
namespace {

using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// Sums of some thousand products of numbers of about one, in another order.
constexpr double kOfOtherOrder = 1e-12;

/// What threads give each other.
struct Mailbox {
  explicit Mailbox(std::size_t threads)
      : all_are_here(static_cast<std::ptrdiff_t>(threads)), letters(threads) {}
  std::barrier<> all_are_here;
  std::vector<std::vector<std::vector<double>>> letters;  // from, to
};

class Thread final : public RowPeers {
 public:
  Thread(Mailbox& mail, std::size_t place) : mail_(&mail), place_(place) {}
  void exchange(std::span<const int> out_counts, const double* out, std::span<const int> in_counts,
                double* in) override {
    auto& mine = mail_->letters[place_];
    mine.clear();
    for (const int count : out_counts) {
      mine.emplace_back(out, out + count);
      out += count;
    }
    mail_->all_are_here.arrive_and_wait();
    for (std::size_t k = 0; k < in_counts.size(); ++k) {
      const std::vector<double>& letter = mail_->letters[k][place_];
      EXPECT_EQ(static_cast<int>(letter.size()), in_counts[k]);
      in = std::copy(letter.begin(), letter.end(), in);
    }
    mail_->all_are_here.arrive_and_wait();
  }

 private:
  Mailbox* mail_;
  std::size_t place_;
};

/// A body of which three workers have the rows, in runs of different lengths.
class RowsOfABody : public testing::Test {
 protected:
  static constexpr std::size_t kWorkers = 3;
  static constexpr int kSpace = 7;

  RowsOfABody() {
    Ms.makeCompressed();
    std::vector<Triplet> entries;
    for (int row = 0; row < 5; ++row) {
      for (int k = 0; k < 4; ++k) entries.emplace_back(row, (row * 97 + 61 * k) % size(), 0.5 + k);
    }
    N.resize(5, size());
    N.setFromTriplets(entries.begin(), entries.end());
    const int n = nodes();
    first_nodes = {0, n / 5, n / 2, n};
    for (std::size_t k = 0; k < kWorkers; ++k) {
      base::BytesTo put;
      describe_rows(Ms, positions, first_moments, N, first_nodes, k, put);
      base::BytesFrom take(put.bytes());
      workers[k].add(kSpace, described_rows(take));
      EXPECT_TRUE(take.is_at_end());
    }
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
  void put(int vector, const Vector& x) {
    for (std::size_t k = 0; k < kWorkers; ++k) {
      const std::span<double> rows = workers[k].rows(kSpace, vector);
      std::copy_n(x.data() + 3 * first_nodes[k], rows.size(), rows.begin());
    }
  }
  Vector whole(int vector) {
    Vector out(size());
    for (std::size_t k = 0; k < kWorkers; ++k) {
      const std::span<const double> rows = workers[k].rows(kSpace, vector);
      std::copy(rows.begin(), rows.end(), out.data() + 3 * first_nodes[k]);
    }
    return out;
  }
  /// The sums of each worker.
  std::vector<Vector> run(const base::BytesTo& program) {
    std::vector<Vector> sums(kWorkers);
    Mailbox mail(kWorkers);
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < kWorkers; ++k) {
      threads.emplace_back([&, k] {
        Thread peers(mail, k);
        const std::span<const double> own = workers[k].work(program.bytes(), peers);
        sums[k] = Eigen::Map<const Vector>(own.data(), static_cast<Eigen::Index>(own.size()));
      });
    }
    for (std::thread& thread : threads) thread.join();
    return sums;
  }
  static Vector total(const std::vector<Vector>& sums) { return sums[0] + sums[1] + sums[2]; }
  template <class... Numbers>
  static base::BytesTo program(const Numbers&... numbers) {
    base::BytesTo put;
    put(kSpace);
    (put(numbers), ...);
    return put;
  }

  SparseMatrix Ms = matrices::grid(9, 0.3);
  Eigen::Matrix4Xd positions = Eigen::Matrix4Xd::Random(4, nodes());
  Eigen::Matrix4Xd first_moments = Eigen::Matrix4Xd::Random(4, nodes());
  RowMajor N;
  std::vector<int> first_nodes;
  std::array<RowWorker, kWorkers> workers;
  Vector d = random(1), rate = random(2), acceleration = random(3);
};

TEST_F(RowsOfABody, CombinesAndAdds) {
  run(program(RowTask::combine, 3, false, 2, 0.5, 0, -2.0, 1, RowTask::combine, 3, true, 1, 4.0,
              2));
  EXPECT_LE((whole(3) - (0.5 * d - 2.0 * rate + 4.0 * acceleration)).norm(), kOfOtherOrder);
}

TEST_F(RowsOfABody, AnEmptySumIsZero) {
  run(program(RowTask::combine, 3, false, 1, 1.0, 0, RowTask::combine, 3, false, 0));
  EXPECT_EQ(whole(3), Vector::Zero(size()));
}

TEST_F(RowsOfABody, MultipliesByMassAcrossBorders) {
  run(program(RowTask::multiply_mass, 3, 0));
  Vector expected(size());
  multiply_by_node(Ms, d.data(), expected.data());
  EXPECT_LE((whole(3) - expected).norm(), kOfOtherOrder * expected.norm());
}

TEST_F(RowsOfABody, CouplesAcrossBorders) {
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

TEST_F(RowsOfABody, CouplesWithoutLoads) {
  base::BytesTo put = program(RowTask::couple, -1, 0, 1, 2);
  const std::array<double, kCoupleWeights> none{};
  put.all(none.data(), none.size());
  const Vector sums = total(run(put));
  Vector Md(size());
  multiply_by_node(Ms, d.data(), Md.data());
  EXPECT_NEAR(sums[0] + sums[5] + sums[10], Md.dot(d), kOfOtherOrder * Md.norm() * d.norm());
}

TEST_F(RowsOfABody, SubtractsMotionsAndSumsMoments) {
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

TEST_F(RowsOfABody, MultipliesByInterfaceRows) {
  const Vector sums = total(run(program(RowTask::row_products, 2, 0, 2)));
  EXPECT_LE((sums.head(5) - N * d).norm(), kOfOtherOrder);
  EXPECT_LE((sums.tail(5) - N * acceleration).norm(), kOfOtherOrder);
}

TEST_F(RowsOfABody, ComparesAndTotals) {
  put(4, random(4).cwiseAbs());
  const Vector weights = whole(4);
  const std::vector<Vector> sums = run(program(RowTask::compare, 0, 1, 4, RowTask::total, 2, 0, 1));
  const Vector change = d - rate;
  const Vector added = total(sums);
  EXPECT_NEAR(added[0], change.cwiseAbs2().dot(weights), kOfOtherOrder * added[0]);
  EXPECT_NEAR(added[1], d.cwiseAbs2().dot(weights), kOfOtherOrder * added[1]);
  EXPECT_EQ(std::max({sums[0][2], sums[1][2], sums[2][2]}),
            change.cwiseProduct(weights).cwiseAbs().maxCoeff());
  EXPECT_NEAR(added[3], d.sum() + rate.sum(), kOfOtherOrder * size());
}

TEST_F(RowsOfABody, MemoryOfDroppedVectorsIsUsedAgain) {
  const double* before = workers[0].rows(kSpace, 2).data();
  run(program(RowTask::drop, 2, RowTask::combine, 9, false, 0));
  EXPECT_EQ(workers[0].rows(kSpace, 9).data(), before);
  EXPECT_EQ(workers[0].num_vectors(), 3U);
  workers[0].remove(kSpace);
  EXPECT_EQ(workers[0].num_vectors(), 0U);
}

}  // namespace
}  // namespace buckens::linalg
