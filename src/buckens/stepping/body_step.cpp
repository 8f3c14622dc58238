// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/body_step.h"

#include "buckens/dynamics/coupling_terms.h"
#include "buckens/spatial/rotation.h"

namespace buckens::stepping {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Vector6 stack(const Vector3d& rotation, const Vector3d& translation) {
  Vector6 out;
  out << rotation, translation;
  return out;
}

spatial::Pose moved(const spatial::Pose& X, const Vector6& u) {
  return {X.p + u.tail<3>(), (X.q * spatial::exp_rotation(u.head<3>())).normalized()};
}

}  // namespace

void BodyStep::start(const model::BodyState& state, const BodyStepOperator* op,
                     const Scheme& scheme) {
  before = state.frame;
  terms = state.terms;
  frame = scheme.history<Vector6>(stack(state.frame.w, state.frame.v),
                                  stack(state.w_dot, state.v_dot), stack(state.w_alg, state.v_alg));
  u = frame.predicted;
  correction.setZero();
  if (op == nullptr) return;
  op->row_values(state, y_before, y_dot_before, y_ddot_before, y_alg_before);
  scheme.history(y_dot_before, y_ddot_before, y_alg_before, y);
  y_end = y_before + y.predicted;
  load.setZero(y_before.size());
  correction_load.setZero(y_before.size());
}

dynamics::BodyMotion BodyStep::motion_at_end(const Scheme& scheme,
                                             const BodyStepOperator* op) const {
  dynamics::BodyMotion motion;
  motion.frame.X_WB = moved(before.X_WB, u + correction);
  const Vector6 rate = scheme.end_rate * u + frame.velocity;
  motion.frame.w = rate.head<3>();
  motion.frame.v = rate.tail<3>();
  if (op != nullptr) {
    motion.y = y_end + op->compliance() * correction_load;
    motion.y_dot = scheme.end_rate * (y_end - y_before) + y.velocity;
    if (op->is_quasi_static()) motion.y_dot.setZero();
  }
  return motion;
}

dynamics::BodyMotion BodyStep::uncorrected_motion(const Scheme& scheme,
                                                  const BodyStepOperator* op) const {
  dynamics::BodyMotion motion = motion_at_end(scheme, op);
  motion.frame.X_WB = moved(before.X_WB, u);
  if (op != nullptr) motion.y = op->is_quasi_static() ? y_before : y_end;
  return motion;
}

dynamics::BodyMotion BodyStep::motion_at_evaluation(const Scheme& scheme,
                                                    const BodyStepOperator* op) const {
  if (scheme.weight == 1.0) return motion_at_end(scheme, op);
  dynamics::BodyMotion motion;
  motion.frame.X_WB = moved(before.X_WB, scheme.weight * u + frame.offset);
  const Vector6 rate = scheme.mean_rate * u + frame.mean_velocity;
  motion.frame.w = rate.head<3>();
  motion.frame.v = rate.tail<3>();
  if (op != nullptr) {
    motion.y = y_before + scheme.weight * (y_end - y_before) + y.offset;
    motion.y_dot = scheme.mean_rate * (y_end - y_before) + y.mean_velocity;
  }
  return motion;
}

body::DeformedMoments BodyStep::moments(const body::Body& body,
                                        const dynamics::BodyMotion& motion) const {
  // Rows beyond those of the interface are the patterns.
  if (motion.y.size() <= body.num_interface_rows()) {
    return dynamics::frame_moments(body, body::CouplingTerms::none(), quadratic, {}, {});
  }
  return dynamics::frame_moments(body, terms, quadratic, motion.y.tail<6>(),
                                 motion.y_dot.tail<6>());
}

VectorXd BodyStep::total_load(const VectorXd& interface, const Vector3d& w) const {
  VectorXd out(y_before.size());
  out.head(interface.size()) = interface;
  if (out.size() > interface.size()) out.tail<6>() = dynamics::centrifugal_weights(terms, w);
  return out;
}

}  // namespace buckens::stepping
