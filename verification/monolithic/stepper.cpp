// SPDX-License-Identifier: Apache-2.0
#include "verification/monolithic/stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "verification/monolithic/part.h"

#include "buckens/base/errors.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/drives.h"
#include "buckens/dynamics/frame_equation.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/stepping/change_of_step.h"

namespace buckens::verification {

using Eigen::Vector3d;
using linalg::SparseMatrix;
using linalg::Triplet;
using linalg::Vector;
using Vector6 = Eigen::Matrix<double, 6, 1>;

MonolithicStepper::MonolithicStepper(const model::Model& model,
                                     const stepping::StepSettings& settings,
                                     std::vector<int> rows_in_use)
    : model_(model),
      settings_(settings),
      scheme_(settings.method, settings.step, settings.method_parameter()),
      rows_in_use_(std::move(rows_in_use)),
      rates_only_(dynamics::rate_only_rows(model)),
      rigid_(model),
      held_(model) {
  const auto take = [this](Eigen::Index count) {
    const int first = size_;
    size_ += static_cast<int>(count);
    return first;
  };
  for (const body::Body& body : model.bodies) {
    auto part = std::make_unique<Part>(body);
    part->frame = take(part->basis.cols());
    part->frame_correction = take(part->basis.cols());
    part->nodal = take(body.num_dofs());
    part->nodal_multiplier = take(part->P.cols());
    part->nodal_correction = take(body.num_dofs());
    part->correction_multiplier = take(part->P.cols());
    parts_.push_back(std::move(part));
  }
  first_lambda_ = take(static_cast<Eigen::Index>(rows_in_use_.size()));
  first_correction_ = take(static_cast<Eigen::Index>(rows_in_use_.size()));
  first_rigid_ = take(model.num_rigid_rows());
  first_rigid_correction_ = take(model.num_rigid_rows());
}

MonolithicStepper::~MonolithicStepper() = default;

bool MonolithicStepper::corrects_positions() const {
  return scheme_.weight == 1.0 || settings_.position_projection;
}

void MonolithicStepper::start(const model::State& state) {
  z_ = Vector::Zero(size_);
  regimes_before_.clear();
  lambda_ = state.lambda;
  inputs_ = state.inputs;
  memory_ = state.memory;
  rigid_.start(memory_, scheme_.undone_at_end());
  for (std::size_t k = 0; k < rigid_.stands().size(); ++k) {
    z_[first_rigid_ + static_cast<int>(k)] = scheme_.force * rigid_.stands()[k].force;
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    z_[first_lambda_ + static_cast<int>(k)] = scheme_.force * lambda_[rows_in_use_[k]];
  }
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    Part& part = *parts_[b];
    const model::BodyState& s = state.bodies[b];
    part.before = &s;
    Vector6 rate, acceleration, algorithmic;
    rate << s.frame.w, s.frame.v;
    acceleration << s.w_dot, s.v_dot;
    algorithmic << s.w_alg, s.v_alg;
    part.frame_history = scheme_.history<Vector6>(rate, acceleration, algorithmic);
    part.u = part.frame_history.predicted;
    part.kappa.setZero();
    if (!part.is_flexible()) {
      part.moments = dynamics::undeformed_moments(part.body);
      continue;
    }
    part.nodal_history = scheme_.history<Vector>(s.d_dot, s.d_ddot, s.d_alg);
    part.delta = part.nodal_history.predicted;
    part.eta = Vector::Zero(s.d.size());
    // The step starts from the coupling extrapolated from previous steps, and W keeps it.
    if (!s.terms.are_lagged()) {
      part.coupling = {};
    } else if (state.history > 0) {
      dynamics::extrapolate(s, state.history, scheme_.evaluation_time(state.t), part.coupling);
    } else {
      part.coupling = dynamics::evaluate_coupling(part.body, s.terms, s.d, s.d_dot, s.d_ddot,
                                                  s.frame.w, s.w_dot);
    }
    Vector d = s.d.whole() + scheme_.weight * part.delta;
    if (scheme_.has_offset()) d += part.nodal_history.offset;
    part.set_moments(d, scheme_.mean_rate * part.delta + part.nodal_history.mean_velocity);
    z_.segment(part.nodal, s.d.size()) = part.delta;
  }
}

void MonolithicStepper::evaluate(double t) {
  motions_end_.resize(parts_.size());
  motions_evaluation_.resize(parts_.size());
  const bool at_end = scheme_.weight == 1.0;
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const Part& part = *parts_[b];
    motions_end_[b] = part.motion(1.0, true, false, scheme_.end_rate, part.frame_history.velocity,
                                  &part.nodal_history.velocity);
    motions_evaluation_[b] =
        part.motion(scheme_.weight, at_end, scheme_.has_offset(), scheme_.mean_rate,
                    part.frame_history.mean_velocity, &part.nodal_history.mean_velocity);
  }
  dynamics::steer_drives(model_, motions_end_, t + scheme_.h, around(), forces_.signals, memory_);
  const double t_e = scheme_.evaluation_time(t);
  dynamics::evaluate_constraints(model_, motions_end_, t + scheme_.h, &memory_, end_);
  dynamics::evaluate_constraints(model_, motions_evaluation_, t_e, &memory_, evaluation_);
  const auto act = [&] {
    dynamics::evaluate_forces(model_, motions_evaluation_, t_e, around(), forces_);
  };
  act();
  if (rigid_.let_go(forces_.rigid)) act();
  dynamics::evaluate_soft_rows(model_, motions_evaluation_, t_e, around(), soft_);
  dynamics::add_joint_forces(evaluation_, lambda_, forces_);
}

void MonolithicStepper::predict(double t) {
  evaluate(t);
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    parts_[b]->W = parts_[b]->metric(scheme_, motions_evaluation_[b].frame.w);
  }
  predicted_rows_ = evaluation_.rows;
  correcting_ = soft_;
  fixed_part();
}

void MonolithicStepper::update_coupling(Part& part) {
  if (!part.is_flexible()) return;
  Vector d = part.before->d.whole() + scheme_.weight * part.delta;
  if (scheme_.weight == 1.0) d += part.eta;
  if (scheme_.has_offset()) d += part.nodal_history.offset;
  const Vector6 w = scheme_.mean_rate * part.u + part.frame_history.mean_velocity;
  const Vector6 w_dot = scheme_.acceleration_rate * part.u + part.frame_history.acceleration;
  const Vector d_dot = scheme_.mean_rate * part.delta + part.nodal_history.mean_velocity;
  part.coupling = dynamics::evaluate_coupling(
      part.body, part.before->terms, d, d_dot,
      scheme_.acceleration_rate * part.delta + part.nodal_history.acceleration, w.head<3>(),
      w_dot.head<3>());
  part.set_moments(d, d_dot);
}

void MonolithicStepper::body_residual(std::size_t b, Vector& r) const {
  const Part& part = *parts_[b];
  const Vector6 acceleration = scheme_.acceleration_rate * part.u + part.frame_history.acceleration;
  const Vector3d& w = motions_evaluation_[b].frame.w;
  const Vector6 inertia = dynamics::frame_inertia(part.body, part.moments, w,
                                                  acceleration.head<3>(), acceleration.tail<3>());
  r.segment(part.frame, part.basis.cols()) =
      part.basis.transpose() * (scheme_.force * (inertia - forces_.frame[b]));
  if (!part.is_flexible()) return;
  const body::FlexiblePart& mesh = *part.body.flexible;
  Vector load = -(mesh.fe.M * part.nodal_history.acceleration) - mesh.fe.K * part.before->d.whole();
  if (scheme_.has_offset()) load -= mesh.fe.K * part.nodal_history.offset;
  if (mesh.is_damped()) load -= mesh.C * part.nodal_history.mean_velocity;
  load += mesh.rows.topRows(mesh.num_interface_rows).transpose() * forces_.interface[b];
  if (part.before->terms.have_load()) load += part.coupling.load.whole();
  load +=
      mesh.invariants.centrifugal_patterns() * dynamics::centrifugal_weights(part.before->terms, w);
  r.segment(part.nodal, load.size()) -= scheme_.force * load;
  Vector at_rest = part.before->d;  // Pᵀx_e = 0, per θ
  if (scheme_.has_offset()) at_rest = (at_rest + part.nodal_history.offset) / scheme_.weight;
  r.segment(part.nodal_multiplier, part.P.cols()) += part.P.transpose() * at_rest;
}

Vector MonolithicStepper::residual(double t) const {
  Vector r = fixed_matrix_ * z_;
  for (std::size_t b = 0; b < parts_.size(); ++b) body_residual(b, r);
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    const int row = rows_in_use_[k];
    r[first_lambda_ + static_cast<int>(k)] = end_.g_dot[row] / scheme_.end_rate;
    if (corrects_positions() && !rates_only_[static_cast<std::size_t>(row)]) {
      r[first_correction_ + static_cast<int>(k)] = end_.g[row];
    }
  }
  rigid_residual(r);
  held_residual(t, r);
  return r;
}

double MonolithicStepper::apply(const Vector& change, double& motion) {
  z_ += change;
  const auto size = [this](const Vector6& u) {
    return std::max(model_.length * u.head<3>().cwiseAbs().maxCoeff(),
                    u.tail<3>().cwiseAbs().maxCoeff());
  };
  double largest = 0;
  motion = 0;
  for (const auto& p : parts_) {
    Part& part = *p;
    const Eigen::Index count = part.basis.cols();
    const Vector6 du = part.basis * change.segment(part.frame, count);
    const Vector6 dk = part.basis * change.segment(part.frame_correction, count);
    part.u += du;
    part.kappa += dk;
    largest = std::max(largest, size(du) + size(dk));
    motion = std::max(motion, size(part.u));
    if (!part.is_flexible()) continue;
    const Eigen::Index n = part.delta.size();
    part.delta = z_.segment(part.nodal, n);
    part.eta = z_.segment(part.nodal_correction, n);
    largest = std::max(largest, change.segment(part.nodal, n).cwiseAbs().maxCoeff());
    largest = std::max(largest, change.segment(part.nodal_correction, n).cwiseAbs().maxCoeff());
  }
  for (std::size_t k = 0; k < rows_in_use_.size(); ++k) {
    lambda_[rows_in_use_[k]] = z_[first_lambda_ + static_cast<int>(k)] / scheme_.force;
  }
  for (std::size_t k = 0; k < rigid_.stands().size(); ++k) {
    const int row = static_cast<int>(k);
    if (!forces_.rigid[k].is_closed) continue;
    rigid_.add_force(row, z_[first_rigid_ + row] / scheme_.force - rigid_.stands()[k].force);
  }
  return largest;
}

void MonolithicStepper::iterate(double t, stepping::StepReport& report) {
  double before = 0;
  for (int iteration = 0; iteration < settings_.max_newton; ++iteration) {
    follow_regimes();
    hold_reversed(t);
    std::vector<Triplet> all = fixed_;
    tangent(all);
    rigid_tangent(all);
    SparseMatrix A(size_, size_);
    A.setFromTriplets(all.begin(), all.end());
    if (!lu_.factorise(A)) {
      throw NumericalError(
          fmt::format("step at t = {:.6g} s failed: the monolithic matrix is singular; the joint "
                      "equations have become dependent",
                      t));
    }
    double motion = 0;
    const double change = apply(lu_.solve(Vector(-residual(t))), motion);
    ++report.newton_iterations;
    for (const auto& part : parts_) update_coupling(*part);
    evaluate(t);
    // Rounding of positions limits what can be reached; slow convergence is not mistaken for it.
    const bool is_settled =
        change <= settings_.newton_tolerance * motion + 1e-15 * model_.length ||
        (before > 0 && change > 0.9 * before && change <= 1e-11 * model_.length);
    if (is_settled && !move_rigid_rows()) return;
    if (is_settled) evaluate(t);
    before = is_settled ? 0 : change;
  }
  throw NumericalError(
      fmt::format("step at t = {:.6g} s failed: the monolithic iteration does not converge within "
                  "{} iterations (last change {:.3g} m); use a smaller step than {:.3g} s",
                  t, settings_.max_newton, before, scheme_.h));
}

model::State MonolithicStepper::next_state(const model::State& state) const {
  model::State next;
  next.t = state.t + scheme_.h;
  next.lambda = lambda_;
  next.lambda_time = scheme_.evaluation_time(state.t);
  next.last_step = scheme_.h;
  next.history = std::min(3, state.history + 1);
  next.inputs = state.inputs;
  dynamics::advance_memory(model_, motions_end_, next.t, around(), next.memory);
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const Part& part = *parts_[b];
    const model::BodyState& old = state.bodies[b];
    model::BodyState& s = next.bodies.emplace_back();
    s.frame = motions_end_[b].frame;
    const Vector6 acceleration =
        scheme_.acceleration_rate * part.u + part.frame_history.acceleration;
    s.w_dot = scheme_.carried_acceleration<Vector3d>(old.w_dot, acceleration.head<3>());
    s.v_dot = scheme_.carried_acceleration<Vector3d>(old.v_dot, acceleration.tail<3>());
    s.w_alg = scheme_.algorithmic(old.w_dot, old.w_alg, s.w_dot);
    s.v_alg = scheme_.algorithmic(old.v_dot, old.v_alg, s.v_dot);
    s.terms = old.terms;
    if (!part.is_flexible()) continue;
    s.d = old.d.whole() + part.delta + part.eta;
    s.d_dot = scheme_.end_rate * part.delta + part.nodal_history.velocity;
    s.d_ddot = scheme_.carried_acceleration<Vector>(
        old.d_ddot, scheme_.acceleration_rate * part.delta + part.nodal_history.acceleration);
    s.d_alg = scheme_.algorithmic<Vector>(old.d_ddot, old.d_alg, s.d_ddot);
    s.coupling = part.coupling;
    s.coupling.t = scheme_.evaluation_time(state.t);
    s.coupling_before = old.coupling;
    s.coupling_earlier = old.coupling_before;
  }
  return next;
}

stepping::StepReport MonolithicStepper::step(model::State& state) {
  stepping::StepReport report;
  model::State from = state;
  if (stepping::must_rescale(state, scheme_)) stepping::rescale_algorithmic(from, scheme_);
  start(from);
  predict(state.t);
  iterate(state.t, report);
  if (end_.g.size() > 0) {
    Eigen::Index worst = 0;
    report.position_residual = end_.g.cwiseAbs().maxCoeff(&worst);
    report.velocity_residual = end_.g_dot.cwiseAbs().maxCoeff();
    report.worst_row = static_cast<int>(worst);
  }
  state = next_state(from);
  return report;
}

}  // namespace buckens::verification
