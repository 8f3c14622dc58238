// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "buckens/joints/joint_coordinate.h"

namespace buckens::joints {

/// Σ cᵢ θᵢ of angles that are counted over turns.
///
/// Angles of gears grow without bound while their sum stays small. Σ cᵢ nᵢ over whole turns is
/// computed without rounding (error-free products and sums, Dekker 1971), so that the remainder has
/// all its digits after any number of turns.
class TurnSum {
 public:
  void add(double factor, const CountedValue& value) {
    rest_ += factor * value.fraction;
    if (value.turns == 0) return;
    const auto turns = static_cast<double>(value.turns);
    const double product = factor * turns;
    const double sum = turns_ + product;
    const double taken = sum - turns_;
    lost_ += (turns_ - (sum - taken)) + (product - taken) + std::fma(factor, turns, -product);
    turns_ = sum;
  }
  double value() const { return 2.0 * std::numbers::pi * (turns_ + lost_) + rest_; }

 private:
  double turns_ = 0, lost_ = 0;  // Σ cᵢ nᵢ and what rounding took from it
  double rest_ = 0;
};

}  // namespace buckens::joints
