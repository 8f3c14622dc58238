// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace buckens::base {

/// Wall time since its construction or the last lap.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  /// The time so far; it begins anew.
  double lap() {
    const double out = seconds();
    begin_ = Clock::now();
    return out;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace buckens::base
