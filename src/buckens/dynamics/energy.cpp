// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/energy.h"

#include "buckens/dynamics/forces.h"

namespace buckens::dynamics {

using Eigen::Vector3d;

namespace {

/// J and l of the kinetic energy of the terms a body keeps. Sets of terms without one are judged by
/// the exact one.
body::DeformedMoments inertia(const body::Body& body, const model::BodyState& state) {
  body::DeformedMoments out;
  out.J = body.J0;
  body::CouplingTerms inertial = state.terms;
  inertial.stiffening = false;  // a load, no inertia
  if (!body.is_flexible() || inertial == body::CouplingTerms::none()) return out;
  const auto& invariants = body.flexible->invariants;
  if (inertial == body::CouplingTerms::first_order()) {
    out.J += invariants.linear_inertia(invariants.centrifugal_patterns().transpose() * state.d);
    return out;
  }
  out.J = invariants.rotary_inertia(state.d);
  out.l = invariants.relative_momentum(state.d, state.d_dot);
  return out;
}

double kinetic_energy(const body::Body& body, const model::BodyState& state) {
  const Vector3d& w = state.frame.w;
  double T = 0.5 * body.mass * state.frame.v.squaredNorm();
  const body::DeformedMoments moments = inertia(body, state);
  T += 0.5 * w.dot(moments.J * w) + w.dot(moments.l);
  if (body.is_flexible()) T += 0.5 * state.d_dot.dot(body.flexible->fe.M * state.d_dot);
  return T;
}

}  // namespace

Energy energy(const model::Model& model, const model::State& state) {
  Energy out;
  const Vector3d gravity = gravity_at(model, state.memory.signals);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    const model::BodyState& s = state.bodies[b];
    out.kinetic += kinetic_energy(body, s);
    out.gravity -= body.mass * gravity.dot(s.frame.X_WB.p);
    // The motion of a quasi-static body does no work on its deformation.
    if (body.is_flexible() && !body.flexible->is_quasi_static) {
      out.strain += 0.5 * s.d.dot(body.flexible->fe.K * s.d);
    }
  }
  Forces forces;
  evaluate_forces(model, motions_of(model, state), state.t, circumstances_of(state), forces);
  out.springs = forces.stored_energy;
  return out;
}

double gravity_datum(const model::Model& model) {
  double mass = 0;
  for (const body::Body& body : model.bodies) mass += body.mass;
  return -mass * model.gravity.dot(model.origin);
}

Momentum momentum(const model::Model& model, const model::State& state) {
  Momentum out;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::BodyState& s = state.bodies[b];
    const Vector3d p = model.bodies[b].mass * s.frame.v;
    out.linear += p;
    const body::DeformedMoments moments = inertia(model.bodies[b], s);
    out.angular += s.frame.X_WB.q * (moments.J * s.frame.w + moments.l) + s.frame.X_WB.p.cross(p);
  }
  return out;
}

}  // namespace buckens::dynamics
