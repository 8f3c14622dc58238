// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/solve_exchange.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace buckens::linalg {

namespace {

// Switching to another thread costs about 10 µs; smaller factors are read faster than that.
constexpr double kLeastEntries = 2e4;
// The same of passes over tables.
constexpr Eigen::Index kLeastRows = 6000;

/// 128 bits that tell matrices apart: two multiplicative hashes over pattern and values.
using Fingerprint = std::array<std::uint64_t, 2>;

void mix(Fingerprint& print, std::uint64_t word) {
  print[0] = (print[0] ^ word) * 0x100000001b3ULL;
  print[0] ^= print[0] >> 29;
  print[1] = (print[1] + word) * 0x9e3779b97f4a7c15ULL;
  print[1] ^= print[1] >> 32;
}

template <class Number>
void mix_all(Fingerprint& print, const Number* begin, Eigen::Index count) {
  for (Eigen::Index k = 0; k < count; ++k) {
    std::uint64_t word = 0;
    std::memcpy(&word, begin + k, sizeof(Number));
    mix(print, word);
  }
}

Fingerprint fingerprint(const SparseMatrix& A) {
  Fingerprint print = {0xcbf29ce484222325ULL, 0x2545f4914f6cdd1dULL};
  mix(print, static_cast<std::uint64_t>(A.rows()));
  mix(print, static_cast<std::uint64_t>(A.nonZeros()));
  for (Eigen::Index j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      mix(print, static_cast<std::uint64_t>(entry.row()));
      const double value = entry.value();
      mix_all(print, &value, 1);
    }
    mix(print, ~std::uint64_t{0});
  }
  return print;
}

}  // namespace

struct SolveExchange::Known {
  Fingerprint print;
  std::weak_ptr<const Factor> factor;
};

struct SolveExchange::Participant {
  std::thread thread;
  bool is_done = false;
  std::exception_ptr error;  ///< that ended it
  // What it waits for:
  const Factor* factor = nullptr;
  std::span<double* const> vectors;
  const void* table = nullptr;
  const RowParts* rows = nullptr;
  std::optional<PieceFunction> piece;
  TaskPool* pool = nullptr;
  std::exception_ptr refusal;  ///< of the solve

  bool waits() const { return factor != nullptr || table != nullptr; }
};

/// Whose turn it is: one participant's, or nobody's during the solves.
struct SolveExchange::Turns {
  std::mutex mutex;
  std::condition_variable changed;
  std::optional<std::size_t> running;

  void give(std::size_t participant) {
    std::unique_lock lock(mutex);
    running = participant;
    changed.notify_all();
    changed.wait(lock, [this] { return !running; });
  }
  void give_back_until_mine(std::size_t participant) {
    std::unique_lock lock(mutex);
    running.reset();
    changed.notify_all();
    changed.wait(lock, [&] { return running == participant; });
  }
  void wait_for(std::size_t participant) {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return running == participant; });
  }
  void give_back() {
    const std::lock_guard lock(mutex);
    running.reset();
    changed.notify_all();
  }
};

SolveExchange::SolveExchange(MakeFactor make)
    : make_(std::move(make)), turns_(std::make_unique<Turns>()) {}
SolveExchange::~SolveExchange() = default;

std::shared_ptr<const Factor> SolveExchange::factor(const SparseMatrix& A) {
  std::erase_if(known_, [](const Known& known) { return known.factor.expired(); });
  const Fingerprint print = fingerprint(A);
  for (const Known& known : known_) {
    if (known.print != print) continue;
    if (auto factor = known.factor.lock()) return factor;
  }
  auto factor = make_(A);
  ++num_factorisations_;
  known_.push_back({print, factor});
  return factor;
}

void SolveExchange::solve(const Factor& factor, std::span<double* const> vectors, TaskPool* pool) {
  const std::optional<std::size_t> caller = turns_->running;
  if (!caller || factor.num_factor_entries() < kLeastEntries) {
    factor.solve_in_place(vectors, pool);
    return;
  }
  Participant& self = *participants_[*caller];
  self.factor = &factor;
  self.vectors = vectors;
  self.pool = pool;
  turns_->give_back_until_mine(*caller);
  if (self.refusal) std::rethrow_exception(std::exchange(self.refusal, nullptr));
}

void SolveExchange::for_pieces(const void* table, const RowParts& rows, TaskPool* pool,
                               PieceFunction f) {
  const std::optional<std::size_t> caller = turns_->running;
  if (!caller || participants_.size() == 1 || rows.rows() < kLeastRows) {
    rows.for_pieces(pool, f);
    return;
  }
  Participant& self = *participants_[*caller];
  self.table = table;
  self.rows = &rows;
  self.piece = f;
  self.pool = pool;
  turns_->give_back_until_mine(*caller);
}

void SolveExchange::run(const std::vector<std::function<void()>>& participants) {
  participants_.clear();
  for (std::size_t p = 0; p < participants.size(); ++p) {
    participants_.push_back(std::make_unique<Participant>());
    Participant& self = *participants_.back();
    self.thread = std::thread([this, p, &self, &work = participants[p]] {
      turns_->wait_for(p);
      try {
        work();
      } catch (...) {
        self.error = std::current_exception();
      }
      self.is_done = true;
      turns_->give_back();
    });
  }
  const auto is_done = [](const auto& participant) { return participant->is_done; };
  while (!std::all_of(participants_.begin(), participants_.end(), is_done)) {
    for (std::size_t p = 0; p < participants_.size(); ++p) {
      if (!participants_[p]->is_done && !participants_[p]->waits()) turns_->give(p);
    }
    serve_waiting();
  }
  for (const auto& participant : participants_) participant->thread.join();
  for (const auto& participant : participants_) {
    if (participant->error) std::rethrow_exception(participant->error);
  }
}

void SolveExchange::serve_waiting() {
  bool are_passes = false;
  for (const auto& participant : participants_) {
    if (participant->table == nullptr) continue;
    are_passes = true;
    pass_together(participant->table);
  }
  if (are_passes) return;
  for (const auto& participant : participants_) {
    if (participant->factor != nullptr) solve_together(*participant->factor);
  }
}

void SolveExchange::pass_together(const void* table) {
  const Participant* first = nullptr;
  together_.clear();
  for (const auto& participant : participants_) {
    if (participant->table != table) continue;
    if (first == nullptr) first = participant.get();
    together_.push_back(*participant->piece);
  }
  first->rows->for_pieces(first->pool, [this](int part, Eigen::Index begin, Eigen::Index size) {
    for (const PieceFunction& piece : together_) piece(part, begin, size);
  });
  for (const auto& participant : participants_) {
    if (participant->table == table) participant->table = nullptr;
  }
}

void SolveExchange::solve_together(const Factor& factor) {
  std::vector<Participant*> group;
  for (const auto& participant : participants_) {
    if (participant->factor == &factor) group.push_back(participant.get());
  }
  try {
    solve_group(group);
  } catch (...) {
    for (Participant* participant : group) participant->refusal = std::current_exception();
  }
  for (Participant* participant : group) participant->factor = nullptr;
}

void SolveExchange::solve_group(const std::vector<Participant*>& group) {
  const Factor& factor = *group.front()->factor;
  TaskPool* pool = group.front()->pool;
  ++num_passes_;
  vectors_.clear();
  for (const Participant* participant : group) {
    vectors_.insert(vectors_.end(), participant->vectors.begin(), participant->vectors.end());
  }
  num_columns_ += static_cast<long>(vectors_.size());
  factor.solve_in_place(vectors_, pool);
}

}  // namespace buckens::linalg
