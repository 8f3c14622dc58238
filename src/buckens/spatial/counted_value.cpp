// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/counted_value.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::spatial {

namespace {
constexpr double kMostTurnsOfStep = 1e6;
}  // namespace

int turns_of(double jump) {
  if (!(std::abs(jump) < kMostTurnsOfStep * kTurn)) return 0;
  return static_cast<int>(std::lround(jump / kTurn));
}

void require_countable(const CountedValue& before, const CountedValue& after, double turn,
                       std::string_view what) {
  if (is_countable(before, after, turn)) return;
  // Plus zero: nobody turns at −0.
  throw StepTooLong(fmt::format(
      "{} goes from {:.4g} to {:.4g} {} within one step of {:.3g} s, so that one turn more or less "
      "could be meant; use a smaller step than that",
      what, before.rate + 0.0, after.rate, turn == kTurn ? "rad/s" : "m/s", after.t - before.t));
}

}  // namespace buckens::spatial
