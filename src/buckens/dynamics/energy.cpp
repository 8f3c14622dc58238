// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/energy.h"

#include "buckens/dynamics/energy_divided.h"
#include "buckens/dynamics/forces.h"

namespace buckens::dynamics {

using Eigen::Vector3d;

namespace {

/// J and l of the kinetic energy of the terms a body keeps. Sets of terms without one are judged by
/// the exact one.
body::DeformedMoments inertia(const body::Body& body, const model::BodyState& state) {
  body::DeformedMoments out;
  out.J = body.J0;
  const KineticTerms terms = kinetic_terms(state.terms);
  if (!body.is_flexible() || terms == KineticTerms::none) return out;
  const auto& invariants = body.flexible->invariants;
  if (terms == KineticTerms::first_order) {
    out.J += invariants.linear_inertia(invariants.pattern_values(state.d.whole()));
    return out;
  }
  out.J = invariants.rotary_inertia(state.d);
  out.l = invariants.relative_momentum(state.d, state.d_dot);
  return out;
}

/// Its products with M and K are asked for together: other processes may have the matrices.
DeformationEnergy energy_of_deformation(const body::Body& body, const model::BodyState& s,
                                        TaskPool* pool) {
  if (body.is_flexible()) {
    const auto of = s.d.others();
    if (of && of == s.d_dot.others()) return deformation_energy(body, s, of);
  }
  DeformationEnergy out;
  out.moments = inertia(body, s);
  if (!body.is_flexible()) return out;
  const body::FlexiblePart& part = *body.flexible;
  linalg::Vector momenta, forces;
  // The motion of a quasi-static body does no work on its deformation.
  if (part.is_quasi_static) {
    linalg::multiply({{&part.fe.M, &s.d_dot.whole(), &momenta}});
  } else {
    linalg::multiply(
        {{&part.fe.M, &s.d_dot.whole(), &momenta}, {&part.fe.K, &s.d.whole(), &forces}},
        part.if_worth(pool));
    out.strain = 0.5 * s.d.whole().dot(forces);
  }
  out.kinetic = 0.5 * s.d_dot.whole().dot(momenta);
  return out;
}

double kinetic_energy(const body::Body& body, const model::BodyState& state,
                      const DeformationEnergy& deformation) {
  const Vector3d& w = state.frame.w;
  double T = 0.5 * body.mass * state.frame.v.squaredNorm();
  const body::DeformedMoments& moments = deformation.moments;
  T += 0.5 * w.dot(moments.J * w) + w.dot(moments.l);
  if (body.is_flexible()) T += deformation.kinetic;
  return T;
}

}  // namespace

Energy energy(const model::Model& model, const model::State& state, TaskPool* pool) {
  Energy out;
  const Vector3d gravity = gravity_at(model, state.memory.signals);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    const model::BodyState& s = state.bodies[b];
    const DeformationEnergy deformation = energy_of_deformation(body, s, pool);
    out.kinetic += kinetic_energy(body, s, deformation);
    out.gravity -= body.mass * gravity.dot(s.frame.X_WB.p);
    out.strain += deformation.strain;
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
