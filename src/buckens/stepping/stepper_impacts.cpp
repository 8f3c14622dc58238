// SPDX-License-Identifier: Apache-2.0
// How a step takes impacts, and what begins anew after them.
#include <utility>

#include "buckens/dynamics/energy.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/spatial/rotation.h"
#include "buckens/stepping/stepper.h"
#include "buckens/stepping/strand/step.h"
#include "buckens/stepping/struck_rows.h"

namespace buckens::stepping {

using Eigen::Vector3d;
using linalg::Vector;

void Stepper::take_impacts(StepReport& report) {
  if (!impacts_->can_happen()) return;
  const std::vector<dynamics::BodyMotion>& before = newton_->motions_at_end();
  if (!impacts_->find(before, bodies_, newton_->rows_in_use(), newton_->around(), next_.t)) return;
  std::vector<dynamics::BodyMotion> motions = before;
  const bool counts_energy = impacts_->stay_on_meshes();
  const double energy = counts_energy ? dynamics::energy(model_, next_).total() : 0.0;
  if (counts_energy) {
    keep_before_blows();
    report.before_blows = before_blows_;
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) add_jump(b, impacts_->jumps()[b], motions[b]);
  if (counts_energy) impacts_->lose_in_all(energy - dynamics::energy(model_, next_).total());
  model::RowMemory memory;
  dynamics::advance_memory(model_, motions, next_.t, newton_->around(), memory);
  follow_struck_rows(model_, before, motions, next_.t, newton_->around(), memory);
  for (const Impacts::Landing& landing : impacts_->landings()) {
    const model::Load& load = model_.load_of_rigid_row(landing.rigid_row);
    memory.laws[load.first_state] = landing.regime;
    if (landing.regime == 0) memory.laws[load.first_state + 1] = 0.0;
  }
  next_.memory = std::move(memory);
  next_.history = 0;  // what coupling loads were no longer tells what they will be
  report.impacts = impacts_->count();
  report.impact_loss = impacts_->loss();
  report.jammed_impacts = impacts_->jammed();
  report.has_near_impulses = impacts_->are_near();
  report.impact_shares = impacts_->shares();
  report.impact_rest = impacts_->rest();
  report.must_settle = true;
  report.ends_have_turned = false;  // the rates that turn have been struck
}

void Stepper::keep_before_blows() {
  before_blows_.resize(bodies_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const bool moves = flexible_[b] && !operators_[b]->is_quasi_static();
    if (!moves || !model_.bodies[b].flexible->is_damped()) continue;
    before_blows_[b].d = next_.bodies[b].d.whole();
    before_blows_[b].d_dot = next_.bodies[b].d_dot.whole();
  }
}

void Stepper::add_jump(std::size_t b, const BodyJump& jump, dynamics::BodyMotion& motion) {
  model::BodyState& s = next_.bodies[b];
  // Since the impact it has turned with the velocity before it, in place of the one after it.
  const double rest = jump.since;
  const Eigen::Quaterniond undone = spatial::exp_rotation(-rest * s.frame.w);
  const Vector3d turned = rest * s.frame.w + jump.shift.head<3>();
  s.frame.w += jump.velocity.head<3>();
  s.frame.v += jump.velocity.tail<3>();
  s.frame.X_WB.p += jump.shift.tail<3>();
  s.frame.X_WB.q = (s.frame.X_WB.q * undone * spatial::exp_rotation(turned)).normalized();
  motion.frame = s.frame;
  if (!flexible_[b] || operators_[b]->is_quasi_static()) return;
  add_impulse(b, jump.impulse, s.d_dot);
  add_impulse(b, jump.impulse_time, s.d);
  const InterfaceRows& N = operators_[b]->interface_rows();
  motion.y.head(jump.impulse.size()) = N.topRows(jump.impulse.size()) * s.d.whole();
  motion.y_dot.head(jump.impulse.size()) = N.topRows(jump.impulse.size()) * s.d_dot.whole();
}

void Stepper::filter_algorithmic(model::State& state) {
  if (!scheme_.damps()) return;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!flexible_[b] || operators_[b]->is_quasi_static()) continue;
    model::BodyState& s = state.bodies[b];
    BodyStepOperator& op = *operators_[b];
    Vector& d_alg = s.d_alg.overwrite(s.d_ddot.size());
    op.inertial().multiply_mass(s.d_ddot, d_alg, pool_);
    d_alg *= scheme_.mass;
    op.solve_right_side(d_alg, pool_);
    op.sieve().apply(d_alg);
  }
}

bool Stepper::take_mean_of_turning(const model::State& before, model::State& after) {
  bool has_any = false;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!flexible_[b] || operators_[b]->is_quasi_static()) continue;
    BodyStepOperator& op = *operators_[b];
    const InertialLoad& inertial = op.inertial();
    if (!inertial.is_damped()) continue;
    has_any = true;
    Vector& rates = after.bodies[b].d_dot.change();
    Vector turning = 0.5 * (rates - before.bodies[b].d_dot.whole());
    for (int k = 0; k < 2; ++k) {
      const Vector load = scheme_.damping * turning;
      if (inertial.is_proportional()) {
        inertial.multiply_mass(load, turning, pool_);
        turning *= inertial.zeta();
      } else {
        inertial.multiply(Vector::Zero(load.size()), load, turning, pool_);
      }
      op.solve_right_side(turning, pool_);
      turning += inertial.share() * load;
      op.sieve().apply(turning);
    }
    rates -= turning;
  }
  return has_any;
}

linalg::Matrix Stepper::impulse_compliance(std::size_t body) const {
  return Impacts::impulse_compliance(scheme_, operators_[body].get());
}

void Stepper::add_impulse(std::size_t body, const Vector& impulse,
                          linalg::NodalVector& rates) const {
  // c G f answers a load f; an impulse is answered by k₀ G.
  const BodyStepOperator& op = *operators_[body];
  Vector load = Vector::Zero(op.num_rows());
  load.head(impulse.size()) = scheme_.acceleration_rate * impulse;
  if (op.divided() == nullptr) {
    op.add_answer(load, 0, rates.change());
  } else if (!impulse.isZero(0.0)) {
    rates = op.divided()->plus_answer(rates, load, scheme_.force);
  }
}

}  // namespace buckens::stepping
