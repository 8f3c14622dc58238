// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace buckens::loads {

/// Calls f(x, weight) so that the sum of weight times a function is its integral over
/// middle ± half, for functions that begin and end like roots: Gauss's eight points of the angle
/// whose cosine leads along. Constants and what is odd about the middle are exact.
template <class F>
void for_rooted(double middle, double half, F&& f) {
  static constexpr std::array<double, 4> kPoint = {0.1834346424956498, 0.5255324099163290,
                                                   0.7966664774136267, 0.9602898564975363};
  static constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873,
                                                    0.2223810344533745, 0.1012285362903763};
  struct Rule {
    std::array<double, 4> at, weight;
    Rule() {
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        const double angle = 0.5 * std::numbers::pi * (1.0 + kPoint[k]);
        at[k] = -std::cos(angle);
        weight[k] = kWeight[k] * std::sin(angle);
        sum += weight[k];
      }
      for (double& one : weight) one /= sum;
    }
  };
  static const Rule rule;
  for (std::size_t k = 0; k < 4; ++k) {
    f(middle - half * rule.at[k], half * rule.weight[k]);
    f(middle + half * rule.at[k], half * rule.weight[k]);
  }
}

}  // namespace buckens::loads
