// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/work_account.h"

#include <cmath>

#include "buckens/dynamics/energy.h"
#include "buckens/dynamics/forces.h"

namespace buckens::analysis {

WorkAccount::WorkAccount(const model::Model& model, const model::State& start)
    : model_(model),
      before_(powers(start)),
      t_(start.t),
      lambda_before_(start.lambda),
      lambda_start_(start.lambda),
      lambda_time_(start.lambda_time) {}

WorkAccount::Powers WorkAccount::powers(const model::State& state) const {
  Powers out;
  const auto motions = dynamics::motions_of(model_, state);
  dynamics::Forces forces;
  dynamics::evaluate_forces(model_, motions, state.t, forces);
  out.active = forces.active_power + forces.dissipation;
  out.damping = dynamics::damping_power(model_, state) + forces.dissipation;
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model_, motions, state.t, constraints);
  out.g_t = constraints.g_t;
  return out;
}

void WorkAccount::add(const model::State& state) {
  const Powers now = powers(state);
  const double h = state.t - t_;
  // Joints take −λ·g_t from their drives. A λ that belongs to mid-step meets the mean of g_t; one
  // that belongs to a later instant (Wilson) is taken back to the end of the step.
  const bool is_mean = state.lambda_time < state.t - 0.25 * h;
  linalg::Vector lambda = state.lambda;
  if (state.lambda_time > state.t + 0.25 * h) {
    const double s = (state.t - lambda_time_) / (state.lambda_time - lambda_time_);
    lambda = (1.0 - s) * lambda_before_ + s * state.lambda;
  }
  const double drive = is_mean ? -0.5 * state.lambda.dot(before_.g_t + now.g_t)
                               : -0.5 * (lambda_start_.dot(before_.g_t) + lambda.dot(now.g_t));
  const double active = 0.5 * (before_.active + now.active) + drive;
  const double damping = 0.5 * (before_.damping + now.damping);
  work_before_ = work_;
  work_.external += h * active;
  work_.dissipated += h * damping;
  turnover_ += h * (std::abs(active) + damping);
  before_ = now;
  lambda_before_ = state.lambda;
  lambda_start_ = lambda;
  lambda_time_ = state.lambda_time;
  t_ = state.t;
}

}  // namespace buckens::analysis
