// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/dynamics/system_kinematics.h"
#include "buckens/model/state.h"
#include "buckens/stepping/body_answer.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// One body within one step, without any n-sized vector: frame increments and interface values.
/// Where the coupling needs them, the six numbers c_ab·d follow the interface values; the
/// centrifugal load of the undeformed body is the load along these rows.
///
/// The increment u of the frame, FM (43) (rotation vector in body axes, translation in world axes),
/// carries velocity; the position correction does not.
struct BodyStep {
  body::FrameMotion before;
  History<Vector6> frame;
  Vector6 u = Vector6::Zero();
  Vector6 correction = Vector6::Zero();
  body::CouplingTerms terms;
  body::DeformedMoments quadratic;  ///< J₂, J̇₂, l, l̇: taken as given by the small Newton
  Eigen::Matrix<double, 6, 6> compliance;  ///< W⁻¹ of the frame

  Eigen::VectorXd y_before;  ///< interface values at the start
  History<Eigen::VectorXd> y;
  Eigen::VectorXd y_dot_before, y_ddot_before, y_alg_before;
  Eigen::VectorXd y_free;           ///< at the end, without interface loads
  Eigen::VectorXd y_end;            ///< at the end, without correction
  Eigen::VectorXd load;             ///< f at the evaluation instant, centrifugal weights with it
  Eigen::VectorXd correction_load;  ///< e
  Eigen::VectorXd y_correction;     ///< N G e

  /// Prepares everything except the free response.
  /// @param pool processes the rows of large bodies in parallel, with the same result
  void start(const model::BodyState& state, const BodyAnswer* answer, const Scheme& scheme,
             TaskPool* pool = nullptr);

  /// Motions are written to `out`, whose buffers are reused.
  void motion_at_start(dynamics::BodyMotion& out) const {
    out.frame = before;
    out.y = y_before;
    out.y_dot = y_dot_before;
  }
  void motion_at_end(const Scheme& scheme, const BodyAnswer* answer,
                     dynamics::BodyMotion& out) const;
  /// The same with the pose that the velocities alone lead to, and the initial shape if the body
  /// deforms without rates.
  void uncorrected_motion(const Scheme& scheme, const BodyAnswer* answer,
                          dynamics::BodyMotion& out) const;
  void motion_at_evaluation(const Scheme& scheme, const BodyAnswer* answer,
                            dynamics::BodyMotion& out) const;
  /// All moments of the frame equation at a motion of this step.
  body::DeformedMoments moments(const body::Body& body, const dynamics::BodyMotion& motion) const;
  /// Undoes all corrections of positions.
  void drop_correction();
  /// Sets `load`: interface load and centrifugal weights, FM (24), at the evaluation instant.
  /// @param interface loads of joints and forces, @param w angular velocity there
  void set_load(const Eigen::VectorXd& interface, const Eigen::Vector3d& w);
  Vector6 frame_acceleration(const Scheme& scheme) const {
    return scheme.acceleration_rate * u + frame.acceleration;
  }
};

}  // namespace buckens::stepping
