// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <barrier>
#include <span>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/linalg/row_order.h"
#include "buckens/linalg/row_worker.h"

namespace buckens::linalg {

/// What threads give each other that stand for processes.
struct Mailbox {
  explicit Mailbox(std::size_t threads)
      : all_are_here(static_cast<std::ptrdiff_t>(threads)), letters(threads) {}
  std::barrier<> all_are_here;
  std::vector<std::vector<std::vector<double>>> letters;  // from, to
};

/// Kept pairs of a thread.
struct ThreadPairs {
  static constexpr int kNumber = 5;
  static constexpr std::size_t kMost = 3;
  explicit ThreadPairs(std::size_t rows) : loads(kMost * rows), answers(kMost * rows) {}
  std::vector<float> loads, answers;
};

class ThreadPeers final : public RowPeers {
 public:
  /// @param rows of vectors that the thread has
  ThreadPeers(Mailbox& mail, std::size_t place, std::size_t rows, ThreadPairs& pairs)
      : mail_(&mail), place_(place), rows_(rows), pairs_(&pairs) {}

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
  /// As if the matrix were its number times the identity.
  void multiply(int matrix, const double* x, double* y) override {
    for (std::size_t k = 0; k < rows_; ++k) y[k] = matrix * x[k];
  }
  /// The same, of all rows of the vector here.
  std::span<const double> multiply(const RowsOfBody& A, const double* x) override {
    EXPECT_EQ(A.space, 7);
    EXPECT_EQ(A.rows, A.is_new ? std::vector({2, 0, 1}) : std::vector<int>());
    products_.resize(rows_);
    multiply(A.matrix, x, products_.data());
    return products_;
  }
  Pairs pairs(int number) override {
    EXPECT_EQ(number, ThreadPairs::kNumber);
    return {pairs_->loads.data(), pairs_->answers.data()};
  }

 private:
  Mailbox* mail_;
  std::size_t place_, rows_;
  ThreadPairs* pairs_;
  std::vector<double> products_;
};

/// Threads of which each has a run of the rows of a body.
class RowThreads {
 public:
  static constexpr int kSpace = 7;

  /// @param first_rows of the threads, and the end @param describe describe_rows() of a thread
  /// @param order of the rows; null: they are variables
  template <class Describe>
  RowThreads(std::vector<int> first_rows, Describe&& describe, SharedRowOrder order = {})
      : first_rows_(std::move(first_rows)),
        order_(std::move(order)),
        workers_(first_rows_.size() - 1) {
    for (std::size_t k = 0; k < workers_.size(); ++k) {
      base::BytesTo put;
      describe(k, put);
      base::BytesFrom take(put.bytes());
      workers_[k].add(kSpace, described_rows(take));
      EXPECT_TRUE(take.is_at_end());
      pairs_.emplace_back(rows(k));
    }
  }

  RowWorker& worker(std::size_t k) { return workers_[k]; }
  void put(int vector, const Vector& of_variables) {
    Vector x = of_variables;
    if (order_) {
      const std::vector<double> rows = order_->by_rows(of_variables.data());
      std::copy(rows.begin(), rows.end(), x.begin());
    }
    for (std::size_t k = 0; k < workers_.size(); ++k) {
      const std::span<double> rows = workers_[k].rows(kSpace, vector);
      std::copy_n(x.data() + first_rows_[k], rows.size(), rows.begin());
    }
  }
  Vector whole(int vector) {
    Vector out(first_rows_.back());
    fill_by_rows(order_, out.data(), [&](double* all) {
      for (std::size_t k = 0; k < workers_.size(); ++k) {
        const std::span<const double> rows = workers_[k].rows(kSpace, vector);
        std::copy(rows.begin(), rows.end(), all + first_rows_[k]);
      }
    });
    return out;
  }
  template <class... Numbers>
  static base::BytesTo program(const Numbers&... numbers) {
    base::BytesTo put;
    put(RowTask::space);
    put(kSpace);
    (put(numbers), ...);
    return put;
  }
  /// The sums of each worker.
  std::vector<Vector> run(const base::BytesTo& program) {
    std::vector<Vector> sums(workers_.size());
    Mailbox mail(workers_.size());
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < workers_.size(); ++k) {
      threads.emplace_back([&, k] {
        ThreadPeers peers(mail, k, rows(k), pairs_[k]);
        const std::span<const double> own = workers_[k].work(program.bytes(), peers);
        sums[k] = Eigen::Map<const Vector>(own.data(), static_cast<Eigen::Index>(own.size()));
      });
    }
    for (std::thread& thread : threads) thread.join();
    return sums;
  }
  static Vector total(const std::vector<Vector>& sums) {
    Vector out = Vector::Zero(sums.front().size());
    for (const Vector& each : sums) out += each;
    return out;
  }

 private:
  std::size_t rows(std::size_t k) const {
    return static_cast<std::size_t>(first_rows_[k + 1] - first_rows_[k]);
  }

  std::vector<int> first_rows_;
  SharedRowOrder order_;
  std::vector<RowWorker> workers_;
  std::vector<ThreadPairs> pairs_;
};

}  // namespace buckens::linalg
