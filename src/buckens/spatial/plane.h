// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace buckens::spatial {

/// The plane of motion of a planar model. The value is the index of the normal axis.
enum class Plane { yz = 0, zx = 1, xy = 2 };

inline int normal_index(Plane plane) { return static_cast<int>(plane); }
inline Eigen::Vector3d normal(Plane plane) { return Eigen::Vector3d::Unit(normal_index(plane)); }

}  // namespace buckens::spatial
