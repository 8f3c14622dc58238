// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace buckens::loads {

/// Regimes of a law of a joint coordinate (Action::regime) whose force is at an end of its set: ±1
/// at a fixed one. Of one that falls with the rate there is one per power of two of its slope, so
/// that the tangent of an iteration is never off by more than a factor of two.
class EndOfSet {
 public:
  /// @param slope how fast the end falls with the rate, 0: it does not [N m s/rad] or [N s/m]
  static int regime(double force, double slope) {
    const int end = slope > 0.0 ? kFalling + std::min(std::ilogb(slope), kSteepest) : 1;
    return force > 0.0 ? end : -end;
  }
  /// Which end: 1 the highest, −1 the lowest, 0 none.
  static int of(int regime) {
    if (regime == 1 || regime > kOthers) return 1;
    return regime == -1 || regime < -kOthers ? -1 : 0;
  }

 private:
  static constexpr int kFalling = 10000;  // far beyond the exponents of numbers
  static constexpr int kSteepest = 2000;  // that of infinity, which is a larger int
  static constexpr int kOthers = 1000;    // regimes of other kinds are smaller
};

}  // namespace buckens::loads
