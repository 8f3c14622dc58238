// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace buckens::fem {

/// Angle of an x axis in other axes, after the normal has been rotated onto the other one [rad].
/// @param from, to columns x, y, normal
double turn_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to);

/// Transforms ε_x, ε_y, γ_xy from axes rotated by an angle.
Eigen::Matrix3d strain_in_other_axes(double angle);

}  // namespace buckens::fem
