// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/iteration_end.h"

#include <algorithm>
#include <cmath>

namespace buckens::stepping {

namespace {

// Convergence is linear with the frozen matrix of the step: what the next iteration would change is
// known from the last two. It has to be this much smaller than what the tolerance admits.
constexpr double kForeseen = 0.01;
// What may be left open where another round follows, in tolerances, and as a share of what the
// coupling load may change. A round moves bodies by more than that, or hardly less.
constexpr double kLeftForNext = 1e3;
constexpr double kLeftOfLoad = 0.1;
// Of a change that takes back what went astray, so much stays by rounding.
constexpr double kLeftOfChange = 1e-15;
// What rounding of positions leaves open, relative to the model's length, or to the distance from
// the origin where that is more.
constexpr double kRounding = 1e-15;
// Nothing is left to another round below so many of these.
constexpr double kManyRoundings = 100.0;
// A change that no longer falls is rounding if it is below this share of the model's length, or of
// what the rounding of positions may turn: joints close to it only, and a body that is held by a
// short lever turns far for it. Rows of a matrix make some fifty roundings (2e-16) of one.
constexpr double kStalled = 1e-11;
constexpr double kStalledFarAway = 1e-14;
constexpr double kSlow = 0.3;  // no foresight where the iteration converges slower than this

}  // namespace

IterationEnd::IterationEnd(const StepSettings& settings, double length, double lever)
    : tolerance_(settings.newton_tolerance),
      near_(std::min(kLeftForNext * settings.newton_tolerance,
                     kLeftOfLoad * settings.outer_tolerance)),
      keeps_rounding_(!settings.iterate_coupling),
      length_(length),
      leverage_(length / lever),
      rounding_length_(length) {}

void IterationEnd::begin(double rounding_length) {
  rounding_length_ = rounding_length;
  begin_anew();
}

bool IterationEnd::is_settled(const Change& change, const Change& before, double pivots) {
  if (before.size > 0.0) contraction_ = change.size / before.size;
  // Rounding of positions bounds what any iteration can reach, or a change that no longer falls.
  const double enough = tolerance_ * change.motion;
  if (change.size <= enough + kRounding * rounding_length_) return true;
  const double next = std::max(contraction_, kLeftOfChange) * change.size;
  if (contraction_ < kSlow && next <= kForeseen * enough) return true;
  double rounding = kStalled * length_ + kStalledFarAway * leverage_ * rounding_length_;
  if (pivots > 0.0 && pivots < kWeaklyHeld) rounding /= std::sqrt(pivots);
  return before.size > 0.0 && change.size > kSlow * before.size && change.size <= rounding;
}

bool IterationEnd::is_near(const Change& change, double before) const {
  if (!(change.size < kSlow * before)) return false;
  // No other round closes better what rounding leaves.
  const double left = near_ * change.motion;
  if (left < kManyRoundings * kRounding * rounding_length_) return false;
  return change.size * (change.size / before) <= left;
}

bool IterationEnd::is_rounding(const Change& change) const {
  return change.size <= kRounding * rounding_length_;
}

double IterationEnd::negligible(double motion) const {
  // If left in every step, rounding of positions accumulates in rates, which are 1/h of them: this
  // matters when the coupling is iterated to convergence.
  const double rounding = keeps_rounding_ ? kRounding * rounding_length_ : 0.0;
  return kForeseen * tolerance_ * motion + rounding;
}

void record_residuals(const dynamics::JointResiduals& residuals, StepReport& report) {
  if (residuals.g.size() == 0) return;
  Eigen::Index worst = 0;
  report.position_residual = residuals.g.cwiseAbs().maxCoeff(&worst);
  report.velocity_residual = residuals.g_dot.cwiseAbs().maxCoeff();
  report.worst_row = static_cast<int>(worst);
}

}  // namespace buckens::stepping
