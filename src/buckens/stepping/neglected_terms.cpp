// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/neglected_terms.h"

#include <cmath>

#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/frame_equation.h"
#include "buckens/stepping/neglected_terms_divided.h"

namespace buckens::stepping {

using Eigen::Vector3d;
using linalg::Vector;

namespace {

/// Nodal load and frame torque of a set of terms.
struct Terms {
  Vector load;
  Vector3d torque;
};

Terms evaluate(const body::Body& body, const model::BodyState& s, const body::CouplingTerms& kept) {
  const body::InertiaInvariants& invariants = body.flexible->invariants;
  const model::Coupling coupling =
      dynamics::evaluate_coupling(body, kept, s.d, s.d_dot, s.d_ddot, s.frame.w, s.w_dot);
  Terms out;
  out.load.setZero(s.d.size());
  invariants.add_centrifugal_load(dynamics::centrifugal_weights(kept, s.frame.w), out.load);
  if (kept.have_load()) out.load += coupling.load.whole();
  const body::DeformedMoments moments =
      dynamics::frame_moments(body, kept, coupling.moments, invariants.pattern_values(s.d.whole()),
                              invariants.pattern_values(s.d_dot.whole()));
  out.torque =
      dynamics::frame_inertia(body, moments, s.frame.w, s.w_dot, Vector3d::Zero()).head<3>();
  return out;
}

NeglectedSizes sizes_here(const body::Body& body, const BodyStepOperator& op,
                          const model::BodyState& state, const body::CouplingTerms& kept,
                          const Vector* interface_load) {
  const body::FlexiblePart& part = *body.flexible;
  const Terms all = evaluate(body, state, {});
  const Terms used = evaluate(body, state, kept);
  const Vector inverse_diagonal = op.K_hat_diagonal().cwiseInverse();
  const auto norm = [&](Vector load) {
    part.sieve.apply_transposed(load);
    return std::sqrt(load.cwiseAbs2().dot(inverse_diagonal));
  };
  Vector inertia;
  op.inertial().multiply_mass(state.d_ddot, inertia);
  Vector internal, applied;
  if (interface_load != nullptr) {
    applied = part.rows.topRows(part.num_interface_rows).transpose() *
              interface_load->head(part.num_interface_rows);
    internal = applied + used.load - inertia;
  } else {
    if (part.is_damped()) {
      Vector damping;
      linalg::multiply(
          {{&part.fe.K, &state.d.whole(), &internal}, {&part.C, &state.d_dot.whole(), &damping}});
      internal += damping;
    } else {
      internal = part.fe.K * state.d.whole();
    }
    applied = inertia + internal - used.load;
  }
  return {norm(inertia), norm(internal), norm(applied), norm(all.load - used.load),
          all.torque - used.torque};
}

}  // namespace

double neglected_share(const body::Body& body, const BodyStepOperator& op,
                       const model::BodyState& state, const body::CouplingTerms& kept,
                       const Vector* interface_load) {
  const NeglectedSizes sizes =
      op.divided() != nullptr ? neglected_sizes(body, *op.divided(), state, kept, interface_load)
                              : sizes_here(body, op, state, kept, interface_load);
  const double root_J = std::sqrt(body.J0.norm());
  const double whole = sizes.inertia + sizes.internal + sizes.applied +
                       root_J * (state.w_dot.norm() + state.frame.w.squaredNorm());
  // Only turns that the frame can make count.
  const double torque = (body.rotation_basis.transpose() * sizes.torque).norm();
  const double neglected = sizes.neglected + (root_J > 0.0 ? torque / root_J : 0.0);
  return whole > 0.0 ? neglected / whole : 0.0;
}

}  // namespace buckens::stepping
