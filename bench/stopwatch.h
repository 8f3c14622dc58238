// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

namespace buckens::bench {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Shortest time of f() [s]: other load on the machine only makes it slower.
/// @param budget repeats for about so long [s], three times at least
/// @param between is called after each, and not counted
template <class F, class G>
double shortest(double budget, F&& f, G&& between) {
  constexpr int kLeast = 3;
  const Stopwatch all;
  double best = std::numeric_limits<double>::max();
  for (int k = 0; k < kLeast || all.seconds() < budget; ++k) {
    const Stopwatch one;
    f();
    best = std::min(best, one.seconds());
    between();
  }
  return best;
}

template <class F>
double shortest(double budget, F&& f) {
  return shortest(budget, f, [] {});
}

}  // namespace buckens::bench
