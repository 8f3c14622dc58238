// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/solve_exchange.h"

#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

namespace buckens::linalg {
namespace {

/// −∇² + shift on an n×n×n grid: a factor that is large enough to be worth sharing.
SparseMatrix grid_matrix(int n, double shift) {
  std::vector<Triplet> entries;
  const auto at = [n](int i, int j, int k) { return i + n * (j + n * k); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        entries.emplace_back(at(i, j, k), at(i, j, k), 6.0 + shift);
        const auto couple = [&](int other) {
          entries.emplace_back(at(i, j, k), other, -1.0);
          entries.emplace_back(other, at(i, j, k), -1.0);
        };
        if (i + 1 < n) couple(at(i + 1, j, k));
        if (j + 1 < n) couple(at(i, j + 1, k));
        if (k + 1 < n) couple(at(i, j, k + 1));
      }
    }
  }
  SparseMatrix A(n * n * n, n * n * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

constexpr int kExchangeSize = 10;

/// x ← A⁻¹ x + 1, `rounds` times, from a constant.
Vector repeated(SolveExchange& exchange, const SparseMatrix& A, double start, int rounds) {
  const auto factor = exchange.factor(A);
  Vector x = Vector::Constant(A.rows(), start);
  const std::vector<double*> vectors = {x.data()};
  for (int k = 0; k < rounds; ++k) {
    exchange.solve(*factor, vectors);
    x.array() += 1.0;
  }
  return x;
}

TEST(SolveExchange, SharesFactorsOfEqualMatricesOnly) {
  SolveExchange exchange;
  const SparseMatrix A = grid_matrix(4, 0.5);
  SparseMatrix other = A;
  other.coeffRef(3, 3) += 1e-15 * other.coeff(3, 3) * 4;
  const auto first = exchange.factor(A);
  EXPECT_EQ(exchange.factor(SparseMatrix(A)), first);
  EXPECT_NE(exchange.factor(other), first);
  EXPECT_EQ(exchange.num_factorisations(), 2);
}

TEST(SolveExchange, ForgetsFactorsThatNobodyHolds) {
  SolveExchange exchange;
  exchange.factor(grid_matrix(4, 0.5));
  exchange.factor(grid_matrix(4, 0.5));
  EXPECT_EQ(exchange.num_factorisations(), 2);
}

TEST(SolveExchange, SolvesTogetherWhatSeparateRunsSolve) {
  const SparseMatrix A = grid_matrix(kExchangeSize, 0.5), B = grid_matrix(kExchangeSize, 0.7);
  // Six participants, five with A; they end after different numbers of solves.
  const std::vector<int> rounds = {5, 7, 3, 7, 1, 6};
  std::vector<Vector> together(6), alone(6);
  SolveExchange exchange;
  std::vector<std::function<void()>> work;
  const auto matrix = [&](std::size_t p) -> const SparseMatrix& { return p == 3 ? B : A; };
  for (std::size_t p = 0; p < 6; ++p) {
    work.emplace_back(
        [&, p] { together[p] = repeated(exchange, matrix(p), static_cast<double>(p), rounds[p]); });
  }
  exchange.run(work);
  for (std::size_t p = 0; p < 6; ++p) {
    SolveExchange own;
    alone[p] = repeated(own, matrix(p), static_cast<double>(p), rounds[p]);
    // Another number of columns may round differently: a few units in the last place per solve.
    EXPECT_LE((together[p] - alone[p]).cwiseAbs().maxCoeff(), 1e-13 * alone[p].maxCoeff()) << p;
  }
  EXPECT_EQ(exchange.num_factorisations(), 2);
  EXPECT_EQ(exchange.num_columns(), 5 + 7 + 3 + 7 + 1 + 6);
  // Those with A together in each of 7 rounds, the one with B alone.
  EXPECT_EQ(exchange.num_passes(), 7 + 7);
}

TEST(SolveExchange, SmallFactorsAreSolvedAtOnce) {
  SolveExchange exchange;
  const SparseMatrix A = grid_matrix(3, 0.5);
  Vector x;
  exchange.run({[&] { x = repeated(exchange, A, 1.0, 3); }});
  EXPECT_EQ(exchange.num_passes(), 0);
  EXPECT_TRUE(x.allFinite());
}

TEST(SolveExchange, OneParticipantThatFailsDoesNotStopTheOthers) {
  SolveExchange exchange;
  const SparseMatrix A = grid_matrix(kExchangeSize, 0.5);
  Vector x;
  const auto fail = [&] {
    repeated(exchange, A, 2.0, 1);
    throw std::runtime_error("gave up");
  };
  EXPECT_THROW(exchange.run({fail, [&] { x = repeated(exchange, A, 1.0, 4); }}),
               std::runtime_error);
  SolveExchange own;
  EXPECT_LE((x - repeated(own, A, 1.0, 4)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(SolveExchange, NotPositiveDefiniteIsReportedToWhoAsked) {
  SolveExchange exchange;
  SparseMatrix A = grid_matrix(3, 0.5);
  A.coeffRef(5, 5) = -1.0;
  EXPECT_ANY_THROW(exchange.run({[&] { exchange.factor(A); }}));
}

TEST(SolveExchange, PassesOverACommonTableGoTogetherPieceByPiece) {
  const RowParts rows(7000, 7);
  const int table = 0;
  SolveExchange exchange;
  std::vector<std::pair<int, Eigen::Index>> order;
  std::vector<std::function<void()>> work;
  for (const int participant : {0, 1, 2}) {
    work.emplace_back([&, participant] {
      auto note = [&, participant](int /*part*/, Eigen::Index first, Eigen::Index size) {
        EXPECT_EQ(first % 7, 0);
        EXPECT_GT(size, 0);
        order.emplace_back(participant, first);
      };
      exchange.for_pieces(&table, rows, nullptr, PieceFunction(note));
    });
  }
  exchange.run(work);
  ASSERT_EQ(order.size() % 3, 0U);
  ASSERT_GE(order.size(), 9U);
  Eigen::Index last = -1;
  for (std::size_t k = 0; k < order.size(); k += 3) {
    for (std::size_t p = 0; p < 3; ++p) {
      EXPECT_EQ(order[k + p].first, static_cast<int>(p));
      EXPECT_EQ(order[k + p].second, order[k].second);
    }
    EXPECT_GT(order[k].second, last);
    last = order[k].second;
  }
}

TEST(SolveExchange, SolvesWaitUntilAllPassesAreDone) {
  // Participant 1 makes two passes more than the other, and still solves together with it.
  const SparseMatrix A = grid_matrix(kExchangeSize, 0.5);
  const RowParts rows(7000);
  const int table = 0;
  SolveExchange exchange;
  std::vector<std::function<void()>> work;
  for (const int passes : {1, 3}) {
    work.emplace_back([&, passes] {
      const auto factor = exchange.factor(A);
      Vector x = Vector::Ones(A.rows());
      const std::vector<double*> vectors = {x.data()};
      auto nothing = [](int, Eigen::Index, Eigen::Index) {};
      for (int round = 0; round < 4; ++round) {
        for (int k = 0; k < passes; ++k) {
          exchange.for_pieces(&table, rows, nullptr, PieceFunction(nothing));
        }
        exchange.solve(*factor, vectors);
      }
    });
  }
  exchange.run(work);
  EXPECT_EQ(exchange.num_columns(), 8);
  EXPECT_EQ(exchange.num_passes(), 4);
}

TEST(SharedStore, KeepsWhatIsHeldAndOnlyThat) {
  SharedStore store;
  int made = 0;
  const auto find = [&](int wanted) {
    return store.find_or_make<int>([wanted](int known) { return known == wanted; },
                                   [&] {
                                     ++made;
                                     return std::make_shared<const int>(wanted);
                                   });
  };
  const auto seven = find(7);
  EXPECT_EQ(find(7), seven);
  EXPECT_NE(find(8), seven);
  EXPECT_EQ(made, 2);
  find(8);  // nobody held it
  EXPECT_EQ(made, 3);
  EXPECT_EQ(store.find_or_make<double>([](double) { return true; },
                                       [] { return std::shared_ptr<const double>(); }),
            nullptr);
}

}  // namespace
}  // namespace buckens::linalg
