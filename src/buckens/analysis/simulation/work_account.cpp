// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/work_account.h"

#include <cmath>

#include "buckens/loads/contact_friction.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

WorkAccount::WorkAccount(const model::Model& model, const model::State& start, bool holds_at_states)
    : model_(model),
      joints_(model),
      before_(powers(start)),
      laws_before_(start.memory.laws),
      t_(start.t),
      lambda_before_(start.lambda),
      lambda_start_(start.lambda),
      lambda_time_(start.lambda_time) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    if (!body.is_flexible() || !body.flexible->is_damped()) continue;
    meshes_.emplace_back(model, b, start, holds_at_states);
  }
}

WorkAccount::Powers WorkAccount::powers_at(const model::State& state,
                                           const std::vector<dynamics::BodyMotion>& motions) {
  Powers out;
  dynamics::evaluate_forces(model_, motions, state.t, dynamics::circumstances_of(state), forces_);
  out.active = forces_.active_power + forces_.dissipation;
  out.damping = forces_.dissipation;
  return out;
}

WorkAccount::Powers WorkAccount::powers(const model::State& state) {
  const auto motions = dynamics::motions_of(model_, state);
  Powers out = powers_at(state, motions);
  joints_.evaluate(motions, state.t, &state.memory, residuals_, &state.lambda, &forces_);
  out.g_t = residuals_.g_t;
  return out;
}

void WorkAccount::take_inputs(const model::State& state) {
  before_ = powers(state);
  laws_before_ = state.memory.laws;
}

double WorkAccount::landed(const model::State& state) const {
  double sum = 0;
  const auto motions = dynamics::motions_of(model_, state);
  for (std::size_t k = 0; k < model_.loads.size(); ++k) {
    const model::Load& load = model_.loads[k];
    if (dynamic_cast<const loads::ContactFriction*>(load.element.get()) == nullptr) continue;
    if (laws_before_[load.first_state] != 0.0 || state.memory.is_off(k)) continue;
    const auto first = dynamics::evaluate_marker(model_, load.first, motions).motion;
    const auto second = dynamics::evaluate_marker(model_, load.second, motions).motion;
    sum += dynamics::action_of(model_, k, state.t, dynamics::circumstances_of(state), first, second)
               .dissipation;
  }
  return sum;
}

void WorkAccount::take_event(const model::State& state, double gained, double lost) {
  take_inputs(state);
  lambda_before_ = lambda_start_ = state.lambda;
  lambda_time_ = state.lambda_time;
  work_.external += gained;
  work_.dissipated += lost;
  turnover_ += std::abs(gained) + lost;
}

void WorkAccount::restart(const model::State& state) {
  take_event(state, 0.0, 0.0);
  for (DampingWork& mesh : meshes_) mesh.start(state);
}

long WorkAccount::num_products() const {
  long sum = 0;
  for (const DampingWork& mesh : meshes_) sum += mesh.num_products();
  return sum;
}

void WorkAccount::add(const model::State& state) {
  const Powers now = powers(state);
  Powers mean;
  mean.active = 0.5 * (before_.active + now.active);
  mean.damping = 0.5 * (before_.damping + now.damping);
  add(state, now, mean, 0.0, RatesAtEnd::are_smooth);
}

void WorkAccount::add_impacts(const model::State& before, const model::State& state, double loss) {
  const double h = state.t - t_;
  auto first = dynamics::motions_of(model_, before);
  auto last = dynamics::motions_of(model_, state);
  for (std::size_t b = 0; b < first.size(); ++b) {
    const spatial::Pose& from = first[b].frame.X_WB;
    const spatial::Pose& to = last[b].frame.X_WB;
    first[b].frame.v = last[b].frame.v = (to.p - from.p) / h;
    first[b].frame.w = last[b].frame.w = spatial::log_rotation(from.q.conjugate() * to.q) / h;
    first[b].y_dot = last[b].y_dot = (last[b].y - first[b].y) / h;
  }
  Powers mean;
  mean.active = 0.5 * (powers_at(before, first).active + powers_at(state, last).active);
  // What closed rows hold must be seen at rest.
  const Powers now = powers(state);
  mean.damping = 0.5 * (before_.damping + now.damping - landed(state));
  add(state, now, mean, loss, RatesAtEnd::have_jumped);
}

void WorkAccount::add(const model::State& state, const Powers& now, const Powers& loads,
                      double impact_loss, RatesAtEnd rates) {
  const double h = state.t - t_;
  // Joints receive −λ·g_t from their drives. A λ at mid-step is multiplied by the mean of g_t; one
  // at a later instant (Wilson) is interpolated to the end of the step.
  const bool is_mean = state.lambda_time < state.t - 0.25 * h;
  linalg::Vector lambda = state.lambda;
  if (state.lambda_time > state.t + 0.25 * h) {
    const double s = (state.t - lambda_time_) / (state.lambda_time - lambda_time_);
    lambda = (1.0 - s) * lambda_before_ + s * state.lambda;
  }
  const double drive = is_mean ? -0.5 * state.lambda.dot(before_.g_t + now.g_t)
                               : -0.5 * (lambda_start_.dot(before_.g_t) + lambda.dot(now.g_t));
  const double active = loads.active + drive;
  double dissipated = h * loads.damping + impact_loss;
  for (DampingWork& mesh : meshes_) dissipated += mesh.add(state, forces_, rates);
  work_before_ = work_;
  work_.external += h * active;
  work_.dissipated += dissipated;
  turnover_ += h * std::abs(active) + dissipated;
  before_ = now;
  if (model_.num_rigid_rows() > 0) laws_before_ = state.memory.laws;
  lambda_before_ = state.lambda;
  lambda_start_ = lambda;
  lambda_time_ = state.lambda_time;
  t_ = state.t;
}

}  // namespace buckens::analysis
