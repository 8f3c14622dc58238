// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/shift_search.h"

#include <algorithm>

namespace buckens::body {

namespace {
// A shift more than this many times the lowest ω² slows an iteration down, and 1/(ω² + μ) tells
// little about ω².
constexpr double kFarAbove = 30.0;
constexpr double kOverRounding = 1e-13;  // μ against the largest ω²
constexpr int kMostShifts = 12;
}  // namespace

ShiftSearch::ShiftSearch(double first, double highest_square)
    : least_(kOverRounding * highest_square), shift_(std::max(first, least_)) {}

double ShiftSearch::lowest_useful() const { return std::max(least_, 10.0 * drowned_); }

bool ShiftSearch::raise() {
  if (attempt_ == kMostShifts) return false;
  ++attempt_;
  drowned_ = shift_;
  shift_ *= 30.0;
  return true;
}

bool ShiftSearch::is_too_high(double square) const {
  return attempt_ < kMostShifts && square * kFarAbove <= shift_ && shift_ > lowest_useful();
}

void ShiftSearch::lower(double square) {
  ++attempt_;
  shift_ = std::max(lowest_useful(), std::max(0.3 * square, 1e-3 * shift_));
}

}  // namespace buckens::body
