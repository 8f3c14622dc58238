// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/system_kinematics.h"

namespace buckens::dynamics {

/// Dry friction in a joint at one instant. Its power is the product of both.
struct JointRub {
  /// Along its coordinate, the others zero [N] or [N m]; of a ball the torque on the second marker,
  /// world axes [N m].
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Of the coordinate, the others zero [m/s] or [rad/s]; of a ball of the second marker against
  /// the first, world axes [rad/s].
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
};

/// The loads that are dry friction in joints, brakes among them, as indices into Model::loads.
/// Pairs that come near or go away change neither them nor their places.
std::vector<std::size_t> rubbing_joints(const model::Model& model);

/// One of them. @param load index into Model::loads
JointRub joint_rub(const model::Model& model, std::size_t load,
                   const std::vector<BodyMotion>& motions, double t, const Circumstances& around);
/// Its rate alone. @param memory as at the start of the step
Eigen::Vector3d joint_rub_rate(const model::Model& model, std::size_t load,
                               const std::vector<BodyMotion>& motions, double t,
                               const model::RowMemory* memory);

}  // namespace buckens::dynamics
