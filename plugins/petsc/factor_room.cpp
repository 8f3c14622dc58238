// SPDX-License-Identifier: Apache-2.0
#include "factor_room.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace buckens_petsc {

namespace {
// What lacked is told when one front found no room; those after it may need more.
constexpr std::array<double, 2> kTimesLacking = {2.0, 8.0};
constexpr std::array<double, 5> kMultiples = {1.0, 1.3, 2.6, 5.2, 10.4};
constexpr double kBeside = 1e6;  // numbers
// Share of what the first process needs, at most, that is worth another analysis.
constexpr double kWorthChanging = 0.95;
}  // namespace

bool FactorRoom::grow(double lacking) {
  if (lacking > 0.0 && additions_ < static_cast<int>(kTimesLacking.size())) {
    const double more = kTimesLacking[static_cast<std::size_t>(additions_++)] * lacking;
    const double most = std::max(numbers_, kMultiples.front() * predicted_ + kBeside);
    numbers_ = std::min(std::ceil(numbers_ + more + kBeside / 8), most);
    return true;
  }
  if (multiples_ == static_cast<int>(kMultiples.size())) return false;
  const double multiple = kMultiples[static_cast<std::size_t>(multiples_++)];
  numbers_ = std::max(numbers_, std::ceil(multiple * predicted_ + kBeside));
  return true;
}

int lightest_place(const std::vector<double>& numbers) {
  const auto least = std::min_element(numbers.begin(), numbers.end());
  const bool is_worth_it = *least < kWorthChanging * numbers.front();
  return is_worth_it ? static_cast<int>(least - numbers.begin()) : 0;
}

}  // namespace buckens_petsc
