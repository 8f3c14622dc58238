// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/energy.h"

#include "buckens/dynamics/forces.h"

namespace buckens::dynamics {

using Eigen::Vector3d;

namespace {

bool is_fully_coupled(const body::Body& body) {
  return body.is_flexible() && body.flexible->coupling == body::CouplingLevel::full;
}

/// J w + l in body axes.
Vector3d angular_momentum(const body::Body& body, const model::BodyState& state) {
  if (!is_fully_coupled(body)) return body.J0 * state.frame.w;
  const auto& invariants = body.flexible->invariants;
  return invariants.rotary_inertia(state.d) * state.frame.w +
         invariants.relative_momentum(state.d, state.d_dot);
}

double kinetic_energy(const body::Body& body, const model::BodyState& state) {
  const Vector3d& w = state.frame.w;
  double T = 0.5 * body.mass * state.frame.v.squaredNorm();
  if (is_fully_coupled(body)) {
    const auto& invariants = body.flexible->invariants;
    T += 0.5 * w.dot(invariants.rotary_inertia(state.d) * w) +
         w.dot(invariants.relative_momentum(state.d, state.d_dot));
  } else {
    T += 0.5 * w.dot(body.J0 * w);
  }
  if (body.is_flexible()) T += 0.5 * state.d_dot.dot(body.flexible->fe.M * state.d_dot);
  return T;
}

}  // namespace

Energy energy(const model::Model& model, const model::State& state) {
  Energy out;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    const model::BodyState& s = state.bodies[b];
    out.kinetic += kinetic_energy(body, s);
    out.gravity -= body.mass * model.gravity.dot(s.frame.X_WB.p);
    if (body.is_flexible()) out.strain += 0.5 * s.d.dot(body.flexible->fe.K * s.d);
  }
  Forces forces;
  evaluate_forces(model, motions_of(model, state), state.t, forces);
  out.springs = forces.stored_energy;
  return out;
}

Momentum momentum(const model::Model& model, const model::State& state) {
  Momentum out;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::BodyState& s = state.bodies[b];
    const Vector3d p = model.bodies[b].mass * s.frame.v;
    out.linear += p;
    out.angular += s.frame.X_WB.q * angular_momentum(model.bodies[b], s) + s.frame.X_WB.p.cross(p);
  }
  return out;
}

double damping_power(const model::Model& model, const model::State& state) {
  double power = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    if (!body.is_flexible() || !body.flexible->is_damped()) continue;
    const linalg::Vector& rate = state.bodies[b].d_dot;
    power += rate.dot(body.flexible->C * rate);
  }
  return power;
}

}  // namespace buckens::dynamics
