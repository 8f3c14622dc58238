// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace buckens::spatial {

/// Position and velocity of a marker frame, in world components: all that a joint or a load knows
/// about the body.
struct MarkerMotion {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();      ///< origin [m]
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_W,marker
  Eigen::Vector3d w = Eigen::Vector3d::Zero();      ///< angular velocity [rad/s]
  Eigen::Vector3d v = Eigen::Vector3d::Zero();      ///< velocity of the origin [m/s]
};

/// Acceleration of a marker if the accelerations of the body's coordinates are zero, in world
/// components.
struct MarkerBias {
  Eigen::Vector3d alpha = Eigen::Vector3d::Zero();  ///< angular [rad/s²]
  Eigen::Vector3d a = Eigen::Vector3d::Zero();      ///< of the origin [m/s²]
};

/// Torque and force on a marker at its origin, in world components.
struct Wrench {
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< [N m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]

  Wrench& operator+=(const Wrench& other) {
    torque += other.torque;
    force += other.force;
    return *this;
  }
};

/// Row of derivatives of a scalar with respect to the twists of two markers:
/// (w_F, v_F, w_M, v_M), each 3 in world components.
using PairRow = Eigen::Matrix<double, 1, 12>;

}  // namespace buckens::spatial
