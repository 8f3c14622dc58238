// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/small_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/frame_equation.h"
#include "buckens/stepping/row_selection.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

using Eigen::Matrix3d;
using Eigen::VectorXd;
using linalg::Vector;

namespace {

// Pivots this much smaller than when the rows were chosen: others may have become the better
// choice.
constexpr double kPivotDrop = 1e-3;
// A row that follows from others stays closed to rounding; beyond this share of the model's length
// it no longer follows.
constexpr double kOpenRow = 1e-9;

/// Inverse of W restricted to the span of the basis, zero elsewhere.
Matrix3d restricted_inverse(const Matrix3d& W,
                            const Eigen::Matrix<double, 3, Eigen::Dynamic>& basis) {
  if (basis.cols() == 3) return W.inverse();
  if (basis.cols() == 0) return Matrix3d::Zero();
  const Eigen::MatrixXd reduced = basis.transpose() * W * basis;
  return basis * reduced.inverse() * basis.transpose();
}

Eigen::Matrix<double, 6, 6> frame_compliance(const body::Body& body,
                                             const body::DeformedMoments& moments,
                                             const Scheme& scheme, const Eigen::Vector3d& w) {
  Eigen::Matrix<double, 6, 6> out = Eigen::Matrix<double, 6, 6>::Zero();
  const Matrix3d W =
      scheme.mass * moments.J + scheme.damping * dynamics::gyroscopic_tangent(moments, w);
  out.topLeftCorner<3, 3>() = restricted_inverse(W, body.rotation_basis);
  out.bottomRightCorner<3, 3>() =
      body.translation_basis * body.translation_basis.transpose() / (scheme.mass * body.mass);
  return out;
}

double system_change(const dynamics::SystemRow& row, const std::vector<Vector6>& u,
                     const std::vector<VectorXd>& y) {
  double out = 0;
  for (const dynamics::BodyRow* part : {&row.first, &row.second}) {
    if (part->body == model::kGround) continue;
    const auto b = static_cast<std::size_t>(part->body);
    out += part->change(u[b], y[b]);
  }
  return out;
}

/// The larger number; not-a-number wins, so that it cannot hide.
double larger(double a, double b) { return b > a || std::isnan(b) ? b : a; }

/// Largest change of interface values [m]; that of c_ab·d counts by m L.
double interface_change(const body::Body& body, const VectorXd& dy) {
  const Eigen::Index rows = body.num_interface_rows();
  double out = 0;
  if (rows > 0) out = dy.head(rows).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (dy.size() == rows) return out;
  const double scale = body.mass * body.length_scale();
  return larger(out, dy.tail<6>().cwiseAbs().maxCoeff<Eigen::PropagateNaN>() / scale);
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
  const std::size_t count = model.bodies.size();
  end_.resize(count);
  evaluation_.resize(count);
  compliance_.resize(count);
  residual_frame_.assign(count, Vector6::Zero());
  residual_y_.resize(count);
  correction_.resize(count);
  response_.resize(count);
  correction_u_.assign(count, Vector6::Zero());
  for (std::size_t b = 0; b < count; ++b) {
    const Eigen::Index rows = operators_[b] ? operators_[b]->N().rows() : 0;
    has_quasi_static_ = has_quasi_static_ || is_quasi_static(b);
    residual_y_[b] = VectorXd::Zero(rows);
    correction_[b].interface_load = VectorXd::Zero(rows);
    response_[b].interface_load = VectorXd::Zero(rows);
  }
}

bool SmallNewton::is_quasi_static(std::size_t body) const {
  return operators_[body] != nullptr && operators_[body]->is_quasi_static();
}

dynamics::SystemRow SmallNewton::without_rates(dynamics::SystemRow row) const {
  for (dynamics::BodyRow* part : {&row.first, &row.second}) {
    if (part->body == model::kGround) continue;
    if (is_quasi_static(static_cast<std::size_t>(part->body))) part->interface.setZero();
  }
  return row;
}

const dynamics::Constraints& SmallNewton::at_evaluation() const {
  return scheme_.weight == 1.0 ? constraints_end_ : constraints_evaluation_;
}

bool SmallNewton::corrects_positions() const {
  return scheme_.weight == 1.0 || settings_.position_projection;
}

void SmallNewton::evaluate(std::vector<BodyStep>& bodies, double t, const Vector& lambda) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    end_[b] = bodies[b].motion_at_end(scheme_, operators_[b]);
    if (scheme_.weight != 1.0) {
      evaluation_[b] = bodies[b].motion_at_evaluation(scheme_, operators_[b]);
    }
  }
  const bool same = scheme_.weight == 1.0;
  const auto& motions = same ? end_ : evaluation_;
  const double t_e = scheme_.evaluation_time(t);
  dynamics::evaluate_constraints(model_, end_, t + scheme_.h, constraints_end_);
  keep_shapes_in_rates(bodies, t + scheme_.h);
  if (!same) dynamics::evaluate_constraints(model_, motions, t_e, constraints_evaluation_);
  dynamics::evaluate_forces(model_, motions, t_e, forces_);
  dynamics::add_joint_forces(at_evaluation(), lambda, forces_);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (operators_[b] == nullptr) continue;
    bodies[b].load = bodies[b].total_load(forces_.interface[b], motions[b].frame.w);
  }
}

void SmallNewton::keep_shapes_in_rates(const std::vector<BodyStep>& bodies, double t_end) {
  if (!has_quasi_static_) return;
  std::vector<dynamics::BodyMotion> motions;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    motions.push_back(bodies[b].uncorrected_motion(scheme_, operators_[b]));
  }
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model_, motions, t_end, constraints);
  constraints_end_.g_dot = constraints.g_dot;
}

void SmallNewton::prepare(std::vector<BodyStep>& bodies, double t) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    end_[b] = bodies[b].motion_at_end(scheme_, operators_[b]);
    evaluation_[b] = bodies[b].motion_at_evaluation(scheme_, operators_[b]);
    bodies[b].compliance =
        frame_compliance(model_.bodies[b], bodies[b].moments(model_.bodies[b], evaluation_[b]),
                         scheme_, evaluation_[b].frame.w);
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

bool SmallNewton::condense() {
  test_rows_.clear();
  force_rows_.clear();
  for (const int row : rows_in_use_) {
    test_rows_.push_back(without_rates(constraints_end_.rows[static_cast<std::size_t>(row)]));
    force_rows_.push_back(at_evaluation().rows[static_cast<std::size_t>(row)]);
  }
  std::vector<double> soft_compliance;
  soft_stiffness_share_.clear();
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    const double elastic = scheme_.weight * soft_.stiffness[k];
    const double k_eff = elastic + scheme_.mean_rate * soft_.damping[k];
    dynamics::SystemRow row = soft_.rows[k];
    if (k_eff == 0.0) row = {};
    test_rows_.push_back(row);
    force_rows_.push_back(row);
    soft_compliance.push_back(k_eff > 0.0 ? 1.0 / (scheme_.force * k_eff) : 1.0);
    soft_stiffness_share_.push_back(k_eff > 0.0 ? elastic / k_eff : 0.0);
  }
  if (!condensation_) {
    // Rows without effect keep the bodies they belong to, so that the pattern never changes.
    std::vector<dynamics::SystemRow> pattern = test_rows_;
    std::copy(soft_.rows.begin(), soft_.rows.end(),
              pattern.begin() + static_cast<std::ptrdiff_t>(rows_in_use_.size()));
    condensation_ = std::make_unique<dynamics::MultiplierCondensation>(
        static_cast<int>(model_.bodies.size()), pattern);
  }
  return condensation_->factorise(test_rows_, force_rows_, compliance_, soft_compliance);
}

bool SmallNewton::select_rows_anew() {
  has_open_rows_ = false;
  std::vector<dynamics::BodyCompliance> compliance = compliance_;
  for (std::size_t b = 0; b < compliance.size(); ++b) {
    if (is_quasi_static(b)) compliance[b].interface = nullptr;
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
  if (rows_in_use_.size() == static_cast<std::size_t>(lambda.size())) return;
  const Vector all = lambda;
  lambda.setZero();
  for (const int row : rows_in_use_) lambda[row] = all[row];
}

void SmallNewton::watch_rows_not_in_use() {
  if (rows_in_use_.size() == static_cast<std::size_t>(constraints_end_.g.size())) return;
  Vector open = constraints_end_.g;
  for (const int row : rows_in_use_) open[row] = 0.0;
  const double gap = open.cwiseAbs().maxCoeff();
  if (gap <= std::max(kOpenRow * model_.length, 2.0 * largest_gap_)) return;
  largest_gap_ = gap;
  has_open_rows_ = true;
}

void SmallNewton::residual_step(const std::vector<BodyStep>& bodies) {
  const auto& motions = scheme_.weight == 1.0 ? end_ : evaluation_;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyStep& step = bodies[b];
    const Vector6 acceleration = step.frame_acceleration(scheme_);
    const Vector6 inertia =
        dynamics::frame_inertia(model_.bodies[b], step.moments(model_.bodies[b], motions[b]),
                                motions[b].frame.w, acceleration.head<3>(), acceleration.tail<3>());
    residual_frame_[b] = step.compliance * (scheme_.force * (forces_.frame[b] - inertia));
    if (operators_[b] == nullptr) continue;
    const BodyStepOperator& op = *operators_[b];
    residual_y_[b] = step.y_free + op.compliance() * (scheme_.force * step.load) +
                     op.correction_compliance() * step.correction_load -
                     op.compliance() * step.correction_load - step.y_end;
  }
}

void SmallNewton::solve_correction(const std::vector<BodyStep>& bodies) {
  const auto in_use = static_cast<Eigen::Index>(rows_in_use_.size());
  E_ = Vector::Zero(condensation_->size());
  if (corrects_positions()) {
    for (Eigen::Index k = 0; k < in_use; ++k) {
      const int row = rows_in_use_[static_cast<std::size_t>(k)];
      E_[k] = constraints_end_.g_dot[row] / scheme_.end_rate - constraints_end_.g[row];
    }
    condensation_->solve_in_place(E_);
  }
  condensation_->gather(force_rows_, E_, correction_);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    correction_u_[b] = bodies[b].compliance * correction_[b].frame_load;
    // Frames alone close what a changed deformation opens.
    if (is_quasi_static(b)) correction_[b].interface_load.setZero();
  }
}

void SmallNewton::solve_multipliers(const std::vector<BodyStep>& bodies) {
  // Velocity-carrying change of y at fixed multipliers, and the correction's own displacement.
  std::vector<VectorXd> y_moving(bodies.size());
  std::vector<VectorXd> y_correcting(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (operators_[b] == nullptr) continue;
    const VectorXd& e = correction_[b].interface_load;
    y_correcting[b] = operators_[b]->compliance() * e;
    y_moving[b] = residual_y_[b] + operators_[b]->correction_compliance() * e - y_correcting[b];
  }
  X_.resize(condensation_->size());
  const std::size_t in_use = rows_in_use_.size();
  for (std::size_t k = 0; k < test_rows_.size(); ++k) {
    double value = -system_change(test_rows_[k], residual_frame_, y_moving);
    if (k < in_use) {
      value -= constraints_end_.g_dot[rows_in_use_[k]] / scheme_.end_rate;
    } else if (scheme_.weight == 1.0) {
      value -= soft_stiffness_share_[k - in_use] *
               system_change(test_rows_[k], correction_u_, y_correcting);
    }
    X_[static_cast<Eigen::Index>(k)] = value;
  }
  condensation_->solve_in_place(X_);
  condensation_->gather(force_rows_, X_, response_);
}

SmallNewton::Change SmallNewton::update(std::vector<BodyStep>& bodies, Vector& lambda) {
  Change change;
  const double L = model_.length;
  const auto size = [&](const Vector6& u) {
    return larger(L * u.head<3>().cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
                  u.tail<3>().cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  };
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    BodyStep& step = bodies[b];
    const Vector6 du = residual_frame_[b] + step.compliance * response_[b].frame_load;
    step.u += du;
    step.correction += correction_u_[b];
    const double moved = size(du) + size(correction_u_[b]);
    if (!(moved <= change.size)) restless_body_ = b;
    change.size = larger(change.size, moved);
    change.motion = larger(change.motion, size(step.u));
    if (!(change.size < HUGE_VAL)) return change;
    if (operators_[b] == nullptr || step.y_end.size() == 0) continue;
    const BodyStepOperator& op = *operators_[b];
    const VectorXd& e = correction_[b].interface_load;
    const VectorXd dy = residual_y_[b] + op.compliance() * response_[b].interface_load +
                        op.correction_compliance() * e - op.compliance() * e;
    step.y_end += dy;
    step.correction_load += e;
    change.size = larger(change.size, interface_change(model_.bodies[b], dy));
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    lambda[rows_in_use_[k]] += X_[static_cast<Eigen::Index>(k)] / scheme_.force;
  }
  return change;
}

bool SmallNewton::settled(const Change& change, const Change& before) const {
  // Rounding of positions bounds what any iteration can reach: 1e-15 L, or a change that no longer
  // falls and is within 1e-11 L.
  const double limit = settings_.newton_tolerance * change.motion + 1e-15 * model_.length;
  if (change.size <= limit) return true;
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
    if (iteration > 0 && settled(change, before)) break;
    before = change;
    if (iteration == settings_.max_newton) {
      fail(t, report, "the step's iteration does not settle");
    }
    residual_step(bodies);
    solve_correction(bodies);
    solve_multipliers(bodies);
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
