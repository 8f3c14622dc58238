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

/// Who runs, of those that take turns: each wakes the next, and the last that comes to wait does
/// what all of them wait for. So a turn costs one change of thread.
struct SolveExchange::Turns {
  explicit Turns(SolveExchange& of) : exchange(of) {}

  /// Where one thread sleeps until it is its turn: each has its own, so that a turn wakes one.
  class Bed {
   public:
    void wake() {
      {
        const std::lock_guard lock(mutex_);
        is_called_ = true;
      }
      called_.notify_one();
    }
    void sleep() {
      std::unique_lock lock(mutex_);
      called_.wait(lock, [this] { return is_called_; });
      is_called_ = false;
    }

   private:
    std::mutex mutex_;
    std::condition_variable called_;
    bool is_called_ = false;
  };

  /// The first from `from` on that neither waits nor has ended.
  std::optional<std::size_t> next_to_run(std::size_t from) const {
    for (std::size_t p = from; p < exchange.participants_.size(); ++p) {
      const Participant& one = *exchange.participants_[p];
      if (!one.is_done && !one.waits()) return p;
    }
    return std::nullopt;
  }
  /// Gives the turn to the next that can run, after serving all if nobody can. @return whether that
  /// is the caller itself
  bool pass(std::size_t caller) {
    const auto is_done = [](const auto& participant) { return participant->is_done; };
    const auto& all = exchange.participants_;
    std::optional<std::size_t> next = next_to_run(caller + 1);
    while (!next && !std::all_of(all.begin(), all.end(), is_done)) {
      exchange.serve_waiting();
      next = next_to_run(0);
    }
    running = next;
    if (next == caller) return true;
    (next ? *beds[*next] : end).wake();
    return false;
  }
  /// The same, and returns when it is the turn of the caller again.
  void yield(std::size_t caller) {
    if (!pass(caller)) beds[caller]->sleep();
  }

  SolveExchange& exchange;
  std::vector<std::unique_ptr<Bed>> beds;  // of participants
  Bed end;                                 // of the thread in run()
  std::optional<std::size_t> running;      // written by whoever has the turn
};

SolveExchange::SolveExchange(MakeFactor make)
    : make_(std::move(make)), turns_(std::make_unique<Turns>(*this)) {}
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
  turns_->yield(*caller);
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
  turns_->yield(*caller);
}

void SolveExchange::run(const std::vector<std::function<void()>>& participants) {
  participants_.clear();
  turns_->beds.clear();
  for (std::size_t p = 0; p < participants.size(); ++p) {
    participants_.push_back(std::make_unique<Participant>());
    turns_->beds.push_back(std::make_unique<Turns::Bed>());
  }
  for (std::size_t p = 0; p < participants.size(); ++p) {
    Participant& self = *participants_[p];
    self.thread = std::thread([this, p, &self, &work = participants[p]] {
      turns_->beds[p]->sleep();
      try {
        work();
      } catch (...) {
        self.error = std::current_exception();
      }
      self.is_done = true;
      turns_->pass(p);
    });
  }
  if (!participants.empty()) {
    turns_->running = 0;
    turns_->beds.front()->wake();
    turns_->end.sleep();
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
