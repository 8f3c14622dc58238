// SPDX-License-Identifier: Apache-2.0
// Soft rows of force laws in the iteration of a step, and what follows when laws change regimes.
#include <algorithm>
#include <cmath>
#include <utility>

#include "buckens/stepping/small_newton.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

namespace {

constexpr int kMostMoves = 20;  // iterations of a step in which rigid rows change their stands
// Gaps by this share of the change of an iteration do not close by it.
constexpr double kOpenGap = 0.1;
// Share of its own force that a row of a mix keeps in the tangent. The matrix of multipliers loses
// as many digits, and the iteration gains as many in each round.
constexpr double kOwnShare = 1e-4;
// Stiffness by what a body gives [-]: friction of places whose load tends to nothing, as of balls
// that fall side by side. Squares of its inverse would be too large for a number.
constexpr double kNoStiffness = 1e-150;

/// That of the equations of a step. @return 0 where it is too small to have an inverse
double stiffness_in_step(const Scheme& scheme, double stiffness, double damping) {
  const double asked = scheme.weight * stiffness + scheme.mean_rate * damping;
  return scheme.force * std::abs(asked) < kNoStiffness ? 0.0 : asked;
}

}  // namespace

void SmallNewton::keep_for_corrections() {
  correcting_stiffness_ = soft_.stiffness;
  correcting_damping_ = soft_.damping;
  give_to_corrections_.assign(soft_.rows.size(), 0);
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    give_to_corrections_[k] = soft_.is_closed[k] || soft_.stiffness[k] != 0.0 ||
                              (scheme_.mean_rate != 0.0 && soft_.damping[k] != 0.0);
  }
}

void SmallNewton::set_soft_rows(const std::vector<double>& stiffness,
                                const std::vector<double>& damping) {
  soft_compliance_.clear();
  soft_stiffness_share_.clear();
  only_follows_.assign(soft_.rows.size(), 0);
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    const int row = static_cast<int>(rows_in_use_.size() + k);
    if (soft_.is_closed[k]) {
      condensation_->set_row(row, without_rates(soft_.rows[k]), soft_.rows[k]);
      // Residuals are closed exactly all the same.
      soft_compliance_.push_back(kRigidGive * own_compliance(soft_.rows[k], compliance_));
      soft_stiffness_share_.push_back(0.0);
      continue;
    }
    const double elastic = scheme_.weight * stiffness[k];
    const double k_eff = stiffness_in_step(scheme_, stiffness[k], damping[k]);
    if (k_eff != 0.0 && has_quasi_static_) {
      // Shapes without rates strain a spring and leave its damper alone.
      condensation_->set_row(row, with_shapes(soft_.rows[k], elastic / k_eff), soft_.rows[k]);
    } else if (k_eff != 0.0) {
      condensation_->set_row(row, soft_.rows[k]);
    } else if (give_to_corrections_[k]) {
      // Its spring still shares in corrections, which act along it.
      condensation_->set_acting_row(row, soft_.rows[k]);
    } else {
      condensation_->clear_row(row);
    }
    soft_compliance_.push_back(k_eff > 0.0 ? 1.0 / (scheme_.force * k_eff) : 1.0);
    soft_stiffness_share_.push_back(k_eff > 0.0 ? elastic / k_eff : 0.0);
  }
  has_soft_springs_ = std::any_of(soft_stiffness_share_.begin(), soft_stiffness_share_.end(),
                                  [](double share) { return share != 0.0; });
}

int SmallNewton::place_of(const dynamics::ReactionSlope& slope) const {
  if (slope.row >= 0) return place_in_use_[static_cast<std::size_t>(slope.row)];
  const bool presses = soft_.is_closed[static_cast<std::size_t>(slope.rigid)];
  return presses ? static_cast<int>(rows_in_use_.size()) + slope.rigid : -1;
}

void SmallNewton::set_slopes() {
  const int in_use = static_cast<int>(rows_in_use_.size());
  slopes_in_use_.clear();
  add_slopes_of_mixes();
  for (const dynamics::ReactionSlope& slope : slopes_) {
    const auto soft = static_cast<std::size_t>(slope.soft);
    const int place = place_of(slope);
    if (place < 0 || soft_.is_closed[soft] || held_.holds(slope.soft)) continue;
    add_slope(slope.soft, place, slope.value);
    // Where a force only follows multipliers, bodies move by it all the same.
    const bool gives_way =
        stiffness_in_step(scheme_, soft_.stiffness[soft], soft_.damping[soft]) != 0.0;
    if (gives_way || only_follows_[soft]) continue;
    only_follows_[soft] = 1;
    condensation_->set_acting_row(in_use + slope.soft, soft_.rows[soft]);
  }
  condensation_->set_slopes(slopes_in_use_);
}

void SmallNewton::add_slopes_of_mixes() {
  const int in_use = static_cast<int>(rows_in_use_.size());
  inverse_mixes_.clear();
  mix_of_row_.assign(soft_.rows.size(), -1);
  for (std::size_t m = 0; m < soft_.mixes.size(); ++m) {
    // f = R f̂ as f = f̂ + W f, with W = 1 − R⁻¹ of an R that is not quite singular.
    loads::RowMix R = soft_.mixes[m];
    R.diagonal().array() += kOwnShare;
    const loads::RowMix& inverse = inverse_mixes_.emplace_back(R.inverse());
    const int first = soft_.first_of_mix[m], count = static_cast<int>(R.rows());
    for (int i = 0; i < count; ++i) {
      const auto soft = static_cast<std::size_t>(first + i);
      mix_of_row_[soft] = static_cast<int>(m);
      if (stiffness_in_step(scheme_, soft_.stiffness[soft], soft_.damping[soft]) == 0.0) continue;
      for (int j = 0; j < count; ++j) {
        const double value = (i == j ? 1.0 : 0.0) - inverse(i, j);
        if (value == 0.0) continue;
        slopes_in_use_.push_back({in_use + first + i, in_use + first + j, value});
      }
    }
  }
}

void SmallNewton::add_slope(int soft, int place, double value) {
  const int in_use = static_cast<int>(rows_in_use_.size());
  const int m = mix_of_row_[static_cast<std::size_t>(soft)];
  if (m < 0) {
    // Written one by one: every iteration with new slopes comes by here.
    dynamics::MultiplierSlope& slope = slopes_in_use_.emplace_back();
    slope.soft_row = in_use + soft;
    slope.row = place;
    slope.value = value;
    return;
  }
  // f = R f̂ + w λ as f = f̂ + W f + R⁻¹ w λ.
  const loads::RowMix& inverse = inverse_mixes_[static_cast<std::size_t>(m)];
  const int first = soft_.first_of_mix[static_cast<std::size_t>(m)];
  for (int k = 0; k < static_cast<int>(inverse.rows()); ++k) {
    slopes_in_use_.push_back({in_use + first + k, place, inverse(k, soft - first) * value});
  }
}

bool SmallNewton::renew_slopes() {
  if (!slopes_are_old_) return false;
  slopes_are_old_ = false;
  // Those of other loads stay as they are.
  const auto is_at_joint = [this](const dynamics::ReactionSlope& slope) {
    return joints_.has_soft_row(slope.soft);
  };
  slopes_.erase(std::remove_if(slopes_.begin(), slopes_.end(), is_at_joint), slopes_.end());
  slopes_.insert(slopes_.end(), slopes_of_joints_.begin(), slopes_of_joints_.end());
  set_slopes();
  condensation_->renew_slopes(slopes_in_use_, soft_compliance_);
  ending_.begin_anew();
  return true;
}

const loads::RigidRow* SmallNewton::closed_row(std::size_t soft) const {
  if (!soft_.is_closed[soft]) return nullptr;
  return &forces_.rigid[static_cast<std::size_t>(soft_.rigid[soft])];
}

bool SmallNewton::move_rigid_rows(double t, const StepReport& report) {
  if (rigid_.empty() || !may_move(t, report)) return false;
  // Friction outside its cone would open other stops that remain pressed in the end.
  const bool are_held = cones_.empty() || cones_.hold(forces_.rigid, rigid_);
  if (!are_held && decide_cones(t, report)) return true;
  const bool do_balls_hold = balls_.empty() || balls_.hold(forces_.rigid, rigid_);
  if (!do_balls_hold && decide_balls(t, report, true)) return true;
  return rigid_.move(forces_.rigid, decided_together_);
}

bool SmallNewton::decide_cones(double t, const StepReport& report) {
  if (cones_.empty() || !may_move(t, report)) return false;
  try {
    const RigidInstant now{forces_.rigid, soft_,   compliance_,  end_,
                           rows_in_use_,  around_, t + scheme_.h};
    if (!cones_.decide(now, scheme_.force, scheme_.end_rate, rigid_)) return false;
  } catch (const StepFailure&) {
    has_accepted_stands_ = accepts_last_stands_;
    if (accepts_last_stands_) return false;
    fail(t, report, "friction of rigid contacts jams, they need a `stiffness` or less `static`");
  }
  rigid_.count_move();
  return true;
}

bool SmallNewton::decide_balls(double t, const StepReport& report, bool is_settled) {
  if (balls_.empty() || !may_move(t, report)) return false;
  const RigidInstant now{forces_.rigid, soft_,   compliance_,  at_evaluation(),
                         rows_in_use_,  around_, t + scheme_.h};
  if (!balls_.decide(now, {&soft_compliance_, is_settled}, scheme_.force, scheme_.end_rate, rigid_))
    return false;
  rigid_.count_move();
  return true;
}

bool SmallNewton::may_move(double t, const StepReport& report) {
  if (rigid_.num_moves() <= kMostMoves) return true;
  has_accepted_stands_ = accepts_last_stands_;
  if (accepts_last_stands_) return false;
  fail(t, report,
       "no combination of holding and releasing satisfies all rigid stops and rigid friction");
}

bool SmallNewton::let_jumping_go(double change) {
  int worst = -1;
  double most = kOpenGap * change;
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    const loads::RigidRow* row = closed_row(k);
    if (row == nullptr || !row->may_go || !(std::abs(row->gap) > most)) continue;
    most = std::abs(row->gap);
    worst = soft_.rigid[k];
  }
  if (worst < 0) return false;
  rigid_.let_go(worst);
  cones_.follow(worst, rigid_);
  return true;
}

bool SmallNewton::form_tangent(std::vector<BodyStep>& bodies, bool rigid_rows_moved) {
  if (rigid_rows_moved) {
    sliding_.reset();
    for (BodyStep& body : bodies) body.drop_correction();
    slopes_in_use_.clear();
    condensation_->set_slopes(slopes_in_use_);
    for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
      if (soft_.rigid[k] >= 0) give_to_corrections_[k] = soft_.is_closed[k];
    }
    set_soft_rows(correcting_stiffness_, correcting_damping_);
    if (!condensation_->factorise(compliance_, soft_compliance_)) return false;
  }
  set_soft_rows(soft_.stiffness, soft_.damping);
  set_slopes();
  if (condensation_->factorise_multipliers(compliance_, soft_compliance_)) return true;
  keep_for_corrections();
  set_soft_rows(soft_.stiffness, soft_.damping);
  set_slopes();
  for (BodyStep& body : bodies) body.drop_correction();
  return condensation_->factorise(compliance_, soft_compliance_);
}

bool SmallNewton::regimes_hold(std::vector<BodyStep>& bodies, double t, const StepReport& report) {
  const bool are_same = forces_.regimes == soft_.regimes && !look_at_balls(t).has_reversed;
  if (!are_same) form_tangent_anew(bodies, t, report);
  return are_same;
}

TurningBalls::Sliding SmallNewton::look_at_balls(double t) const {
  return held_.look_at_balls(at_evaluation(), scheme_.evaluation_time(t), around_);
}

void SmallNewton::form_tangent_anew(std::vector<BodyStep>& bodies, double t,
                                    const StepReport& report) {
  dynamics::evaluate_soft_rows(model_, at_evaluation(), scheme_.evaluation_time(t), around_,
                               soft_now_, &reaction_slopes_, &slopes_, &joints_);
  slopes_are_old_ = false;
  // Directions stay those of the predicted configuration, as of the joints.
  std::swap(soft_.stiffness, soft_now_.stiffness);
  std::swap(soft_.damping, soft_now_.damping);
  std::swap(soft_.regimes, soft_now_.regimes);
  std::swap(soft_.is_closed, soft_now_.is_closed);
  std::swap(soft_.mixes, soft_now_.mixes);
  std::swap(soft_.first_of_mix, soft_now_.first_of_mix);
  held_.hold_reversed(soft_now_.regimes, at_evaluation(), scheme_.evaluation_time(t), around_,
                      soft_);
  if (!form_tangent(bodies, soft_.is_closed != soft_now_.is_closed)) {
    fail(t, report, "laws of joint coordinates that act together differ too much in stiffness");
  }
}

}  // namespace buckens::stepping
