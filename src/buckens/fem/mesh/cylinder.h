// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Core>

namespace buckens::fem {

/// A round solid: cylinder, tube, or (short) a disc with or without a bore.
struct Cylinder {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< centre of the bottom, model axes [m]
  Eigen::Vector3d to = Eigen::Vector3d::UnitZ();   ///< centre of the top [m]
  double outer_radius = 1;                         ///< [m]
  double inner_radius = 0;                         ///< [m], zero without a bore
  /// Numbers of elements in radial, circumferential and axial direction. Without a bore, the first
  /// counts rings around a square core, whose sides each have a quarter of the second.
  std::array<int, 3> divisions = {1, 8, 1};
};

}  // namespace buckens::fem
