// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/recycled_solves.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"

namespace buckens::linalg {
namespace {

using Request = RecycledSolves::Request;

constexpr Eigen::Index kSize = 5000;  // several parts of several pieces

/// A = tridiagonal, diagonally dominant, with a diagonal over four decades.
class Chain {
 public:
  Chain() : diagonal_(kSize) {
    for (Eigen::Index i = 0; i < kSize; ++i) {
      diagonal_[i] = std::pow(10.0, 4.0 * static_cast<double>(i) / kSize);
    }
  }
  Vector inverse_diagonal() const { return diagonal_.cwiseInverse(); }
  double off(Eigen::Index i) const { return -0.3 * std::sqrt(diagonal_[i] * diagonal_[i + 1]); }
  Vector times(const Vector& x) const {
    Vector out = diagonal_.cwiseProduct(x);
    for (Eigen::Index i = 0; i + 1 < kSize; ++i) {
      out[i] += off(i) * x[i + 1];
      out[i + 1] += off(i) * x[i];
    }
    return out;
  }
  /// A⁻¹ f, by elimination.
  Vector solve(Vector f) {
    ++solves;
    Vector pivot = diagonal_;
    for (Eigen::Index i = 0; i + 1 < kSize; ++i) {
      const double ratio = off(i) / pivot[i];
      pivot[i + 1] -= ratio * off(i);
      f[i + 1] -= ratio * f[i];
    }
    for (Eigen::Index i = kSize - 1; i >= 0; --i) {
      if (i + 1 < kSize) f[i] -= off(i) * f[i + 1];
      f[i] /= pivot[i];
    }
    return f;
  }
  double norm(const Vector& f) const {
    return std::sqrt(f.cwiseAbs2().dot(diagonal_.cwiseInverse()));
  }
  /// Loads of norm about 1, of which `index` gives as many as one likes.
  Vector load(int index) const {
    Vector out(kSize);
    for (Eigen::Index i = 0; i < kSize; ++i) {
      out[i] = std::sqrt(diagonal_[i] * 2.0 / kSize) *
               std::sin((index + 1) * M_PI * static_cast<double>(i) / kSize);
    }
    return out;
  }

  int solves = 0;

 private:
  Vector diagonal_;
};

/// A⁻¹ f with what the store knows.
Vector answered(RecycledSolves& kept, Chain& chain, Vector f, double limit,
                TaskPool* pool = nullptr) {
  Request request;
  if (!kept.answer(f, limit, request, pool)) {
    f = chain.solve(f);
    kept.complete(request, f, pool);
  }
  Request* const one = &request;
  kept.learn({&one, 1}, pool);
  return f;
}

TEST(RecycledSolves, CombinesAnswersToLoadsThatItHasSeen) {
  Chain chain;
  RecycledSolves kept(chain.inverse_diagonal(), 8);
  for (int k = 0; k < 4; ++k) answered(kept, chain, chain.load(k), 1e-6);
  EXPECT_EQ(chain.solves, 4);
  const Vector f = 0.3 * chain.load(0) - 2.0 * chain.load(2) + 0.01 * chain.load(3);
  const Vector x = answered(kept, chain, f, 1e-6);
  EXPECT_EQ(chain.solves, 4);
  // Answers are kept in single precision.
  EXPECT_LT(chain.norm(chain.times(x) - f), 2e-6 * chain.norm(f));
}

TEST(RecycledSolves, SolvesForWhatIsNewOnly) {
  Chain chain;
  RecycledSolves kept(chain.inverse_diagonal(), 8);
  answered(kept, chain, chain.load(0), 1e-6);
  Request request;
  const Vector f = chain.load(0) + 1e-3 * chain.load(5);
  Vector rest = f;
  ASSERT_FALSE(kept.answer(rest, 1e-6, request));
  EXPECT_NEAR(chain.norm(rest), 1e-3 * chain.norm(chain.load(5)), 2e-7);
  Vector x = chain.solve(rest);
  kept.complete(request, x);
  EXPECT_LT(chain.norm(chain.times(x) - f), 2e-6 * chain.norm(f));
}

TEST(RecycledSolves, LeavesNoMoreThanTheLimitWithoutAnAnswer) {
  Chain chain;
  RecycledSolves kept(chain.inverse_diagonal(), 8);
  answered(kept, chain, chain.load(0), 1e-6);
  for (const double limit : {1e-2, 1e-3, 1e-4}) {
    const Vector f = chain.load(0) + 0.99 * limit / chain.norm(chain.load(1)) * chain.load(1);
    const int before = chain.solves;
    const Vector x = answered(kept, chain, f, limit);
    EXPECT_EQ(chain.solves, before);
    // r in full, and the rounding of what is kept.
    EXPECT_LT(chain.norm(chain.times(x) - f), limit + 2e-6);
    Vector over = chain.load(0) + 1.01 * limit / chain.norm(chain.load(1)) * chain.load(1);
    Request request;
    EXPECT_FALSE(kept.answer(over, limit, request));
  }
}

TEST(RecycledSolves, JudgesSmallLoadsLikeLargeOnes) {
  // The squares of the entries are far below what single precision holds.
  for (const double size : {1e-18, 1e-21, 1e-26}) {
    Chain chain;
    RecycledSolves kept(chain.inverse_diagonal(), 8);
    answered(kept, chain, size * chain.load(0), 1e-6 * size);
    ASSERT_EQ(kept.num_pairs(), 1) << size;
    Request request;
    Vector other = size * chain.load(1);
    EXPECT_FALSE(kept.answer(other, 0.5 * size, request)) << size;
    const Vector f = -3.0 * size * chain.load(0);
    const Vector x = answered(kept, chain, f, 1e-5 * size);
    EXPECT_EQ(chain.solves, 1) << size;
    // As of loads of any size: answers are kept in single precision.
    EXPECT_LT(chain.norm(chain.times(x) - f), 2e-6 * chain.norm(f)) << size;
  }
}

TEST(RecycledSolves, DropsThePairLeastUsedLately) {
  Chain chain;
  RecycledSolves kept(chain.inverse_diagonal(), 3);
  for (int k = 0; k < 3; ++k) answered(kept, chain, chain.load(k), 1e-6);
  // The first is the oldest, but in use.
  for (int use = 0; use < 5; ++use) answered(kept, chain, chain.load(0) + chain.load(2), 1e-6);
  EXPECT_EQ(chain.solves, 3);
  answered(kept, chain, chain.load(3), 1e-6);
  EXPECT_EQ(chain.solves, 4);
  answered(kept, chain, chain.load(0) - chain.load(2) + chain.load(3), 1e-6);
  EXPECT_EQ(chain.solves, 4);
  answered(kept, chain, chain.load(1), 1e-6);
  EXPECT_EQ(chain.solves, 5);
}

TEST(RecycledSolves, SleepsWhereItDoesNotPayAndWakesAgain) {
  Chain chain;
  constexpr int kMost = 4;
  RecycledSolves kept(chain.inverse_diagonal(), kMost);
  int index = 0;
  while (!kept.is_asleep()) {
    answered(kept, chain, chain.load(index++), 1e-6);
    ASSERT_LT(index, 100);
  }
  EXPECT_EQ(index, kMost + 3 * kMost);
  EXPECT_EQ(chain.solves, index);
  const int sleep = 8 * 3 * kMost;
  for (int k = 0; k < sleep; ++k) {
    const Vector f = chain.load(0);
    EXPECT_EQ(answered(kept, chain, f, 1e-6), chain.solve(f)) << "asleep: bitwise a plain solve";
  }
  EXPECT_FALSE(kept.is_asleep());
  const int before = chain.solves;
  for (int k = 0; k < 10; ++k) answered(kept, chain, chain.load(0), 1e-6);
  EXPECT_EQ(chain.solves, before + 1);
}

TEST(RecycledSolves, KeepsOnlyWhatIsNewOfLoadsSolvedTogether) {
  Chain chain;
  RecycledSolves kept(chain.inverse_diagonal(), 8);
  std::vector<Request> requests(3);
  std::vector<Request*> all;
  // The second repeats the first, the third adds something.
  const std::vector<Vector> loads = {chain.load(0), -2.0 * chain.load(0),
                                     chain.load(0) + chain.load(1)};
  for (std::size_t k = 0; k < 3; ++k) {
    Vector f = loads[k];
    ASSERT_FALSE(kept.answer(f, 1e-6, requests[k]));
    f = chain.solve(f);
    kept.complete(requests[k], f);
    all.push_back(&requests[k]);
  }
  kept.learn(all);
  EXPECT_EQ(kept.num_pairs(), 2);
  const int before = chain.solves;
  const Vector f = chain.load(1) - 0.5 * chain.load(0);
  const Vector x = answered(kept, chain, f, 1e-5);
  EXPECT_EQ(chain.solves, before);
  EXPECT_LT(chain.norm(chain.times(x) - f), 5e-6);
}

TEST(RecycledSolves, AreBitwiseTheSameWithTwoThreads) {
  Chain chain;
  TaskPool pool(2);
  RecycledSolves alone(chain.inverse_diagonal(), 5);
  RecycledSolves shared(chain.inverse_diagonal(), 5);
  for (int k = 0; k < 30; ++k) {
    const Vector f = chain.load(k % 4) + 0.1 * chain.load(k % 7);
    EXPECT_EQ(answered(alone, chain, f, 1e-4), answered(shared, chain, f, 1e-4, &pool));
  }
}

TEST(RecycledSolves, GoOnBitwiseFromWhatWasSaved) {
  Chain chain;
  RecycledSolves kept(chain.inverse_diagonal(), 5);
  for (int k = 0; k < 9; ++k) answered(kept, chain, chain.load(k % 7), 1e-4);
  base::SavedValues saved;
  kept.visit_saved(base::SaveVisit::saving(saved));
  base::SavedValues to_write;
  kept.visit_saved(base::SaveVisit::saving_to_write(to_write));
  EXPECT_EQ(to_write.later.size(), 10U);
  for (const auto& [name, list] : to_write.later) {
    const Eigen::VectorXf made = list.make();
    EXPECT_EQ(std::vector<float>(made.begin(), made.end()), saved.singles.at(name)) << name;
  }
  RecycledSolves other(chain.inverse_diagonal(), 5);
  other.visit_saved(base::SaveVisit::restoring(saved));
  EXPECT_EQ(other.num_pairs(), 5);
  for (int k = 0; k < 30; ++k) {
    const Vector f = chain.load(k % 4) + 0.1 * chain.load(k % 7);
    EXPECT_EQ(answered(kept, chain, f, 1e-4), answered(other, chain, f, 1e-4)) << k;
  }
  RecycledSolves smaller(chain.inverse_diagonal(), 4);
  EXPECT_THROW(smaller.visit_saved(base::SaveVisit::restoring(saved)), InputError);
  saved.numbers["scores"].front() = NAN;
  EXPECT_THROW(other.visit_saved(base::SaveVisit::restoring(saved)), InputError);
}

TEST(RecycledSolves, NeverKeepWhatIsNoNumber) {
  Chain chain;
  RecycledSolves kept(chain.inverse_diagonal(), 5);
  answered(kept, chain, chain.load(0), 1e-4);
  for (const double bad : {std::nan(""), HUGE_VAL, 1e300}) {
    Vector f = chain.load(1);
    f[17] = bad;
    answered(kept, chain, f, 1e-4);
  }
  EXPECT_EQ(kept.num_pairs(), 1);
  const Vector x = answered(kept, chain, chain.load(0), 1e-4);
  EXPECT_LT(chain.norm(chain.times(x) - chain.load(0)), 2e-6);
}

TEST(RecycledSolves, KeepNoTraceOfWhatTheyDidNotLearn) {
  Chain chain;
  RecycledSolves kept(chain.inverse_diagonal(), 5);
  answered(kept, chain, chain.load(0), 1e-4);
  Request request;
  for (int k = 1; k < 9; ++k) {
    Vector f = chain.load(k);
    ASSERT_FALSE(kept.answer(f, 1e-4, request));
    f = chain.solve(f);
    kept.complete(request, f);
  }
  base::SavedValues after;
  kept.visit_saved(base::SaveVisit::saving(after));
  RecycledSolves one(chain.inverse_diagonal(), 5);
  answered(one, chain, chain.load(0), 1e-4);
  base::SavedValues before;
  one.visit_saved(base::SaveVisit::saving(before));
  EXPECT_EQ(before, after);
  kept.forget();
  EXPECT_EQ(kept.num_pairs(), 0);
  Vector f = chain.load(0);
  EXPECT_FALSE(kept.answer(f, 1e-4, request));
}

TEST(RecycledSolves, WithoutPlacesEveryLoadIsLeftAsItIs) {
  Chain chain;
  RecycledSolves none(chain.inverse_diagonal(), 0);
  Vector f = chain.load(0);
  Request request;
  EXPECT_FALSE(none.answer(f, 1.0, request));
  EXPECT_EQ(f, chain.load(0));
}

}  // namespace
}  // namespace buckens::linalg
