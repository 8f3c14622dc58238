// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

namespace buckens::loads {

/// A cylinder with flat ends, in axes of the first of two solids.
struct PlacedCylinder {
  Eigen::Vector3d middle, axis;
  double radius, half_length;
};

/// A part of what two solids have in common: what is nearest to one face of the first.
struct OverlapCell {
  double volume = 0;                                 ///< [m³]
  double depth = 0;                                  ///< integral of that below the face [m⁴]
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< integral of the place [m⁴]
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< of its products [m⁵]
};

}  // namespace buckens::loads
