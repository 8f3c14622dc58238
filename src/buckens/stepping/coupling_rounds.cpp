// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/coupling_rounds.h"

#include <cmath>

namespace buckens::stepping {

namespace {

// Positions are known to rounding, accelerations to that over h². A coupling load that stops
// falling from solve to solve has converged, whatever the outer tolerance, if the remainder is this
// small: relative to the load, or as motion relative to the model's length (where a motion has
// barely begun).
constexpr double kCouplingRounding = 1e-9;
constexpr double kPositionRounding = 1e-15;
// Rounding changes from solve to solve without falling. A body whose inertia about some axis is
// much larger deformed than undeformed, such as a thin bent rod about its length, converges by a
// factor of about 0.7: that is not rounding, the remainder is several times the last change.
constexpr double kNoLongerFalls = 0.9;
// What a second large solve may leave in the coupling load: its effect on the motion in a step is
// smaller by (h ω)², far below the error of the method.
constexpr double kSecondSolve = 1e-4;
// Where the coupling load passes through zero, the criterion is the motion that the rest would
// cause in the step, relative to the model's length.
constexpr double kSecondSolveMotion = 1e-9;

}  // namespace

CouplingRounds::Verdict CouplingRounds::judge(const Gap& gap, int solves) {
  const double last = last_change_ < 0 ? HUGE_VAL : last_change_;
  const bool is_last = ++rounds_ >= settings_.max_outer;
  last_change_ = gap.change;
  if (gap.is_settled) return Verdict::ends;
  if (gap.change <= kCouplingRounding && (is_last || gap.change > kNoLongerFalls * last)) {
    return Verdict::ends;
  }
  if (gap.motion <= kPositionRounding && gap.change > 0.5 * last) return Verdict::ends;
  const bool is_second = solves >= 2 && !settings_.iterate_coupling;
  const bool is_small = gap.motion <= kSecondSolveMotion && gap.change <= 0.5 * last;
  if (is_second && (gap.change <= kSecondSolve || is_small)) return Verdict::ends;
  return is_last || !std::isfinite(gap.change) ? Verdict::fails : Verdict::goes_on;
}

}  // namespace buckens::stepping
