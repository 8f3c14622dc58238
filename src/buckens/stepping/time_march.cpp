// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/time_march.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

namespace {

constexpr long kTicks = 1L << TimeMarch::kShortestRung;  // per longest step

// The error of a step falls like h³, the admissible error like h. A new length aims at this
// fraction of the admissible error; a step twice as long is taken when its expected error is below
// it.
constexpr double kAim = 0.8;
constexpr double kPerHalving = 8.0;
// How fast the additional error admitted for an event fades in the following steps.
constexpr double kFade = 0.5;
constexpr int kMostAtOnce = 5;

StepSettings with_longest_step(StepSettings settings, const MarchSettings& march) {
  settings.step = longest_step_of(march);
  return settings;
}

}  // namespace

double longest_step_of(const MarchSettings& march) {
  const double span = march.duration - march.start;
  const auto count = static_cast<double>(march.longest_steps);
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * march.duration;
  const bool is_divided = std::abs(count * march.given_step - span) <= rounding;
  return is_divided ? march.given_step : span / count;
}

TimeMarch::TimeMarch(const model::Model& model, StepSettings settings, std::vector<int> rows_in_use,
                     const MarchSettings& march)
    : march_(march),
      ladder_(model, with_longest_step(std::move(settings), march), std::move(rows_in_use)),
      model_(model),
      end_(march.longest_steps * kTicks),
      has_rigid_rows_(model.may_have_rigid_rows()),
      accepted_(kShortestRung + 1, 0) {
  if (march.tolerance) error_.emplace(model, *march.tolerance);
}

bool TimeMarch::fits(int k) const { return ticks_ % (kTicks >> k) == 0; }

double TimeMarch::time() const {
  // Counting avoids the drift of summed steps. Where a given step fills the run, its end is counted
  // as any instant, so that a run that is made longer equals a long one.
  if (is_done() && ladder_.step(0) != march_.given_step) return march_.duration;
  return march_.start + static_cast<double>(ticks_) / static_cast<double>(kTicks) * ladder_.step(0);
}

StepReport TimeMarch::advance(const model::State& before, model::State& after,
                              const StepQuestion& holds_event, const StepQuestion& is_too_long) {
  if (error_ && !has_begun_) error_->start(before);
  has_begun_ = true;
  first_failure_.clear();
  // For rigid rows, if no shorter step helps.
  bool accepts_last_stands = false, decides_first = false;
  rejected_ratio_ = 0;
  spread_ = std::max(next_step(), kFade * spread_);
  has_deepened_ = k_ > march_.most_halvings;
  for (;;) {
    Stepper& stepper = ladder_.rung(k_);
    stepper.decide_first(decides_first);
    stepper.accept_last_stands(accepts_last_stands);
    StepReport report;
    try {
      report = stepper.step(before, after);
    } catch (const StepFailure& failure) {
      ++report_.failed;
      if (first_failure_.empty()) {
        first_failure_ = failure.what();
        first_failed_ = k_;
      }
      const bool may_decide = stepper.has_rough_contacts() && !decides_first;
      const bool may_go_on = has_rigid_rows_ && (!accepts_last_stands || may_decide);
      if (may_go_on && k_ >= shortest()) {
        decides_first = accepts_last_stands;
        accepts_last_stands = true;
        k_ = first_failed_;
      } else {
        shorten(1);
      }
      continue;
    }
    // No smooth curve leads through an impact or a row that lets go; its instant is found within
    // the step. The step after it closes what the impact has left open of the positions.
    const bool is_smooth = !report.must_settle && !has_restarted_;
    if (is_smooth && !is_admitted(after, stepper.scheme())) continue;
    if (k_ < kEventRung && holds_event && holds_event(before, after)) {
      shorten(1);
      continue;
    }
    if (k_ < kShortestRung && is_too_long && is_too_long(before, after)) {
      ++k_;
      has_deepened_ = k_ > march_.most_halvings;
      continue;
    }
    ticks_ += kTicks >> k_;
    after.t = time();
    if (error_) has_restarted_ ? error_->start(after) : error_->accept(after);
    has_restarted_ = false;
    ++report_.accepted;
    ++accepted_[static_cast<std::size_t>(k_)];
    choose_next();
    return report;
  }
}

void TimeMarch::restart(model::State& state) {
  stepper().filter_algorithmic(state);
  if (!error_) return;
  error_->start(state);
  has_restarted_ = true;
}

void TimeMarch::forget_force(model::State& state) {
  for (model::BodyState& body : state.bodies) {
    body.w_alg = body.w_dot;
    body.v_alg = body.v_dot;
    body.d_alg = body.d_ddot;
  }
  state.history = 0;
  restart(state);
}

bool TimeMarch::is_admitted(const model::State& after, const Scheme& scheme) {
  if (!error_) return true;
  estimate_ = error_->estimate(after, scheme, spread_ / march_.duration);
  if (estimate_.ratio <= 1.0) return true;
  // What shorter steps do not reduce is a jump, and rigid rows make some.
  const double before = std::exchange(rejected_ratio_, estimate_.ratio);
  if (has_rigid_rows_ && before > 0.0 && estimate_.ratio >= before) {
    has_restarted_ = true;
    return true;
  }
  ++report_.rejected;
  const double wanted = std::log2(estimate_.ratio / kAim) / std::log2(kPerHalving);
  shorten(wanted < kMostAtOnce ? std::max(1, static_cast<int>(std::ceil(wanted))) : kMostAtOnce);
  return false;
}

void TimeMarch::shorten(int halvings) {
  if (k_ >= shortest()) {
    give_up(first_failure_);
  }
  k_ = std::min(k_ + halvings, shortest());
}

void TimeMarch::choose_next() {
  if (!error_) {
    while (k_ > 0 && fits(k_ - 1)) --k_;
    return;
  }
  if (k_ == 0 || !fits(k_ - 1)) return;
  const double next_spread = std::max(ladder_.step(k_ - 1), kFade * spread_);
  if (kPerHalving * estimate_.ratio * spread_ < kAim * next_spread) --k_;
}

void TimeMarch::give_up(const std::string& why) const {
  if (!why.empty()) {
    const std::string tried =
        k_ > first_failed_
            ? fmt::format("steps shortened {} times, down to {:.3g} s, also failed",
                          k_ - first_failed_, ladder_.step(k_))
            : fmt::format("it had already been shortened to 1/{}, the limit", 1L << k_);
    throw NumericalError(fmt::format("{}; {}", why, tried));
  }
  throw NumericalError(fmt::format(
      "step at t = {:.6g} s failed: the error in the {} of body \"{}\" is {:.3g} times what the "
      "tolerance admits, even with a step of {:.3g} s; look for a law that jumps, or raise "
      "`tolerance` or `absolute-tolerance`",
      time(), to_string(estimate_.quantity), model_.bodies[estimate_.body].name, estimate_.ratio,
      ladder_.step(k_)));
}

std::vector<RungUse> TimeMarch::rungs() const {
  std::vector<RungUse> out;
  for (int k = 0; k <= kShortestRung; ++k) {
    const RungUse use{ladder_.step(k), accepted_[static_cast<std::size_t>(k)],
                      ladder_.factorisations(k)};
    if (use.steps > 0 || use.factorisations > 0) out.push_back(use);
  }
  return out;
}

}  // namespace buckens::stepping
