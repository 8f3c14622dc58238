// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/body_step.h"

#include "buckens/dynamics/coupling_terms.h"
#include "buckens/spatial/rotation.h"

namespace buckens::stepping {

using Eigen::Vector3d;

namespace {

Vector6 stack(const Vector3d& rotation, const Vector3d& translation) {
  Vector6 out;
  out << rotation, translation;
  return out;
}

void move(const spatial::Pose& X, const Vector6& u, spatial::Pose& out) {
  out.p = X.p + u.tail<3>();
  out.q = X.q * spatial::exp_rotation(u.head<3>());
  out.q.normalize();
}

}  // namespace

void BodyStep::start(const model::BodyState& state, const BodyAnswer* answer, const Scheme& scheme,
                     TaskPool* pool) {
  before = state.frame;
  terms = state.terms;
  frame = scheme.history<Vector6>(stack(state.frame.w, state.frame.v),
                                  stack(state.w_dot, state.v_dot), stack(state.w_alg, state.v_alg));
  u = frame.predicted;
  correction.setZero();
  if (answer == nullptr) return;
  answer->row_values(state, y_before, y_dot_before, y_ddot_before, y_alg_before, pool);
  scheme.history(y_dot_before, y_ddot_before, y_alg_before, y);
  y_end = y_before + y.predicted;
  load.setZero(y_before.size());
  correction_load.setZero(y_before.size());
  y_correction.setZero(y_before.size());
}

void BodyStep::motion_at_end(const Scheme& scheme, const BodyAnswer* answer,
                             dynamics::BodyMotion& out) const {
  move(before.X_WB, u + correction, out.frame.X_WB);
  out.frame.w = scheme.end_rate * u.head<3>() + frame.velocity.head<3>();
  out.frame.v = scheme.end_rate * u.tail<3>() + frame.velocity.tail<3>();
  if (answer == nullptr) return;
  out.y = y_end + y_correction;
  out.y_dot = scheme.end_rate * (y_end - y_before) + y.velocity;
  if (answer->is_quasi_static()) out.y_dot.setZero();
}

void BodyStep::uncorrected_motion(const Scheme& scheme, const BodyAnswer* answer,
                                  dynamics::BodyMotion& out) const {
  motion_at_end(scheme, answer, out);
  move(before.X_WB, u, out.frame.X_WB);
  if (answer != nullptr) out.y = answer->is_quasi_static() ? y_before : y_end;
}

void BodyStep::motion_at_evaluation(const Scheme& scheme, const BodyAnswer* answer,
                                    dynamics::BodyMotion& out) const {
  if (scheme.weight == 1.0) return motion_at_end(scheme, answer, out);
  move(before.X_WB, scheme.weight * u + frame.offset, out.frame.X_WB);
  out.frame.w = scheme.mean_rate * u.head<3>() + frame.mean_velocity.head<3>();
  out.frame.v = scheme.mean_rate * u.tail<3>() + frame.mean_velocity.tail<3>();
  if (answer == nullptr) return;
  out.y = y_before + scheme.weight * (y_end - y_before) + y.offset;
  out.y_dot = scheme.mean_rate * (y_end - y_before) + y.mean_velocity;
}

body::DeformedMoments BodyStep::moments(const body::Body& body,
                                        const dynamics::BodyMotion& motion) const {
  // Rows beyond those of the interface are the patterns.
  if (motion.y.size() <= body.num_interface_rows()) {
    body::DeformedMoments out = quadratic;
    out.J += body.J0;
    return out;
  }
  return dynamics::frame_moments(body, terms, quadratic, motion.y.tail<6>(),
                                 motion.y_dot.tail<6>());
}

void BodyStep::drop_correction() {
  correction.setZero();
  correction_load.setZero();
  y_correction.setZero();
}

void BodyStep::set_load(const Eigen::VectorXd& interface, const Vector3d& w) {
  load.head(interface.size()) = interface;
  if (load.size() > interface.size()) load.tail<6>() = dynamics::centrifugal_weights(terms, w);
}

}  // namespace buckens::stepping
