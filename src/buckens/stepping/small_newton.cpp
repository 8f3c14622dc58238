// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/small_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/joint_forces.h"
#include "buckens/stepping/row_selection.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

using linalg::Vector;

namespace {

// Pivots this much smaller than when the rows were chosen: others may have become the better
// choice.
constexpr double kPivotDrop = 1e-3;
// A row that follows from others stays closed to rounding; beyond this share of the model's length
// it no longer follows.
constexpr double kOpenRow = 1e-9;

// Convergence is linear with the frozen matrix of the step: what the next iteration would change is
// known from the last two. It has to be this much smaller than what the tolerance admits.
constexpr double kForeseen = 0.01;
constexpr double kSlow = 0.3;  // no foresight where the iteration converges slower than this

/// Calls f for the rows that are not in use. @param rows_in_use ascending
template <class F>
void for_other_rows(const std::vector<int>& rows_in_use, Eigen::Index count, F&& f) {
  std::size_t next = 0;
  for (Eigen::Index row = 0; row < count; ++row) {
    if (next < rows_in_use.size() && rows_in_use[next] == row) {
      ++next;
    } else {
      f(row);
    }
  }
}

}  // namespace

SmallNewton::SmallNewton(const model::Model& model, const Scheme& scheme,
                         const StepSettings& settings,
                         std::vector<const BodyStepOperator*> operators,
                         std::vector<int> rows_in_use)
    : model_(model),
      scheme_(scheme),
      settings_(settings),
      operators_(std::move(operators)),
      rows_in_use_(std::move(rows_in_use)) {
  std::sort(rows_in_use_.begin(), rows_in_use_.end());
  const std::size_t count = model.bodies.size();
  for (auto* motions : {&end_, &evaluation_, &uncorrected_}) motions->resize(count);
  compliance_.resize(count);
  correction_.resize(count);
  response_.resize(count);
  shares_.reserve(count);
  for (std::size_t b = 0; b < count; ++b) {
    const Eigen::Index rows = operators_[b] ? operators_[b]->N().rows() : 0;
    shares_.emplace_back(model.bodies[b], operators_[b], scheme);
    has_quasi_static_ = has_quasi_static_ || shares_[b].is_quasi_static();
    correction_[b].interface_load.setZero(rows);
    response_[b].interface_load.setZero(rows);
  }
}

dynamics::SystemRow SmallNewton::without_rates(dynamics::SystemRow row) const {
  for (dynamics::BodyRow* part : {&row.first, &row.second}) {
    if (part->body == model::kGround) continue;
    if (shares_[static_cast<std::size_t>(part->body)].is_quasi_static()) part->interface.setZero();
  }
  return row;
}

bool SmallNewton::corrects_positions() const {
  return scheme_.weight == 1.0 || settings_.position_projection;
}

void SmallNewton::evaluate(std::vector<BodyStep>& bodies, double t, const Vector& lambda) {
  const bool same = scheme_.weight == 1.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].motion_at_end(scheme_, operators_[b], end_[b]);
    if (!same) bodies[b].motion_at_evaluation(scheme_, operators_[b], evaluation_[b]);
  }
  const double t_e = scheme_.evaluation_time(t);
  dynamics::evaluate_forces(model_, at_evaluation(), t_e, forces_);
  if (same) {
    dynamics::evaluate_joints(model_, end_, t + scheme_.h, constraints_end_, &lambda, &forces_);
  } else {
    dynamics::evaluate_joints(model_, end_, t + scheme_.h, constraints_end_);
    dynamics::evaluate_joints(model_, evaluation_, t_e, constraints_evaluation_, &lambda, &forces_);
  }
  keep_shapes_in_rates(bodies, t + scheme_.h);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (operators_[b] == nullptr) continue;
    bodies[b].set_load(forces_.interface[b], at_evaluation()[b].frame.w);
  }
}

void SmallNewton::keep_shapes_in_rates(const std::vector<BodyStep>& bodies, double t_end) {
  if (!has_quasi_static_) return;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].uncorrected_motion(scheme_, operators_[b], uncorrected_[b]);
  }
  dynamics::evaluate_joints(model_, uncorrected_, t_end, uncorrected_residuals_);
  constraints_end_.g_dot = uncorrected_residuals_.g_dot;
}

void SmallNewton::prepare(std::vector<BodyStep>& bodies, double t) {
  contraction_ = 1.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].motion_at_end(scheme_, operators_[b], end_[b]);
    bodies[b].motion_at_evaluation(scheme_, operators_[b], evaluation_[b]);
    bodies[b].compliance = shares_[b].frame_compliance(bodies[b], evaluation_[b]);
    compliance_[b].frame = bodies[b].compliance;
    compliance_[b].interface = operators_[b] ? &operators_[b]->interface_compliance() : nullptr;
  }
  dynamics::evaluate_constraints(model_, end_, t + scheme_.h, constraints_end_);
  if (scheme_.weight != 1.0) {
    dynamics::evaluate_constraints(model_, evaluation_, scheme_.evaluation_time(t),
                                   constraints_evaluation_);
  }
  dynamics::evaluate_soft_rows(model_, evaluation_, soft_);
  bool is_closed = condense();
  const double pivots = condensation_->pivot_ratio();
  if (!is_closed || has_open_rows_ || pivots < kPivotDrop * trusted_pivots_) {
    if (select_rows_anew()) is_closed = condense();
    trusted_pivots_ = condensation_->pivot_ratio();
  } else {
    trusted_pivots_ = std::max(trusted_pivots_, pivots);
  }
  if (is_closed) return;
  StepReport report;
  report.worst_row = rows_in_use_.empty() ? 0 : rows_in_use_.front();
  if (!dependent_.empty()) report.worst_row = dependent_.front();
  report.position_residual = constraints_end_.g.cwiseAbs().maxCoeff();
  fail(t, report, "joint equations have become dependent (a singular position)");
}

const std::vector<dynamics::SystemRow>& SmallNewton::test_rows() const {
  return takes_all_rows_ ? constraints_end_.rows : test_rows_;
}

const std::vector<dynamics::SystemRow>& SmallNewton::force_rows() const {
  return takes_all_rows_ ? constraints_end_.rows : force_rows_;
}

void SmallNewton::collect_rows() {
  takes_all_rows_ = scheme_.weight == 1.0 && !has_quasi_static_ && soft_.rows.empty() &&
                    rows_in_use_.size() == constraints_end_.rows.size();
  soft_compliance_.clear();
  soft_stiffness_share_.clear();
  if (takes_all_rows_) return;
  const auto& forcing = scheme_.weight == 1.0 ? constraints_end_ : constraints_evaluation_;
  test_rows_.clear();
  force_rows_.clear();
  for (const int row : rows_in_use_) {
    test_rows_.push_back(without_rates(constraints_end_.rows[static_cast<std::size_t>(row)]));
    force_rows_.push_back(forcing.rows[static_cast<std::size_t>(row)]);
  }
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    const double elastic = scheme_.weight * soft_.stiffness[k];
    const double k_eff = elastic + scheme_.mean_rate * soft_.damping[k];
    dynamics::SystemRow row = soft_.rows[k];
    if (k_eff == 0.0) row = {};
    test_rows_.push_back(row);
    force_rows_.push_back(row);
    soft_compliance_.push_back(k_eff > 0.0 ? 1.0 / (scheme_.force * k_eff) : 1.0);
    soft_stiffness_share_.push_back(k_eff > 0.0 ? elastic / k_eff : 0.0);
  }
}

bool SmallNewton::condense() {
  collect_rows();
  if (!condensation_) {
    // Rows without effect keep the bodies they belong to, so that the pattern never changes.
    std::vector<dynamics::SystemRow> pattern = test_rows();
    std::copy(soft_.rows.begin(), soft_.rows.end(),
              pattern.begin() + static_cast<std::ptrdiff_t>(rows_in_use_.size()));
    condensation_ = std::make_unique<dynamics::MultiplierCondensation>(
        static_cast<int>(model_.bodies.size()), pattern);
  }
  return condensation_->factorise(test_rows(), force_rows(), compliance_, soft_compliance_);
}

bool SmallNewton::select_rows_anew() {
  has_open_rows_ = false;
  std::vector<dynamics::BodyCompliance> compliance = compliance_;
  for (std::size_t b = 0; b < compliance.size(); ++b) {
    if (shares_[b].is_quasi_static()) compliance[b].interface = nullptr;
  }
  linalg::RowRank rank = select_rows(constraints_end_.rows, compliance);
  dependent_ = std::move(rank.dependent);
  // Fewer rows mean a dead centre: the step goes on with those it has, or fails and says so.
  if (rank.independent == rows_in_use_ || rank.independent.size() < rows_in_use_.size()) {
    return false;
  }
  rows_in_use_ = std::move(rank.independent);
  condensation_.reset();
  ++num_selections_;
  return true;
}

void SmallNewton::leave_to_rows_in_use(Vector& lambda) const {
  for_other_rows(rows_in_use_, lambda.size(), [&](Eigen::Index row) { lambda[row] = 0.0; });
}

void SmallNewton::watch_rows_not_in_use() {
  const Vector& g = constraints_end_.g;
  double gap = 0;
  for_other_rows(rows_in_use_, g.size(),
                 [&](Eigen::Index row) { gap = std::max(gap, std::abs(g[row])); });
  if (gap <= std::max(kOpenRow * model_.length, 2.0 * largest_gap_)) return;
  largest_gap_ = gap;
  has_open_rows_ = true;
}

double SmallNewton::residual_change(const dynamics::SystemRow& row) const {
  double out = 0;
  for (const dynamics::BodyRow* part : {&row.first, &row.second}) {
    if (part->body == model::kGround) continue;
    const BodyIteration& share = shares_[static_cast<std::size_t>(part->body)];
    out += part->change(share.residual_u, share.y_moving);
  }
  return out;
}

double SmallNewton::correction_change(const dynamics::SystemRow& row) const {
  double out = 0;
  for (const dynamics::BodyRow* part : {&row.first, &row.second}) {
    if (part->body == model::kGround) continue;
    const BodyIteration& share = shares_[static_cast<std::size_t>(part->body)];
    out += part->change(share.correction_u, share.y_correcting);
  }
  return out;
}

void SmallNewton::solve_correction(const std::vector<BodyStep>& bodies) {
  const auto in_use = static_cast<Eigen::Index>(rows_in_use_.size());
  E_.setZero(condensation_->size());
  if (corrects_positions()) {
    for (Eigen::Index k = 0; k < in_use; ++k) {
      const int row = rows_in_use_[static_cast<std::size_t>(k)];
      E_[k] = constraints_end_.g_dot[row] / scheme_.end_rate - constraints_end_.g[row];
    }
    condensation_->solve_in_place(E_);
  }
  condensation_->gather(force_rows(), E_, correction_);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    shares_[b].answer_correction(bodies[b], correction_[b]);
  }
}

void SmallNewton::solve_multipliers() {
  X_.resize(condensation_->size());
  const std::size_t in_use = rows_in_use_.size();
  const auto& rows = test_rows();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    double value = -residual_change(rows[k]);
    if (k < in_use) {
      value -= constraints_end_.g_dot[rows_in_use_[k]] / scheme_.end_rate;
    } else if (scheme_.weight == 1.0) {
      value -= soft_stiffness_share_[k - in_use] * correction_change(rows[k]);
    }
    X_[static_cast<Eigen::Index>(k)] = value;
  }
  condensation_->solve_in_place(X_);
  condensation_->gather(force_rows(), X_, response_);
}

SmallNewton::Change SmallNewton::update(std::vector<BodyStep>& bodies, Vector& lambda) {
  Change change;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyIteration::Moved moved =
        shares_[b].advance(bodies[b], correction_[b], response_[b], model_.length);
    if (!(moved.frame <= change.size)) restless_body_ = b;
    change.size = larger(change.size, moved.frame);
    change.motion = larger(change.motion, moved.motion);
    if (!(change.size < HUGE_VAL)) return change;
    change.size = larger(change.size, moved.interface);
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    lambda[rows_in_use_[k]] += X_[static_cast<Eigen::Index>(k)] / scheme_.force;
  }
  return change;
}

bool SmallNewton::settled(const Change& change, const Change& before) const {
  // Rounding of positions bounds what any iteration can reach: 1e-15 L, or a change that no longer
  // falls and is within 1e-11 L.
  const double admitted = settings_.newton_tolerance * change.motion;
  if (change.size <= admitted + 1e-15 * model_.length) return true;
  if (contraction_ < kSlow && contraction_ * change.size <= kForeseen * admitted) return true;
  return before.size > 0.0 && change.size > 0.3 * before.size &&
         change.size <= 1e-11 * model_.length;
}

void SmallNewton::record_residuals(StepReport& report) const {
  if (constraints_end_.g.size() == 0) return;
  Eigen::Index worst = 0;
  report.position_residual = constraints_end_.g.cwiseAbs().maxCoeff(&worst);
  report.velocity_residual = constraints_end_.g_dot.cwiseAbs().maxCoeff();
  report.worst_row = static_cast<int>(worst);
}

void SmallNewton::iterate(std::vector<BodyStep>& bodies, double t, Vector& lambda,
                          StepReport& report) {
  leave_to_rows_in_use(lambda);
  Change change;
  Change before;
  for (int iteration = 0;; ++iteration) {
    evaluate(bodies, t, lambda);
    record_residuals(report);
    if (iteration > 0) {
      if (before.size > 0.0) contraction_ = change.size / before.size;
      if (settled(change, before)) break;
    }
    before = change;
    if (iteration == settings_.max_newton) {
      fail(t, report, "the step's iteration does not settle");
    }
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      shares_[b].find_residual(bodies[b], at_evaluation()[b], forces_.frame[b]);
    }
    solve_correction(bodies);
    solve_multipliers();
    change = update(bodies, lambda);
    ++report.newton_iterations;
    if (!(change.size < HUGE_VAL)) fail(t, report, "the motion is no longer finite");
  }
  watch_rows_not_in_use();
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
      "{:.3g} s, or look for a lock-up or a dead centre of the mechanism there",
      t, report.newton_iterations, what, where, scheme_.h));
}

}  // namespace buckens::stepping
