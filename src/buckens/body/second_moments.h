// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Dense>

namespace buckens::body {

/// Indices (a, b) of the six stored matrices W_ab, a ≤ b; W_ba is the transpose.
inline constexpr std::array<std::array<int, 2>, 6> kPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// Inertia from second moments T_ab = ∫ x_a x_b dm: tr(T) 1 − T [kg m²].
inline Eigen::Matrix3d to_inertia(const Eigen::Matrix3d& second_moment) {
  return second_moment.trace() * Eigen::Matrix3d::Identity() - second_moment;
}

/// (T_23 − T_32, T_31 − T_13, T_12 − T_21).
inline Eigen::Vector3d axial(const Eigen::Matrix3d& T) {
  return {T(1, 2) - T(2, 1), T(2, 0) - T(0, 2), T(0, 1) - T(1, 0)};
}

}  // namespace buckens::body
