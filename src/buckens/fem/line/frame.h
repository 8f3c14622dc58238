// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

namespace buckens::fem {

/// Axes of a line element: x from the first node to the second, z as near to `up` as possible,
/// y = z × x.
struct LineFrame {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns x, y, z in model axes
  double length = 0;                                   ///< [m]
};

/// @param up hint for z in model axes. Without one: model z, or model y for elements along model z.
/// @throws ModelError if the ends coincide or `up` is parallel to the element
LineFrame line_frame(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                     const std::optional<Eigen::Vector3d>& up);

}  // namespace buckens::fem
