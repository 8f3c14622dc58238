// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/gap_of_step.h"

#include <algorithm>
#include <cmath>

namespace buckens::stepping {

namespace {

constexpr int kBisections = 60;
// A gap at the start of the step that is at most this fraction of that at its end counts as none.
constexpr double kOnTheEnd = 1e-6;
// The mean rate of a step lies outside of the rates at its ends by no more than their difference
// plus this fraction of the larger one.
constexpr double kOtherRate = 0.5;
// Fraction of the larger rate by which rates within a step may exceed those at its ends.
constexpr double kBeyond = 0.1;

}  // namespace

double GapOfStep::closes_at() const {
  const auto gap = [&](double s) {
    const double r = 1.0 - s;
    return r * r * ((1.0 + 2.0 * s) * start + s * h * rate_start) +
           s * s * ((1.0 + 2.0 * r) * end - r * h * rate_end);
  };
  // From the end backwards to where the gap was open.
  double open = 1.0;
  constexpr int kLooks = 16;
  for (int k = kLooks - 1; k >= 0; --k) {
    open = static_cast<double>(k) / kLooks;
    if (gap(open) > 0.0) break;
    // It never was open: it began on the end, or no time is left in the step.
    if (k == 0) return start >= kOnTheEnd * end ? 0.0 : 1.0;
  }
  double closed = open + 1.0 / kLooks;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (open + closed);
    (gap(middle) > 0.0 ? open : closed) = middle;
  }
  return closed;
}

double GapOfStep::rate_at(double s) const {
  const double r = 1.0 - s;
  return 6.0 * s * r * (end - start) / h + r * (1.0 - 3.0 * s) * rate_start +
         s * (3.0 * s - 2.0) * rate_end;
}

double GapOfStep::likely_rate_at(double s) const {
  const double beyond = kBeyond * std::max(std::abs(rate_start), std::abs(rate_end));
  return std::clamp(rate_at(s), std::min(rate_start, rate_end) - beyond,
                    std::max(rate_start, rate_end) + beyond);
}

bool GapOfStep::begins_elsewhere() const {
  const double mean = (end - start) / h;
  const double most = std::max(std::abs(rate_start), std::abs(rate_end));
  const double apart = std::abs(rate_end - rate_start) + kOtherRate * most;
  return mean < std::min(rate_start, rate_end) - apart ||
         mean > std::max(rate_start, rate_end) + apart;
}

}  // namespace buckens::stepping
