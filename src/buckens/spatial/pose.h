// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace buckens::spatial {

/// Pose X_AB: position and orientation of frame B in A.
struct Pose {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();            ///< origin of B in A [m]
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  ///< R_AB

  Eigen::Matrix3d R() const { return q.toRotationMatrix(); }

  /// Position in A of the point given in B [m].
  Eigen::Vector3d operator*(const Eigen::Vector3d& p_B) const { return p + q * p_B; }

  /// X_AC = X_AB X_BC.
  Pose operator*(const Pose& X_BC) const { return {p + q * X_BC.p, q * X_BC.q}; }

  Pose inverse() const { return {-(q.conjugate() * p), q.conjugate()}; }
};

}  // namespace buckens::spatial
