// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace buckens::spatial {

/// Skew matrix x~ with x~ y = x × y.
Eigen::Matrix3d skew(const Eigen::Vector3d& x);

/// Unit quaternion of the rotation by |psi| [rad] about psi; exact near zero.
Eigen::Quaterniond exp_rotation(const Eigen::Vector3d& psi);

/// The shortest rotation that carries the direction of `from` to that of `to`; neither is zero. Of
/// opposite directions, half a turn about one of the axes across.
Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Angular velocity [rad/s] with J w = L, the least of them where J [kg m²] is singular, as of a
/// straight bar about its axis. In the axes of J and L [kg m²/s].
Eigen::Vector3d spin_of(const Eigen::Matrix3d& J, const Eigen::Vector3d& L);

/// Rotation vector psi [rad], |psi| ≤ π, with exp_rotation(psi) = ±q.
Eigen::Vector3d log_rotation(const Eigen::Quaterniond& q);

/// Left Jacobian J_l of SO(3): for R = exp(theta~) the angular velocity in the outer axes is
/// J_l(theta) theta_dot. Equals I at theta = 0.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& theta);

/// Derivative of J_l(theta) theta_dot along theta_dot, with theta_ddot = 0 [rad/s²].
///
/// Central difference along the path: the term is of order |theta| |theta_dot|², so its
/// relative error of about 1e-9 is far below rounding of the accelerations it corrects.
Eigen::Vector3d left_jacobian_rate(const Eigen::Vector3d& theta, const Eigen::Vector3d& theta_dot);

}  // namespace buckens::spatial
