// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/small_newton.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/drives.h"
#include "buckens/dynamics/model_scales.h"
#include "buckens/stepping/iteration_end.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

using linalg::Vector;

namespace {

// Pivots this much smaller than when the rows were chosen: others may have become the better
// choice.
constexpr double kPivotDrop = 1e-3;
// Pivots fall with the square of what is left of a lever arm. Below this, rounding of positions
// moves what the lever drives by more than the iteration's end admits: the step has hit a dead
// centre.
constexpr double kDeadCentre = 1e-10;

// An iteration that converges more slowly than this has the tangents of other directions of
// sliding.
constexpr double kTurnedTangent = 0.1;

// Iterations between which rows move without ever settling, after which a place is looked for that
// jumps to and fro.
constexpr int kMostUnsettled = 100;

bool has_rows_with_laws(const model::Model& model) {
  return std::any_of(model.joints.begin(), model.joints.end(), [](const model::Joint& joint) {
    return std::any_of(joint.rows.begin(), joint.rows.end(),
                       [](const joints::ConstraintRow& row) { return row.law() != nullptr; });
  });
}

}  // namespace

SmallNewton::SmallNewton(const model::Model& model, const Scheme& scheme,
                         const StepSettings& settings, std::vector<const BodyAnswer*> answers,
                         std::vector<int> rows_in_use)
    : model_(model),
      scheme_(scheme),
      settings_(settings),
      answers_(std::move(answers)),
      rows_in_use_(std::move(rows_in_use)),
      released_(settings.released),
      watch_(model),
      rigid_(model, &scheme_),
      cones_(model),
      balls_(model),
      decided_together_(cones_.rows()),
      held_(model),
      ending_(settings, model.length, dynamics::shortest_lever(model)),
      joints_(model),
      rates_only_(dynamics::rate_only_rows(model)),
      reaction_slopes_(model) {
  std::sort(rows_in_use_.begin(), rows_in_use_.end());
  number_rows_in_use();
  has_laws_ = has_rows_with_laws(model);
  std::transform(balls_.rows().begin(), balls_.rows().end(), decided_together_.begin(),
                 decided_together_.begin(), std::bit_or<char>());
  const std::size_t count = model.bodies.size();
  for (auto* motions : {&end_, &evaluation_, &uncorrected_}) motions->resize(count);
  compliance_.resize(count);
  correction_.resize(count);
  response_.resize(count);
  shares_.reserve(count);
  for (std::size_t b = 0; b < count; ++b) {
    const Eigen::Index rows = answers_[b] ? answers_[b]->num_rows() : 0;
    shares_.emplace_back(model.bodies[b], answers_[b], scheme, model.length);
    has_quasi_static_ = has_quasi_static_ || shares_[b].is_quasi_static();
    correction_[b].interface_load.setZero(rows);
    response_[b].interface_load.setZero(rows);
  }
}

void SmallNewton::use(const dynamics::Circumstances& around) {
  around_ = around;
  if (!model_.drives.empty()) {
    steered_ = *around.memory;
    around_.memory = &steered_;
  }
  held_.release();
  if (rigid_.empty()) return;
  rigid_.start(*around.memory, scheme_.undone_at_end());
  around_.stands = &rigid_.stands();
}

const dynamics::SystemRow& SmallNewton::with_shapes(const dynamics::SystemRow& row,
                                                    double share) const {
  thread_local dynamics::SystemRow out;  // keeps its room
  out = row;
  for (std::size_t k = 0; k < out.num_parts(); ++k) {
    dynamics::BodyRow& part = out.part(k);
    if (part.body == model::kGround) continue;
    if (shares_[static_cast<std::size_t>(part.body)].is_quasi_static()) part.interface *= share;
  }
  return out;
}

bool SmallNewton::corrects_positions() const {
  return scheme_.weight == 1.0 || settings_.position_projection;
}

void SmallNewton::find_motions(const std::vector<BodyStep>& bodies) {
  const bool same = scheme_.weight == 1.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].motion_at_end(scheme_, answers_[b], end_[b]);
    if (!same) bodies[b].motion_at_evaluation(scheme_, answers_[b], evaluation_[b]);
  }
}

void SmallNewton::evaluate(std::vector<BodyStep>& bodies, double t, const Vector& lambda,
                           std::vector<dynamics::ReactionSlope>* slopes) {
  find_motions(bodies);
  steer(t);
  evaluate_motions(bodies, t, lambda, slopes, nullptr);
}

void SmallNewton::evaluate_motions(std::vector<BodyStep>& bodies, double t, const Vector& lambda,
                                   std::vector<dynamics::ReactionSlope>* slopes,
                                   std::vector<dynamics::SoftRows>* soft) {
  const bool same = scheme_.weight == 1.0;
  const double t_e = scheme_.evaluation_time(t);
  const auto act = [&] {
    dynamics::evaluate_forces(model_, at_evaluation(), t_e, around_, forces_, 1.0, &joints_.laws());
  };
  act();
  if (rigid_.let_go(forces_.rigid)) act();
  const dynamics::JointSet::Laws with{around_, slopes, soft, same ? &law_ends_ : nullptr};
  if (same) {
    joints_.evaluate(end_, t + scheme_.h, around_.memory, residuals_, &lambda, &forces_, &with);
  } else {
    joints_.evaluate(end_, t + scheme_.h, around_.memory, residuals_);
    joints_.evaluate(evaluation_, t_e, around_.memory, other_residuals_, &lambda, &forces_, &with);
  }
  keep_shapes_in_rates(bodies, t + scheme_.h);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (answers_[b] == nullptr) continue;
    bodies[b].set_load(forces_.interface[b], at_evaluation()[b].frame.w);
  }
}

void SmallNewton::steer(double t) {
  dynamics::steer_drives(model_, end_, t + scheme_.h, around_, steering_signals_, steered_);
}

void SmallNewton::keep_shapes_in_rates(const std::vector<BodyStep>& bodies, double t_end) {
  if (!has_quasi_static_) return;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].uncorrected_motion(scheme_, answers_[b], uncorrected_[b]);
  }
  joints_.evaluate(uncorrected_, t_end, around_.memory, other_residuals_);
  residuals_.g_dot = other_residuals_.g_dot;
}

void SmallNewton::find_soft_rows(std::vector<BodyStep>& bodies, double t, bool begins_here) {
  // The first evaluation of the iteration tells tangents of laws on joints, too.
  is_evaluated_ = begins_here && scheme_.weight == 1.0 && joints_.has_laws() && rigid_.empty() &&
                  !has_quasi_static_;
  if (is_evaluated_) {
    evaluate_motions(bodies, t, *around_.lambda, &slopes_of_joints_, &soft_of_laws_);
  }
  dynamics::evaluate_soft_rows(model_, at_evaluation(), scheme_.evaluation_time(t), around_, soft_,
                               &reaction_slopes_, &slopes_, &joints_,
                               is_evaluated_ ? &soft_of_laws_ : nullptr);
  if (!is_evaluated_) return;
  slopes_.insert(slopes_.end(), slopes_of_joints_.begin(), slopes_of_joints_.end());
}

void SmallNewton::prepare(std::vector<BodyStep>& bodies, double t, bool begins_here) {
  has_accepted_stands_ = false;
  sliding_.reset();
  find_motions(bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].compliance = shares_[b].frame_compliance(bodies[b], at_evaluation()[b]);
    compliance_[b].frame = bodies[b].compliance;
    compliance_[b].interface = answers_[b] ? &answers_[b]->interface_compliance() : nullptr;
  }
  ending_.begin(dynamics::rounding_length(model_, end_));
  steer(t);
  find_soft_rows(bodies, t, begins_here);
  held_.begin(at_evaluation(), scheme_.evaluation_time(t), around_);
  follow_near();
  follow_released(t);
  bool is_closed = condense(t);
  const double pivots = condensation_->pivot_ratio();
  const bool is_dead_centre = !is_closed || pivots < kDeadCentre * trusted_pivots_;
  if (is_dead_centre || gave_up_rows_ || watch_.has_open_rows() ||
      pivots < kPivotDrop * trusted_pivots_) {
    if (select_rows_anew(t, is_dead_centre)) is_closed = condense(t);
    trusted_pivots_ = condensation_->pivot_ratio();
  } else {
    trusted_pivots_ = std::max(trusted_pivots_, pivots);
  }
  if (is_closed) return;
  joints_.evaluate(end_, t + scheme_.h, around_.memory, residuals_);
  StepReport report;
  report.worst_row = rows_in_use_.empty() ? 0 : rows_in_use_.front();
  if (!dependent_.empty()) report.worst_row = dependent_.front();
  if (residuals_.g.size() > 0) report.position_residual = residuals_.g.cwiseAbs().maxCoeff();
  fail(t, report,
       rows_in_use_.empty() ? "the stiffnesses of parallel springs or bushings differ too much"
                            : "joint equations have become dependent (a singular position)");
}

IterationEnd::Change SmallNewton::update(std::vector<BodyStep>& bodies, Vector& lambda) {
  Change change;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyIteration::Moved moved = shares_[b].advance(bodies[b], correction_[b], response_[b]);
    if (!(moved.frame <= change.size)) restless_body_ = b;
    change.size = larger(change.size, moved.frame);
    change.motion = larger(change.motion, moved.motion);
    if (!(change.size < HUGE_VAL)) return change;
    change.size = larger(change.size, moved.interface);
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    lambda[rows_in_use_[k]] += X_[static_cast<Eigen::Index>(k)] / scheme_.force;
  }
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    if (!soft_.is_closed[k]) continue;
    const auto row = static_cast<Eigen::Index>(rows_in_use_.size() + k);
    rigid_.add_force(soft_.rigid[k], X_[row] / scheme_.force);
  }
  return change;
}

bool SmallNewton::is_balanced(double open, double motion) const {
  // Where rows hold their bodies by short levers, or by rows that come and go, a residual does not
  // tell how far they move. Teeth, paths and wheels turn with what they hold, and forces on both
  // sides are equal to what is left over h².
  if (has_quasi_static_ || has_laws_ || !rigid_.empty()) return false;
  const double pivots = condensation_->pivot_ratio();
  if (pivots > 0.0 && pivots < kWeaklyHeld) return false;
  const double enough = ending_.negligible(motion);
  if (!(open <= enough)) return false;
  const bool with_positions = corrects_positions();
  return std::all_of(rows_in_use_.begin(), rows_in_use_.end(), [&](int row) {
    const double length = watch_.is_length(row) ? 1.0 : model_.length;
    return std::abs(residuals_.g_dot[row]) * length <= enough * scheme_.end_rate &&
           (!with_positions || rates_only_[static_cast<std::size_t>(row)] ||
            std::abs(residuals_.g[row]) * length <= enough);
  });
}

double SmallNewton::find_residuals(const std::vector<BodyStep>& bodies) {
  double open = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    shares_[b].find_residual(bodies[b], at_evaluation()[b], forces_.frame[b]);
    open = larger(open, shares_[b].residual_size());
  }
  return open;
}

IterationEnd::Change SmallNewton::move(std::vector<BodyStep>& bodies, double t, Vector& lambda,
                                       StepReport& report) {
  solve_correction(bodies, t);
  solve_multipliers(t);
  held_.release();
  const Change change = update(bodies, lambda);
  ++report.newton_iterations;
  if (!(change.size < HUGE_VAL)) fail(t, report, "the motion has diverged");
  motion_ = change.motion;
  return change;
}

void SmallNewton::settle(std::vector<BodyStep>& bodies, double t, Vector& lambda, Change change,
                         StepReport& report) {
  Change before;
  double size_before = 0;  // of the last change, whatever tangent it had
  int since_moved = 0;     // iterations since a rigid row moved last
  int since_settled = 0;   // the same since it had settled between
  int flickers = 0;        // changes of regimes in a row that moved nothing
  for (;;) {
    ++since_moved;
    evaluate(bodies, t, lambda, slopes_are_old_ ? &slopes_of_joints_ : nullptr);
    record_residuals(residuals_, report);
    bool are_formed = regimes_hold(bodies, t, report);
    // A law at the border of two regimes may change to and fro by rounding for ever.
    flickers = !are_formed && ending_.is_rounding(change) ? flickers + 1 : 0;
    const bool is_settled =
        flickers > 1 ||
        (are_formed && ending_.is_settled(change, before, condensation_->pivot_ratio()));
    since_settled = is_settled ? 0 : since_settled + 1;
    const bool is_failing = !is_settled && (since_moved + 1 >= settings_.max_newton ||
                                            since_settled % kMostUnsettled == 0);
    if (is_settled || is_failing || is_restless(since_moved)) {
      const bool has_moved = is_settled
                                 ? move_rigid_rows(t, report)
                                 : (is_failing && let_jumping_go(change.size)) ||
                                       decide_cones(t, report) || decide_balls(t, report, false);
      if (is_settled && !has_moved) break;
      if (has_moved) {
        since_moved = 0;
        evaluate(bodies, t, lambda);
        are_formed = regimes_hold(bodies, t, report);
      }
    }
    if (are_formed && is_balanced(find_residuals(bodies), change.motion) &&
        since_moved <= settings_.max_newton) {
      break;
    }
    has_left_open_ = goes_on_ && are_formed && ending_.is_near(change, size_before);
    if (has_left_open_) return;
    if (are_formed) {
      before = change;
    } else {
      evaluate(bodies, t, lambda);
      before = {};  // another tangent converges at its own rate
      ending_.begin_anew();
    }
    if (since_moved >= settings_.max_newton) {
      fail(t, report, "the step's iteration does not converge");
    }
    if (!are_formed) find_residuals(bodies);
    if (renew_slopes()) before = {};
    const bool is_slow = change.size > kTurnedTangent * size_before && size_before > 0.0;
    // The torque of a ball turns with its direction of sliding, and so does its tangent.
    const bool turns = is_slow && (look_at_balls(t).any || balls_.any_slides(rigid_));
    if (are_formed && turns) form_tangent_anew(bodies, t, report);
    size_before = change.size;
    change = move(bodies, t, lambda, report);
  }
  watch_rows(t, report);
}

void SmallNewton::iterate(std::vector<BodyStep>& bodies, double t, Vector& lambda,
                          StepReport& report, bool goes_on) {
  goes_on_ = goes_on && rigid_.empty() && !has_quasi_static_;
  has_left_open_ = false;
  leave_to_rows_in_use(lambda);
  if (!is_evaluated_) evaluate(bodies, t, lambda);
  record_residuals(residuals_, report);
  if (decides_first_ && !cones_.empty() && decide_cones(t, report)) {
    evaluate(bodies, t, lambda);
    if (!regimes_hold(bodies, t, report)) evaluate(bodies, t, lambda);
  }
  find_residuals(bodies);
  slopes_are_old_ = std::any_of(
      slopes_.begin(), slopes_.end(),
      [this](const dynamics::ReactionSlope& slope) { return joints_.has_soft_row(slope.soft); });
  settle(bodies, t, lambda, move(bodies, t, lambda, report), report);
}

void SmallNewton::iterate_on(std::vector<BodyStep>& bodies, double t, Vector& lambda,
                             StepReport& report) {
  // Motions, rows and forces are those of the last evaluation.
  const double open = find_residuals(bodies);
  if (!has_left_open_ && open <= ending_.negligible(motion_)) return;
  goes_on_ = has_left_open_ = false;
  settle(bodies, t, lambda, move(bodies, t, lambda, report), report);
}

void SmallNewton::fail(double t, const StepReport& report, const char* what) const {
  std::string where = fmt::format("body \"{}\"", model_.bodies[restless_body_].name);
  if (model_.num_constraint_rows() > 0) {
    const auto [owner, row] = model_.owner_of_row(std::max(0, report.worst_row));
    where = fmt::format("joint \"{}\", |g| = {:.3g}; {} moves most", owner->name,
                        report.position_residual, where);
  }
  throw StepFailure(fmt::format(
      "step at t = {:.6g} s failed after {} iterations: {} (worst at {}); use a smaller step than "
      "{:.3g} s, or look for a lock-up or a dead centre of the mechanism there{}",
      t, report.newton_iterations, what, where, scheme_.h,
      has_quasi_static_ ? "; if loads of a quasi-static body change much with its shape, stiffen "
                          "it or make it `flexibility: elastic`"
                        : ""));
}

}  // namespace buckens::stepping
