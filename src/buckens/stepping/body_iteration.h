// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/stepping/body_step.h"

namespace buckens::stepping {

/// One body's part in an iteration of the small Newton: the residual of its equations, and its
/// response to corrections and multipliers. Has its own buffers; nothing is allocated after the
/// first call.
class BodyIteration {
 public:
  /// @param answer of a flexible body, null for a rigid one
  /// @param L length that turns rotations into displacements [m]
  BodyIteration(const body::Body& body, const BodyAnswer* answer, const Scheme& scheme, double L);

  bool is_flexible() const { return answer_ != nullptr; }
  bool is_quasi_static() const { return answer_ != nullptr && answer_->is_quasi_static(); }

  /// W⁻¹ of the frame at a motion of the step.
  Eigen::Matrix<double, 6, 6> frame_compliance(const BodyStep& step,
                                               const dynamics::BodyMotion& motion) const;

  /// Residual of the equations of motion at fixed multipliers, as a change of u and of y.
  /// @param frame_load at the evaluation instant
  void find_residual(const BodyStep& step, const dynamics::BodyMotion& motion,
                     const Vector6& frame_load);
  /// Size of the residual of find_residual() [m].
  double residual_size() const;
  /// Motion of the body under the row forces that close positions.
  /// @param correction what does not apply to the body is set to zero
  void answer_correction(const BodyStep& step, dynamics::BodyResponse& correction);

  /// Motion of the frame under them [m].
  double size_of_correction(const BodyStep& step, const dynamics::BodyResponse& correction) const;

  /// Changes in metres; NaN if a motion is not a number.
  struct Moved {
    double frame = 0;      ///< change of the frame
    double interface = 0;  ///< change of interface values
    double motion = 0;     ///< of the frame in the whole step
  };
  /// Adds residual, correction and the response to the row forces that close velocities.
  Moved advance(BodyStep& step, const dynamics::BodyResponse& correction,
                const dynamics::BodyResponse& response);

  Vector6 residual_u = Vector6::Zero();
  Vector6 correction_u = Vector6::Zero();  ///< W⁻¹ Gᵀ E
  linalg::Vector y_moving;                 ///< velocity-carrying change of y at fixed multipliers
  linalg::Vector y_correcting;             ///< the correction's own displacement

 private:
  /// Largest change of row values [m].
  double interface_change(const linalg::Vector& dy) const;

  const body::Body* body_;
  const BodyAnswer* answer_;
  Scheme scheme_;
  double L_;
  linalg::Vector row_lengths_;   // that make displacements of the rows
  Eigen::Matrix3d translation_;  // W⁻¹ of the translations, always the same
  linalg::Vector change_;
};

/// The larger number; NaN wins, so that it cannot hide.
double larger(double a, double b);

}  // namespace buckens::stepping
