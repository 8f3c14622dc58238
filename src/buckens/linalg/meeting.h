// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <thread>

namespace buckens::linalg {

/// Where threads wait until all of them are there, for work in pieces of microseconds: a thread
/// that waits does not sleep, and gives its processor up only after a while.
class Meeting {
 public:
  /// Returns when `count` threads, the same for all of them, have called it. What any of them wrote
  /// before is seen by all of them afterwards. Can be used again at once.
  void wait_for(int count) {
    const unsigned round = round_.load(std::memory_order_acquire);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == count) {
      arrived_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      return;
    }
    for (int k = 0; round_.load(std::memory_order_acquire) == round; ++k) {
      if (k >= kSpins) std::this_thread::yield();
    }
  }

 private:
  // Some ten microseconds, after which those awaited probably have no processor.
  static constexpr int kSpins = 2000;

  std::atomic<int> arrived_{0};
  alignas(64) std::atomic<unsigned> round_{0};
};

}  // namespace buckens::linalg
