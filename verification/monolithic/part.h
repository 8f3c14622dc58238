// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verification/monolithic/stepper.h"

#include "buckens/body/body.h"
#include "buckens/dynamics/system_kinematics.h"
#include "buckens/model/state.h"
#include "buckens/stepping/scheme.h"

namespace buckens::verification {

/// Unknowns of one body: u and Δ carry velocity, κ and η are corrections. Columns −1 are absent.
struct MonolithicStepper::Part {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  explicit Part(const body::Body& b);

  const body::Body& body;
  Eigen::MatrixXd basis;  // 6×(frame coordinates in use)
  linalg::Matrix P;       // n×(rigid motions that carry mass)
  int frame = 0, frame_correction = 0;
  int nodal = 0, nodal_multiplier = 0, nodal_correction = 0, correction_multiplier = 0;

  const model::BodyState* before = nullptr;
  stepping::History<Vector6> frame_history;
  stepping::History<linalg::Vector> nodal_history;
  Vector6 u, kappa;
  linalg::Vector delta, eta;
  Matrix6 W;                      // of the correction: at the predicted motion
  model::Coupling coupling;       // as evaluated last
  body::DeformedMoments moments;  // all of them

  bool is_flexible() const { return body.is_flexible(); }
  void set_moments(const linalg::Vector& d, const linalg::Vector& d_dot);
  /// The mass matrix of the frame and its gyroscopic tangent, weighted as the method does.
  Matrix6 metric(const stepping::Scheme& scheme, const Eigen::Vector3d& w) const;
  /// Motion at a time within the step.
  /// @param weight         share of the increments
  /// @param corrected      whether with the corrections
  /// @param shifted        whether with the offset of the method's evaluation time
  /// @param rate_factor    rate per increment [1/s], added to `frame_rate` and `nodal_rate`
  dynamics::BodyMotion motion(double weight, bool corrected, bool shifted, double rate_factor,
                              const Vector6& frame_rate, const linalg::Vector* nodal_rate) const;
};

}  // namespace buckens::verification
